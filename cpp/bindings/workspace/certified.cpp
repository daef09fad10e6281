#include "ninedof/workspace/certified.hpp"

#include <pybind11/stl.h>

#include "support/arrays.hpp"
#include "support/interruptible.hpp"
#include "support/module.hpp"
#include "support/workspace_question.hpp"

namespace ninedof::python {
namespace {

Array rows_of(const std::vector<Vec3>& values) {
  Array out(std::vector<py::ssize_t>{static_cast<py::ssize_t>(values.size()), 3});
  for (std::size_t n = 0; n < values.size(); ++n) Eigen::Map<Vec3>(out.mutable_data() + 3 * n) = values[n];
  return out;
}

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
  constexpr std::array beyond{"nothing", "something", "unknown"};
  out["beyond"] = beyond[static_cast<std::size_t>(c.beyond)];
  out["low"] = array_from(c.low);
  out["high"] = array_from(c.high);
  out["inner_low"] = rows_of(c.inner_low);
  out["inner_high"] = rows_of(c.inner_high);
  out["open_low"] = rows_of(c.open_low);
  out["open_high"] = rows_of(c.open_high);
  Array volumes(std::vector<py::ssize_t>{static_cast<py::ssize_t>(c.open_volume.size()), 2});
  for (std::size_t n = 0; n < c.open_volume.size(); ++n) {
    volumes.mutable_data()[2 * n] = c.open_volume[n].low;
    volumes.mutable_data()[2 * n + 1] = c.open_volume[n].high;
  }
  out["open_volume"] = volumes;
  py::array_t<std::int64_t> first(static_cast<py::ssize_t>(c.first_cut.size()));
  std::copy(c.first_cut.begin(), c.first_cut.end(), first.mutable_data());
  out["first_cut"] = first;
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
}

}  // namespace ninedof::python
