#include "ninedof/workspace/workspace.hpp"

#include "ninedof/workspace/region_share.hpp"
#include "support/columns.hpp"
#include "support/interruptible.hpp"
#include "support/map_audit.hpp"
#include "support/module.hpp"
#include "support/region.hpp"
#include "support/workspace_question.hpp"

namespace ninedof::python {
namespace {

WorkspaceSettings workspace_settings_from(const py::dict& d) {
  using enum WorkspaceSettings::Method;
  return {word<WorkspaceSettings::Method>("method", d["method"].cast<std::string>(),
                                          {{"octree", octree}, {"grid", grid}, {"sample", sample}}),
          d["tolerance"].cast<double>(),
          d["resolution"].cast<int>(),
          d["most_evaluations"].cast<long>(),
          d["points"].cast<long>(),
          d["shifts"].cast<int>(),
          d["seed"].cast<std::uint64_t>(),
          d["threads"].cast<int>()};
}

py::dict dict_of(const WorkspaceCells& c) {
  py::dict out;
  out["centre"] = array_from(c.centre);
  out["level"] = column<std::uint8_t>(c.level);
  out["state"] = column<std::uint8_t>(c.state);
  out["limit"] = column<std::int16_t>(c.limit);
  out["fraction"] = column<double>(c.fraction);
  out["condition_number"] = column<double>(c.condition_number);
  out["piece"] = column<std::int32_t>(c.piece);
  return out;
}

py::dict dict_of(const WorkspaceMap& m) {
  py::dict out;
  out["status"] = to_string(m.status);
  out["volume"] = m.volume;
  out["error"] = m.error;
  out["unseen"] = m.unseen;
  out["chart_volume"] = m.chart_volume;
  out["box_limits"] = m.box_limits;
  out["home_allowed"] = m.home_allowed;
  out["home_limit"] = m.home_limit;
  out["pieces"] = column<double>(m.pieces);
  out["ball_centre"] = array_from(m.ball.centre);
  out["ball_radius"] = m.ball.radius;
  out["box_low"] = array_from(m.box.low);
  out["box_high"] = array_from(m.box.high);
  out["conditioning_index"] = m.conditioning_index;
  out["conditioning_index_error"] = m.conditioning_index_error;
  out["worst_condition_number"] = m.worst_condition_number;
  out["worst_at"] = array_from(m.worst_at);
  out["percentiles"] = column<double>(m.percentiles);
  out["boundary_area"] = m.boundary_area;
  out["limit_area"] = column<double>(m.limit_area);
  out["cells"] = dict_of(m.cells);
  Array levels(std::vector<py::ssize_t>{static_cast<py::ssize_t>(m.levels.size()), 4});
  for (std::size_t n = 0; n < m.levels.size(); ++n) {
    const WorkspaceLevel& l = m.levels[n];
    Eigen::Map<Eigen::Vector4d>(levels.mutable_data() + 4 * n) << static_cast<double>(l.cells),
        static_cast<double>(l.evaluations), l.volume, l.error;
  }
  out["levels"] = levels;
  out["low"] = array_from(m.low);
  out["high"] = array_from(m.high);
  out["evaluations"] = m.evaluations;
  out["internal_point_audit"] = audit_dict(m.internal_points);
  return out;
}

}  // namespace

void bind_workspace(py::module_& m) {
  m.attr("workspace_limits") = py::cast(limit_names());
  m.def("workspace",
        [](const Geometry& g, const py::dict& domain, const std::string& kind, double fraction, const Array& point,
           const py::dict& criteria, const py::dict& settings, const py::object& home, const py::object& progress) {
          const WorkspaceDomain d = domain_from(domain);
          const InternalPointRule rule = rule_from(kind, fraction, point);
          const WorkspaceCriteria c = criteria_from(criteria);
          const WorkspaceSettings s = workspace_settings_from(settings);
          const std::optional<Configuration> at_home = home_from(home);
          return dict_of(interruptible(
              progress, [&](const Control& control) { return workspace(g, d, rule, c, s, at_home, control); },
              [](WorkspaceMap& map) {
                map.status = WorkspaceStatus::stopped;
                return true;
              }));
        });
  m.def("region_share",
        [](const Geometry& g, const py::object& home, const py::dict& criteria, const py::dict& region, long count) {
          const Configuration at_home = home_from(home).value();
          const WorkspaceCriteria asked = criteria_from(criteria);
          const Region over = region_from(region);
          const RegionShare found = interruptible(py::none(), [&](const Control& control) {
            return region_share(g, at_home, asked, over, count, control);
          });
          return py::make_tuple(found.share, found.poses, py::tuple(py::cast(found.passed)));
        });
  m.def("spread_rotations", [](int count, double angle) {
    const std::vector<Mat3> rotations = spread_rotations(count, angle);
    Array out(std::vector<py::ssize_t>{static_cast<py::ssize_t>(rotations.size()), 3, 3});
    double* to = out.mutable_data();
    for (const Mat3& q : rotations) to = write(q, to);
    return out;
  });
}

}  // namespace ninedof::python
