#include "ninedof/workspace/statistics.hpp"

#include "support/cell_map.hpp"
#include "support/interruptible.hpp"
#include "support/module.hpp"
#include "support/struct.hpp"
#include "support/workspace_question.hpp"

namespace ninedof::python {

void bind_workspace_statistics(py::module_& m) {
  const auto place = [](Vec3 IndexStatistics::* at) {
    return [at](const IndexStatistics& s) { return array_from(s.*at).attr("tolist")(); };
  };
  py::class_<IndexStatistics>(m, "IndexStatistics", "An index over a workspace.")
      .def_readonly("mean", &IndexStatistics::mean, "Over the volume.")
      .def_readonly("least", &IndexStatistics::least, "The least value.")
      .def_property_readonly("least_at", place(&IndexStatistics::least_at), "Where, three coordinates of the map.")
      .def_readonly("greatest", &IndexStatistics::greatest, "The greatest value.")
      .def_property_readonly("greatest_at", place(&IndexStatistics::greatest_at),
                             "Where, three coordinates of the map.");
  py::class_<WorkspacePoses>(m, "WorkspacePoses", "The poses at the centres of cells.")
      .def_property_readonly(
          "configurations", [](const WorkspacePoses& poses) { return stack_of(poses.configurations); },
          "A stack, one for each centre.")
      .def("statistics", [](const WorkspacePoses& poses, const Array& values, bool by_modulus) {
        return statistics_of(poses, {values.data(), static_cast<std::size_t>(values.size())}, by_modulus);
      });
  m.def("workspace_poses", [](const WorkspaceQuestion& q, const py::object& map, bool first_piece_alone) {
    const WorkspaceMap known = map_from(map);
    return interruptible(
        py::none(), [&](const Control&) { return poses_of(q.geometry, q.domain, q.rule, known, first_piece_alone); });
  });
}

}  // namespace ninedof::python
