#include "ninedof/proof/admissible.hpp"

#include <pybind11/stl.h>

#include "ninedof/proof/bounds.hpp"
#include "support/interruptible.hpp"
#include "support/module.hpp"
#include "support/struct.hpp"

namespace ninedof::python {
namespace {

/// The ends of pieces as arrays (n, number of variables).
py::tuple ends_of_pieces(const DesignSet& found, py::ssize_t count) {
  const auto n = static_cast<py::ssize_t>(found.pieces.size());
  const std::vector<py::ssize_t> shape{n, count};
  Array low(shape), high(shape);
  for (py::ssize_t k = 0; k < n; ++k)
    for (py::ssize_t i = 0; i < count; ++i) {
      const DesignPiece& piece = found.pieces[static_cast<std::size_t>(k)];
      low.mutable_at(k, i) = piece.low[static_cast<std::size_t>(i)];
      high.mutable_at(k, i) = piece.high[static_cast<std::size_t>(i)];
    }
  return py::make_tuple(low, high);
}

py::dict found_designs(const DesignQuestion& question, const DesignSet& found) {
  const auto n = static_cast<py::ssize_t>(found.pieces.size());
  py::array_t<std::int8_t> state(n);
  py::array_t<std::int32_t> demand(n);
  Array poses(std::vector<py::ssize_t>{n, 14});
  for (py::ssize_t k = 0; k < n; ++k) {
    const DesignPiece& piece = found.pieces[static_cast<std::size_t>(k)];
    state.mutable_at(k) = static_cast<std::int8_t>(piece.state);
    demand.mutable_at(k) = piece.demand;
    py::ssize_t i = 0;
    for (const MetAt* met : {&piece.at, &piece.other}) {
      poses.mutable_at(k, i++) = met->pose;
      for (const double x : {met->shift[0], met->shift[1], met->shift[2], met->tilt[0], met->tilt[1], met->yaw})
        poses.mutable_at(k, i++) = x;
    }
  }
  const py::tuple ends = ends_of_pieces(found, static_cast<py::ssize_t>(question.varied.size()));
  py::list demands;
  for (const Demand& one : found.demands) demands.append(py::make_tuple(one.limit, one.part));
  py::dict out;
  out["low"] = ends[0];
  out["high"] = ends[1];
  out["state"] = state;
  out["demand"] = demand;
  out["poses"] = poses;
  out["demands"] = py::tuple(demands);
  out["inside"] = found.inside;
  out["outside"] = found.outside;
  out["undecided"] = found.undecided;
  out["looked_at"] = found.looked_at;
  out["boxes"] = found.boxes;
  out["interrupted"] = found.interrupted;
  return out;
}

/// The pieces of an earlier run, from the arrays that it gave.
std::vector<DesignPiece> pieces_from(const py::dict& from, std::size_t count) {
  const auto low = from["low"].cast<Array>(), high = from["high"].cast<Array>(), poses = from["poses"].cast<Array>();
  const py::ssize_t n = low.ndim() > 0 ? low.shape(0) : 0;
  const auto state = list_from<int>("state", from["state"], n), demand = list_from<int>("demand", from["demand"], n);
  if (low.ndim() != 2 || low.shape(1) != static_cast<py::ssize_t>(count) || high.ndim() != 2 || high.shape(0) != n ||
      high.shape(1) != low.shape(1) || poses.ndim() != 2 || poses.shape(0) != n || poses.shape(1) != 14)
    throw InvalidArgument("earlier", "arrays of other shapes", "those of an earlier run");
  std::vector<DesignPiece> out(state.size());
  for (py::ssize_t k = 0; k < n; ++k) {
    const auto i = static_cast<std::size_t>(k);
    DesignPiece& piece = out[i];
    for (std::size_t j = 0; j < count; ++j) {
      piece.low[j] = low.at(k, static_cast<py::ssize_t>(j));
      piece.high[j] = high.at(k, static_cast<py::ssize_t>(j));
    }
    piece.state = state[i] == 0 ? Membership::inside : state[i] == 1 ? Membership::outside : Membership::undecided;
    piece.demand = demand[i];
    py::ssize_t j = 0;
    const auto next = [&] { return poses.at(k, j++); };
    for (MetAt* met : {&piece.at, &piece.other}) {
      met->pose = static_cast<int>(next());
      for (double* x : {&met->shift[0], &met->shift[1], &met->shift[2], &met->tilt[0], &met->tilt[1], &met->yaw})
        *x = next();
    }
  }
  return out;
}

}  // namespace

void bind_admissible(py::module_& m) {
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
        const DesignSettings settings{threads, seconds, resolution, undecided};
        const std::vector<DesignPiece> earlier =
            from.is_none() ? std::vector<DesignPiece>{} : pieces_from(from.cast<py::dict>(), question.varied.size());
        const DesignSet found = interruptible(
            progress,
            [&](const WorkControl& control) { return admissible_designs(question, settings, earlier, control); },
            [](DesignSet& set) { return set.interrupted = true; });
        return found_designs(question, found);
      },
      py::arg("question"), py::kw_only(), py::arg("threads"), py::arg("seconds"), py::arg("resolution"),
      py::arg("undecided"), py::arg("earlier") = py::none(), py::arg("progress") = py::none());
  m.def(
      "any_admissible",
      [](const DesignQuestion& question, int threads, double seconds, double resolution, bool certificate,
         const py::object& progress) {
        require_sound_arithmetic();
        const DesignExistence found = interruptible(
            progress,
            [&](const WorkControl& control) {
              return any_admissible(question, {threads, seconds, resolution, 0.0, certificate}, control);
            },
            [](DesignExistence& one) { return one.interrupted = true; });
        const bool proved = certificate && found.state == DesignExistence::State::none;
        const py::bytes file(proved ? design_certificate(question, found.refuted) : "");
        constexpr std::array words{"exists", "none", "undecided"};
        const std::vector<double> design(found.design.begin(), found.design.begin() + std::ssize(question.varied));
        return py::make_tuple(words[static_cast<std::size_t>(found.state)], design, found.looked_at, found.open,
                              found.interrupted, file);
      },
      py::arg("question"), py::kw_only(), py::arg("threads"), py::arg("seconds"), py::arg("resolution"),
      py::arg("certificate"), py::arg("progress") = py::none());
  m.def(
      "design_certificate",
      [](const DesignQuestion& question, const py::dict& pieces,
         const std::vector<std::pair<std::string, std::string>>& demands, const std::array<double, 3>& shares) {
        question.validate();
        DesignSet set;
        for (const auto& [limit, part] : demands) set.demands.push_back({limit, part});
        set.pieces = pieces_from(pieces, question.varied.size());
        std::tie(set.inside, set.outside, set.undecided) = std::tuple(shares[0], shares[1], shares[2]);
        return py::bytes(design_certificate(question, set));
      },
      py::arg("question"), py::arg("pieces"), py::arg("demands"), py::arg("shares"));
  m.def(
      "machine_certificate",
      [](const DesignQuestion& question, double slack) { return py::bytes(machine_certificate(question, slack)); },
      py::arg("question"), py::kw_only(), py::arg("slack"));
  m.def(
      "room_around",
      [](const DesignQuestion& question, const std::vector<double>& design, const std::vector<double>& proportions,
         long boxes, const py::object& progress) {
        require_sound_arithmetic();
        const DesignRoom room = interruptible(progress, [&](const WorkControl& control) {
          return room_around(question, design, proportions, boxes, control);
        });
        const auto ends = [&](const std::array<double, most_varied>& all) {
          return std::vector<double>(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(design.size()));
        };
        py::list beyond;
        for (std::size_t k = 0; k < design.size(); ++k)
          for (const DesignRoom::Beyond& one : room.beyond[k]) beyond.append(py::make_tuple(one.demand, one.at));
        return py::make_tuple(room.found, ends(room.low), ends(room.high), room.demand, beyond, room.boxes);
      },
      py::arg("question"), py::arg("design"), py::arg("proportions"), py::kw_only(), py::arg("boxes"),
      py::arg("progress") = py::none());
}

}  // namespace ninedof::python
