#include "ninedof/proof/admissible.hpp"

#include <pybind11/stl.h>

#include "ninedof/proof/bounds.hpp"
#include "support/interruptible.hpp"
#include "support/module.hpp"
#include "support/struct.hpp"

namespace ninedof::python {
namespace {

/// A set with the number of variables that vary.
struct FoundSet : DesignSet {
  py::ssize_t varied = 0;
};

/// A getter of ends of the pieces, shape (n, number of variables).
auto ends_of(std::array<double, most_varied> DesignPiece::* end) {
  return [end](const FoundSet& found) {
    Array out(std::vector<py::ssize_t>{std::ssize(found.pieces), found.varied});
    double* to = out.mutable_data();
    for (const DesignPiece& piece : found.pieces) to = std::copy_n((piece.*end).begin(), found.varied, to);
    return out;
  };
}

/// A getter of a number of each piece, shape (n,).
template <class Number, class T>
auto of_pieces(T DesignPiece::* member) {
  return [member](const FoundSet& found) {
    py::array_t<Number> out(std::ssize(found.pieces));
    std::ranges::transform(found.pieces, out.mutable_data(),
                           [&](const DesignPiece& piece) { return static_cast<Number>(piece.*member); });
    return out;
  };
}

constexpr py::ssize_t pose_size = 7;

Array pose_rows(const FoundSet& found) {
  Array out(std::vector<py::ssize_t>{std::ssize(found.pieces), 2 * pose_size});
  double* to = out.mutable_data();
  for (const DesignPiece& piece : found.pieces)
    for (const MetAt* met : {&piece.at, &piece.other}) {
      *to++ = met->pose;
      to = python::write(Vec6(met->shift[0], met->shift[1], met->shift[2], met->tilt[0], met->tilt[1], met->yaw), to);
    }
  return out;
}

MetAt met_at(const double* from) {
  return {Vec3(from[1], from[2], from[3]), Vec3(from[4], from[5], 0.0), from[6], static_cast<int>(from[0])};
}

/// The pieces of an AdmissibleSet, or of what else has their columns: none for None.
std::vector<DesignPiece> pieces_from(const py::object& from, std::size_t count) {
  if (from.is_none()) return {};
  const auto n = static_cast<py::ssize_t>(py::len(from.attr("state"))), d = static_cast<py::ssize_t>(count);
  const auto column = [&](const char* name, py::ssize_t width) {
    return array_of_shape(name, from.attr(name), {n, width});
  };
  const Array low = column("low", d), high = column("high", d), poses = column("poses", 2 * pose_size);
  const auto state = list_from<int>("state", from.attr("state"), n),
             demand = list_from<int>("demand", from.attr("demand"), n);
  std::vector<DesignPiece> out(state.size());
  for (py::ssize_t k = 0; k < n; ++k) {
    const auto i = static_cast<std::size_t>(k);
    DesignPiece& piece = out[i];
    std::copy_n(low.data(k, 0), d, piece.low.begin());
    std::copy_n(high.data(k, 0), d, piece.high.begin());
    piece.state = state[i] == 0 ? Membership::inside : state[i] == 1 ? Membership::outside : Membership::undecided;
    piece.demand = demand[i];
    piece.at = met_at(poses.data(k, 0));
    piece.other = met_at(poses.data(k, pose_size));
  }
  return out;
}

void bind_answers(py::module_& m) {
  py::class_<FoundSet>(m, "DesignSet", "A box of designs, divided into pieces.")
      .def_property_readonly("low", ends_of(&DesignPiece::low), "Shape (n, d).")
      .def_property_readonly("high", ends_of(&DesignPiece::high), "Shape (n, d).")
      .def_property_readonly("state", of_pieces<std::int8_t>(&DesignPiece::state),
                             "0 inside, 1 outside, 2 undecided, shape (n,).")
      .def_property_readonly("demand", of_pieces<std::int32_t>(&DesignPiece::demand),
                             "Index into `demands` of what those outside break, else -1, shape (n,).")
      .def_property_readonly("poses", &pose_rows, "Where it is broken, as in AdmissibleSet, shape (n, 14).")
      .def_property_readonly(
          "demands",
          [](const FoundSet& found) {
            py::list out;
            for (const Demand& one : found.demands) out.append(py::make_tuple(one.limit, one.part));
            return py::tuple(out);
          },
          "Limits with their parts.")
      .def_readonly("inside", &FoundSet::inside, "Share of the volume.")
      .def_readonly("outside", &FoundSet::outside, "Share of the volume.")
      .def_readonly("undecided", &FoundSet::undecided, "Share of the volume.")
      .def_readwrite("looked_at", &FoundSet::looked_at, "Boxes of designs.")
      .def_readwrite("boxes", &FoundSet::boxes, "Of poses, with a box of designs each.")
      .def_readwrite("interrupted", &FoundSet::interrupted, "By Ctrl-C.");
  constexpr std::array states{"exists", "none", "undecided"};
  py::class_<DesignExistence>(m, "DesignExistence", "Whether any design of a box is inside.")
      .def_property_readonly("state", word_of(&DesignExistence::state, states), "The first two are proved.")
      .def_readonly("design", &DesignExistence::design, "One that exists, in the order of `varied`, then zeros.")
      .def_readonly("looked_at", &DesignExistence::looked_at, "Boxes of designs.")
      .def_readonly("open", &DesignExistence::open, "Boxes of designs that are left.")
      .def_readonly("interrupted", &DesignExistence::interrupted, "By Ctrl-C.")
      .def(
          "certificate",
          [](const DesignExistence& found, const DesignQuestion& of) {
            return py::bytes(design_certificate(of, found.refuted));
          },
          "Of none, where the boxes outside were kept: bytes of a file for the checker.");
  py::class_<DesignRoom::Beyond>(m, "BeyondSide", "What designs just beyond a side of a box break, proved.")
      .def_readonly("demand", &DesignRoom::Beyond::demand, "Index into the demands of the set; -1: none is known.")
      .def_readonly("at", &DesignRoom::Beyond::at, "At which pose.");
  py::class_<DesignRoom>(m, "DesignRoom", "A box around a design, all of which is inside.")
      .def_readonly("found", &DesignRoom::found, "Not where the design breaks a limit, or nothing could be proved.")
      .def_readonly("low", &DesignRoom::low, "Lower ends of the box, in the order of `varied`, then zeros.")
      .def_readonly("high", &DesignRoom::high, "Upper ends of the box, in the order of `varied`, then zeros.")
      .def_readonly("demand", &DesignRoom::demand, "Which the design breaks, proved; -1: none is known.")
      .def_readonly("beyond", &DesignRoom::beyond, "Of each variable below and above.")
      .def_readonly("boxes", &DesignRoom::boxes, "Of poses.");
}

}  // namespace

void bind_admissible(py::module_& m) {
  bind_answers(m);
  request<DesignQuestion>(m, "DesignQuestion", "Which designs, and what they have to keep.")
      .def_property("problem", copy_of(&DesignQuestion::problem), setter_of(&DesignQuestion::problem), "Copied.")
      .def_property("region", copy_of(&DesignQuestion::region), setter_of(&DesignQuestion::region), "None or one.")
      .def_readwrite("at", &DesignQuestion::at, "A value for each variable of the family.")
      .def_readwrite("varied", &DesignQuestion::varied, "Indices of the variables that vary.")
      .def_readwrite("low", &DesignQuestion::low, "Of each.")
      .def_readwrite("high", &DesignQuestion::high, "Of each.")
      .def_readwrite("condition", &DesignQuestion::condition, "Greatest condition number.");
  m.def(
      "admissible_designs",
      [](const DesignQuestion& question, int threads, double seconds, double resolution, double undecided,
         const py::object& from, const py::object& progress) {
        require_sound_arithmetic();
        const std::vector<DesignPiece> earlier = pieces_from(from, question.varied.size());
        return interruptible(
            progress,
            [&](const WorkControl& control) {
              return FoundSet{admissible_designs(question, {threads, seconds, resolution, undecided}, earlier, control),
                              std::ssize(question.varied)};
            },
            [](FoundSet& set) { return set.interrupted = true; });
      },
      py::arg("question"), py::kw_only(), py::arg("threads"), py::arg("seconds"), py::arg("resolution"),
      py::arg("undecided"), py::arg("earlier") = py::none(), py::arg("progress") = py::none());
  m.def(
      "any_admissible",
      [](const DesignQuestion& question, int threads, double seconds, double resolution, bool certificate,
         const py::object& progress) {
        require_sound_arithmetic();
        return interruptible(
            progress,
            [&](const WorkControl& control) {
              return any_admissible(question, {threads, seconds, resolution, 0.0, certificate}, control);
            },
            [](DesignExistence& one) { return one.interrupted = true; });
      },
      py::arg("question"), py::kw_only(), py::arg("threads") = 0, py::arg("seconds") = 1e9, py::arg("resolution") = 0.0,
      py::arg("certificate") = false, py::arg("progress") = py::none());
  m.def(
      "design_certificate",
      [](const DesignQuestion& question, const py::object& from) {
        question.validate();
        DesignSet set;
        for (const auto& [limit, part] : from.attr("demands").cast<std::vector<std::pair<std::string, std::string>>>())
          set.demands.push_back({limit, part});
        set.pieces = pieces_from(from, question.varied.size());
        const py::object shares = from.attr("shares");
        const auto share = [&](const char* state) { return shares[state].cast<double>(); };
        set.inside = share("inside");
        set.outside = share("outside");
        set.undecided = share("undecided");
        return py::bytes(design_certificate(question, set));
      },
      py::arg("question"), py::arg("set"));
  m.def(
      "machine_certificate",
      [](const DesignQuestion& question, double slack) { return py::bytes(machine_certificate(question, slack)); },
      py::arg("question"), py::kw_only(), py::arg("slack"));
  m.def(
      "room_around",
      [](const DesignQuestion& question, const std::vector<double>& design, const std::vector<double>& proportions,
         long boxes, const py::object& progress) {
        require_sound_arithmetic();
        return interruptible(progress, [&](const WorkControl& control) {
          return room_around(question, design, proportions, boxes, control);
        });
      },
      py::arg("question"), py::arg("design"), py::arg("proportions"), py::kw_only(), py::arg("boxes"),
      py::arg("progress") = py::none());
}

}  // namespace ninedof::python
