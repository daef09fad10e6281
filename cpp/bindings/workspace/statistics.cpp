#include "ninedof/workspace/statistics.hpp"

#include "support/cell_map.hpp"
#include "support/interruptible.hpp"
#include "support/module.hpp"

namespace ninedof::python {
namespace {

/// One entry of each configuration, as a stack of arrays of `shape`.
template <class Entry>
auto entries_of(Entry Configuration::* entry, const std::vector<py::ssize_t>& shape) {
  return [=](const WorkspacePoses& poses) {
    std::vector<py::ssize_t> all{std::ssize(poses.configurations)};
    all.insert(all.end(), shape.begin(), shape.end());
    Array out(all);
    double* to = out.mutable_data();
    for (const Configuration& c : poses.configurations) to = python::write(c.*entry, to);
    return out;
  };
}

}  // namespace

void bind_workspace_statistics(py::module_& m) {
  py::class_<WorkspacePoses>(m, "WorkspacePoses")
      .def_property_readonly("position", entries_of(&Configuration::position, {3}))
      .def_property_readonly("rotation", entries_of(&Configuration::rotation, {3, 3}))
      .def_property_readonly("internal_point", entries_of(&Configuration::internal_point, {3}))
      .def("statistics", [](const WorkspacePoses& poses, const Array& values, bool by_modulus) {
        const IndexStatistics s =
            statistics_of(poses, {values.data(), static_cast<std::size_t>(values.size())}, by_modulus);
        return py::make_tuple(s.mean, s.least, array_from(s.least_at).attr("tolist")(), s.greatest,
                              array_from(s.greatest_at).attr("tolist")());
      });
  m.def("workspace_poses", [](const Geometry& g, const py::dict& domain, const std::string& kind, double fraction,
                              const Array& point, const py::object& cells, const std::pair<Array, Array>& ends,
                              bool first_piece_alone) {
    const WorkspaceDomain within = domain_from(domain);
    const InternalPointRule rule = rule_from(kind, fraction, point);
    const WorkspaceMap map = map_from(cells, ends);
    return interruptible(py::none(), [&](const Control&) { return poses_of(g, within, rule, map, first_piece_alone); });
  });
}

}  // namespace ninedof::python
