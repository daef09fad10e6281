#include "ninedof/workspace/certified.hpp"

#include "support/interruptible.hpp"
#include "support/module.hpp"
#include "support/struct.hpp"
#include "support/workspace_question.hpp"

namespace ninedof::python {
namespace {

constexpr std::array beyond{"nothing", "something", "unknown"};

std::pair<double, double> ends_of(const VolumeBounds& v) {
  return {v.low, v.high};
}

Array open_volumes(const CertifiedWorkspace& c) {
  Array out(std::vector<py::ssize_t>{std::ssize(c.open_volume), 2});
  double* to = out.mutable_data();
  for (const VolumeBounds& v : c.open_volume) to = python::write(Eigen::Vector2d(v.low, v.high), to);
  return out;
}

/// Slope, allowed and forbidden of each plane, shape (n, 5).
Array planes_of(const CertifiedWorkspace& c) {
  Array out(std::vector<py::ssize_t>{std::ssize(c.cuts), 5});
  double* to = out.mutable_data();
  for (const BoxCut& cut : c.cuts)
    to = python::write(Eigen::Vector2d(cut.allowed, cut.forbidden), python::write(cut.slope, to));
  return out;
}

/// The boxes of a CertifiedWorkspace and their planes; of the rest, what its states need.
CertifiedWorkspace certified_from(const py::object& given) {
  CertifiedWorkspace out;
  const bool nothing = given.attr("beyond").cast<std::string>() == beyond[0];
  out.beyond = nothing ? CertifiedWorkspace::Beyond::nothing : CertifiedWorkspace::Beyond::unknown;
  out.box_low = given.attr("box_low").cast<Vec3>();
  out.box_high = given.attr("box_high").cast<Vec3>();
  out.inner_low = points_from("inner_low", given.attr("inner_low"));
  out.inner_high = points_from("inner_high", given.attr("inner_high"));
  out.open_low = points_from("open_low", given.attr("open_low"));
  out.open_high = points_from("open_high", given.attr("open_high"));
  out.first_cut = list_from<std::int64_t>("first_cut", given.attr("first_cut"), std::ssize(out.open_low) + 1);
  const auto cuts = given.attr("cuts").cast<Array>();
  for (const double* from = cuts.data(); from != cuts.data() + cuts.size() / 5 * 5; from += 5)
    out.cuts.push_back({Eigen::Map<const Vec3>(from), from[3], from[4]});
  const auto is_cut = [&](std::int64_t n) { return n >= 0 && n <= std::ssize(out.cuts); };
  if (out.inner_low.size() != out.inner_high.size() || out.open_low.size() != out.open_high.size() ||
      !std::ranges::all_of(out.first_cut, is_cut))
    throw InvalidArgument("certified", "boxes and planes that do not match", "those of certified_workspace");
  return out;
}

}  // namespace

void bind_certified_workspace(py::module_& m) {
  request<CertifySettings>(m, "CertifySettings", "When the search for the bounds of a volume ends.")
      .def_readwrite("gap", &CertifySettings::gap, "Of the bounds, relative to the upper one.")
      .def_readwrite("seconds", &CertifySettings::seconds, "Of wall time.")
      .def_readwrite("threads", &CertifySettings::threads, "0: one for each processor.")
      .def_readwrite("boxes", &CertifySettings::boxes, "Looked at, at most.");
  using C = CertifiedWorkspace;
  py::class_<C>(m, "CertifiedWorkspace", "A workspace between proved bounds; the public class says what each means.")
      .def_property_readonly("end", word_of(&C::end, std::array{"gap", "time", "boxes", "stopped", "smallest"}),
                             "Why the search ended: gap, time, boxes, stopped or smallest.")
      .def_property_readonly(
          "volume", [](const C& c) { return ends_of(c.volume); },
          "Lower and upper bound of all that is allowed in the box, lengths cubed or radians cubed.")
      .def_property_readonly(
          "home_volume", [](const C& c) { return ends_of(c.home_volume); }, "The same of what is connected with home.")
      .def_property_readonly(
          "home",
          [](const C& c) {
            if (c.home_inside) return "allowed";
            return c.home_outside ? "forbidden" : "unknown";
          },
          "allowed, forbidden or unknown.")
      .def_property_readonly("beyond", word_of(&C::beyond, beyond),
                             "What is allowed outside the box: nothing, something or unknown.")
      .def_property_readonly("box_low", copy_of(&C::box_low), "Of the box asked for, shape (3,).")
      .def_property_readonly("box_high", copy_of(&C::box_high), "Shape (3,).")
      .def_property_readonly("low", copy_of(&C::low),
                             "Of the box that was divided, outside which nothing is allowed, shape (3,).")
      .def_property_readonly("high", copy_of(&C::high), "Shape (3,).")
      .def_property_readonly("inner_low", points_of(&C::inner_low),
                             "Of boxes in which every pose is allowed, shape (n, 3).")
      .def_property_readonly("inner_high", points_of(&C::inner_high), "Shape (n, 3).")
      .def_property_readonly("open_low", points_of(&C::open_low),
                             "Of boxes that hold all other allowed poses, shape (m, 3).")
      .def_property_readonly("open_high", points_of(&C::open_high), "Shape (m, 3).")
      .def_property_readonly("open_volume", &open_volumes, "Bounds of the allowed part of each open box, shape (m, 2).")
      .def_property_readonly("first_cut", column_of<std::int64_t>(&C::first_cut),
                             "Open box n has the cuts from first_cut[n] to first_cut[n + 1], shape (m + 1,).")
      .def_property_readonly(
          "cuts", &planes_of,
          "Planes: slope, then the offset above which poses are allowed and that below which none is, shape (k, 5).")
      .def_readonly("looked", &C::looked, "Boxes looked at.");
  m.def("certified_workspace", [](const WorkspaceQuestion& q, const CertifySettings& s, const py::object& progress) {
    return interruptible(
        progress,
        [&](const Control& control) {
          return certified_workspace(q.geometry, q.domain, q.rule, q.criteria, s, q.home, control);
        },
        [](C& found) {
          found.end = C::End::stopped;
          return true;
        });
  });
  m.def("workspace_certificate", [](const WorkspaceQuestion& q, const C& found) {
    return py::bytes(workspace_certificate(q.geometry, q.domain, q.rule, q.criteria, found, q.home));
  });
  m.def("certified_states", [](const py::object& certified, const Array& points) {
    const CertifiedWorkspace found = certified_from(certified);
    const std::vector<Vec3> at = points_from("points", points);
    return column<std::int8_t>(
        interruptible(py::none(), [&](const Control& control) { return proved_states(found, at, control.stop); }));
  });
}

}  // namespace ninedof::python
