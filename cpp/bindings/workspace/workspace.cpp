#include "ninedof/workspace/workspace.hpp"

#include "ninedof/workspace/region_share.hpp"
#include "support/interruptible.hpp"
#include "support/module.hpp"
#include "support/struct.hpp"
#include "support/workspace_question.hpp"

namespace ninedof::python {
namespace {

/// The sides of the cells, shape (n, 3); zero for the points of a sample.
Array sides_of(const WorkspaceMap& map) {
  std::vector<Vec3> sides;
  for (const std::uint8_t level : map.cells.level)
    sides.push_back(map.resolution > 0 ? Vec3((map.high - map.low) / (map.resolution * std::ldexp(1.0, level)))
                                       : Vec3(Vec3::Zero()));
  return array_from(sides);
}

Array levels_of(const WorkspaceMap& map) {
  Array out(std::vector<py::ssize_t>{std::ssize(map.levels), 4});
  double* to = out.mutable_data();
  for (const WorkspaceLevel& l : map.levels)
    to = python::write(
        Eigen::Vector4d(static_cast<double>(l.cells), static_cast<double>(l.evaluations), l.volume, l.error), to);
  return out;
}

void bind_map(py::module_& m) {
  py::class_<WorkspaceCells>(m, "WorkspaceCells", "The cells of a map.")
      .def_property_readonly("centre", points_of(&WorkspaceCells::centre), "Coordinates of the map, shape (n, 3).")
      .def_property_readonly("state", column_of<std::uint8_t>(&WorkspaceCells::state),
                             "0 outside, 1 boundary, 2 inside, shape (n,).")
      .def_property_readonly("limit", column_of<std::int16_t>(&WorkspaceCells::limit),
                             "Index into workspace_limits of what limits it here, -1 for none, shape (n,).")
      .def_property_readonly("fraction", column_of<double>(&WorkspaceCells::fraction),
                             "Allowed part of each cell, shape (n,).")
      .def_property_readonly("condition_number", column_of<double>(&WorkspaceCells::condition_number),
                             "At the centre, of a set its best or worst rotation, shape (n,).")
      .def_property_readonly("piece", column_of<std::int32_t>(&WorkspaceCells::piece),
                             "0 for the piece that is counted first, -1 outside, shape (n,).");
  py::class_<MapAudit>(m, "MapAudit", "How often continuation missed a better O.")
      .def_readonly("poses", &MapAudit::poses, "Searched anew.")
      .def_readonly("missed", &MapAudit::missed, "Of them, those where a better point was found.")
      .def_readonly("largest", &MapAudit::largest,
                    "Greatest relative difference; infinite where the map had no point.");
  py::class_<WorkspaceMap>(m, "WorkspaceMap", "A workspace: what the public class of this name adds to is said there.")
      .def_property_readonly(
          "status", [](const WorkspaceMap& map) { return to_string(map.status); },
          "converged, limited, empty or stopped.")
      .def_readonly("volume", &WorkspaceMap::volume, "Lengths cubed, or radians cubed.")
      .def_readonly("error", &WorkspaceMap::error, "Estimate of the error of the volume.")
      .def_readonly("unseen", &WorkspaceMap::unseen,
                    "Bound, at 95 % confidence, of the volume of a feature that nothing shows; part of the error.")
      .def_readonly("chart_volume", &WorkspaceMap::chart_volume, "Of the box or region that was searched.")
      .def_readonly("box_limits", &WorkspaceMap::box_limits, "Whether the workspace reaches the faces of the box.")
      .def_readonly("home_allowed", &WorkspaceMap::home_allowed, "Whether home is in the workspace.")
      .def_property_readonly(
          "home_limit",
          [](const WorkspaceMap& map) {
            return map.home_limit < 0 ? std::string() : limit_names()[static_cast<std::size_t>(map.home_limit)];
          },
          "The limit that home violates; \"\" for none.")
      .def_property_readonly("pieces", column_of<double>(&WorkspaceMap::pieces),
                             "Volumes of the connected pieces, the one counted first, shape (k,).")
      .def_property_readonly(
          "ball_centre", [](const WorkspaceMap& map) { return array_from(map.ball.centre); },
          "Of the largest inscribed ball, shape (3,).")
      .def_property_readonly(
          "ball_radius", [](const WorkspaceMap& map) { return map.ball.radius; }, "In coordinates of the map.")
      .def_property_readonly(
          "box_low", [](const WorkspaceMap& map) { return array_from(map.box.low); },
          "Of the largest inscribed box, shape (3,).")
      .def_property_readonly(
          "box_high", [](const WorkspaceMap& map) { return array_from(map.box.high); }, "Shape (3,).")
      .def_readonly("conditioning_index", &WorkspaceMap::conditioning_index, "Mean of 1 / condition number.")
      .def_readonly("conditioning_index_error", &WorkspaceMap::conditioning_index_error, "Estimate of its error.")
      .def_readonly("worst_condition_number", &WorkspaceMap::worst_condition_number, "The greatest over the workspace.")
      .def_property_readonly("worst_at", copy_of(&WorkspaceMap::worst_at), "Where, shape (3,).")
      .def_property_readonly("percentiles", column_of<double>(&WorkspaceMap::percentiles),
                             "Of the condition number over the volume, at 0 to 100 %, shape (101,).")
      .def_readonly("boundary_area", &WorkspaceMap::boundary_area, "In coordinates of the map.")
      .def_property_readonly("limit_area", column_of<double>(&WorkspaceMap::limit_area),
                             "Part of it due to each of workspace_limits.")
      .def_property_readonly("levels", &levels_of, "Cells, evaluations, volume and error of each level, shape (k, 4).")
      .def_readonly("cells", &WorkspaceMap::cells, "At the end of the search, those outside included.")
      .def_property_readonly("sides", &sides_of, "Of the cells, shape (n, 3); 0 for the points of a sample.")
      .def_property_readonly("low", copy_of(&WorkspaceMap::low), "Of the map, shape (3,).")
      .def_property_readonly("high", copy_of(&WorkspaceMap::high), "Shape (3,).")
      .def_readonly("evaluations", &WorkspaceMap::evaluations, "Poses.")
      .def_readonly("internal_point_audit", &WorkspaceMap::internal_points, "Of the best O.");
}

}  // namespace

void bind_workspace(py::module_& m) {
  bind_map(m);
  m.attr("workspace_limits") = py::cast(limit_names());
  auto settings = request<WorkspaceSettings>(m, "WorkspaceSettings", "How a workspace is searched.");
  word_attribute(settings, "method", &WorkspaceSettings::method, std::array{"octree", "grid", "sample"},
                 "Cells divided at the boundary, all of one size, or points.");
  settings.def_readwrite("tolerance", &WorkspaceSettings::tolerance, "Of an octree, relative to the volume.")
      .def_readwrite("resolution", &WorkspaceSettings::resolution, "Cells along each side before any is divided.")
      .def_readwrite("most_evaluations", &WorkspaceSettings::most_evaluations, "Poses.")
      .def_readwrite("points", &WorkspaceSettings::points, "Of the audit, or of each shift of a sample.")
      .def_readwrite("shifts", &WorkspaceSettings::shifts, "Of a sample.")
      .def_readwrite("seed", &WorkspaceSettings::seed, "Of the audit and of a sample.")
      .def_readwrite("threads", &WorkspaceSettings::threads, "0: one for each processor.");
  m.def("workspace", [](const WorkspaceQuestion& q, const WorkspaceSettings& s, const py::object& progress) {
    return interruptible(
        progress,
        [&](const Control& control) { return workspace(q.geometry, q.domain, q.rule, q.criteria, s, q.home, control); },
        [](WorkspaceMap& map) {
          map.status = WorkspaceStatus::stopped;
          return true;
        });
  });
  py::class_<RegionShare>(m, "RegionShare", "How much of a region keeps the criteria of a workspace.")
      .def_readonly("share", &RegionShare::share, "Of even poses of the region that keep every criterion, 0 to 1.")
      .def_readonly("looked_at", &RegionShare::poses, "Poses.")
      .def_property_readonly("passed", tuple_of(&RegionShare::passed), "Criteria that some pose violates.");
  m.def("region_share", [](const WorkspaceQuestion& q, const Region& region, long count) {
    return interruptible(py::none(), [&](const Control& control) {
      return region_share(q.geometry, q.home.value(), q.criteria, region, count, control);
    });
  });
  m.def("spread_rotations", [](int count, double angle) { return array_from(spread_rotations(count, angle)); });
}

}  // namespace ninedof::python
