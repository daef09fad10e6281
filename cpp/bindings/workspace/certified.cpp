#include "ninedof/workspace/certified.hpp"

#include <pybind11/stl.h>

#include "support/columns.hpp"
#include "support/interruptible.hpp"
#include "support/module.hpp"
#include "support/workspace_question.hpp"

namespace ninedof::python {
namespace {

constexpr std::array beyond{"nothing", "something", "unknown"};

py::tuple ends_of_volume(const VolumeBounds& v) {
  return py::make_tuple(v.low, v.high);
}

py::dict dict_of_certified(const CertifiedWorkspace& c) {
  py::dict out;
  constexpr std::array ends{"gap", "time", "boxes", "stopped", "smallest"};
  out["end"] = ends[static_cast<std::size_t>(c.end)];
  out["volume"] = ends_of_volume(c.volume);
  out["home_volume"] = ends_of_volume(c.home_volume);
  out["home_inside"] = c.home_inside;
  out["home_outside"] = c.home_outside;
  out["beyond"] = beyond[static_cast<std::size_t>(c.beyond)];
  out["box_low"] = array_from(c.box_low);
  out["box_high"] = array_from(c.box_high);
  out["low"] = array_from(c.low);
  out["high"] = array_from(c.high);
  out["inner_low"] = array_from(c.inner_low);
  out["inner_high"] = array_from(c.inner_high);
  out["open_low"] = array_from(c.open_low);
  out["open_high"] = array_from(c.open_high);
  Array volumes(std::vector<py::ssize_t>{static_cast<py::ssize_t>(c.open_volume.size()), 2});
  for (std::size_t n = 0; n < c.open_volume.size(); ++n) {
    volumes.mutable_data()[2 * n] = c.open_volume[n].low;
    volumes.mutable_data()[2 * n + 1] = c.open_volume[n].high;
  }
  out["open_volume"] = volumes;
  out["first_cut"] = column<std::int64_t>(c.first_cut);
  Array cuts(std::vector<py::ssize_t>{static_cast<py::ssize_t>(c.cuts.size()), 5});
  for (std::size_t n = 0; n < c.cuts.size(); ++n) {
    double* to = cuts.mutable_data() + 5 * n;
    Eigen::Map<Vec3>{to} = c.cuts[n].slope;
    to[3] = c.cuts[n].allowed;
    to[4] = c.cuts[n].forbidden;
  }
  out["cuts"] = cuts;
  out["looked"] = c.looked;
  return out;
}

/// The boxes of a CertifiedWorkspace and their planes; of the rest, what its states need.
CertifiedWorkspace certified_from(const py::object& given) {
  CertifiedWorkspace out;
  const bool nothing = given.attr("beyond").cast<std::string>() == beyond[0];
  out.beyond = nothing ? CertifiedWorkspace::Beyond::nothing : CertifiedWorkspace::Beyond::unknown;
  out.box_low = vec3_of(given.attr("box_low").cast<Array>());
  out.box_high = vec3_of(given.attr("box_high").cast<Array>());
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
  m.def("certified_workspace",
        [](const Geometry& g, const py::dict& domain, const std::string& kind, double fraction, const Array& point,
           const py::dict& criteria, const py::dict& settings, const py::object& home, const py::object& progress) {
          const WorkspaceDomain d = domain_from(domain);
          const InternalPointRule rule = rule_from(kind, fraction, point);
          const WorkspaceCriteria c = criteria_from(criteria);
          const CertifySettings s{settings["gap"].cast<double>(), settings["seconds"].cast<double>(),
                                  settings["threads"].cast<int>(), settings["boxes"].cast<long>()};
          const std::optional<Configuration> at_home = home_from(home);
          return dict_of_certified(interruptible(
              progress, [&](const Control& control) { return certified_workspace(g, d, rule, c, s, at_home, control); },
              [](CertifiedWorkspace& found) {
                found.end = CertifiedWorkspace::End::stopped;
                return true;
              }));
        });
  m.def("certified_states", [](const py::object& certified, const Array& points) {
    const CertifiedWorkspace found = certified_from(certified);
    const std::vector<Vec3> at = points_from("points", points);
    return column<std::int8_t>(
        interruptible(py::none(), [&](const Control& control) { return proved_states(found, at, control.stop); }));
  });
}

}  // namespace ninedof::python
