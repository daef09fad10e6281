/// What is asked of a workspace: poses, where O is, limits.

#include "support/module.hpp"
#include "support/struct.hpp"
#include "support/workspace_question.hpp"

namespace ninedof::python {
namespace {

void set_rotations(WorkspaceDomain& d, const Array& rows) {
  d.rotations.clear();
  for (py::ssize_t k = 0; k < rows.size() / 9; ++k)
    d.rotations.emplace_back(Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(rows.data() + 9 * k));
}

void bind_domain(py::module_& m) {
  auto region = request<OrientationRegion>(m, "OrientationRegion", "A region of rotations about one of them.");
  word_attribute(region, "chart", &OrientationRegion::chart, std::array{"rotation_vector", "tilt_torsion"},
                 "Its coordinates.");
  region.def_readwrite("angle", &OrientationRegion::angle, "The greatest, or the greatest tilt, radians.")
      .def_readwrite("torsion_low", &OrientationRegion::torsion_low, "Radians.")
      .def_readwrite("torsion_high", &OrientationRegion::torsion_high, "Radians.");
  auto domain = request<WorkspaceDomain>(m, "WorkspaceDomain", "The set of poses of a workspace.");
  word_attribute(domain, "archetype", &WorkspaceDomain::archetype,
                 std::array{"constant_orientation", "orientation", "reachable", "inclusive"}, "The kind of set.");
  domain.def_readwrite("low", &WorkspaceDomain::low, "Corner of the box of positions.")
      .def_readwrite("high", &WorkspaceDomain::high, "The opposite corner.")
      .def_readwrite("position", &WorkspaceDomain::position, "Of orientations.")
      .def_property("rotations", copy_of(&WorkspaceDomain::rotations), &set_rotations,
                    "The one, the centre of the region, or the set.")
      .def_readwrite("region", &WorkspaceDomain::region, "Of orientations.");
}

}  // namespace

void bind_workspace_question(py::module_& m) {
  bind_domain(m);
  auto rule = request<InternalPointRule>(m, "InternalPointRule", "Where O is at each pose.");
  word_attribute(rule, "kind", &InternalPointRule::kind, std::array{"fixed", "between", "platform", "best"},
                 "In the base, between the plates, in the platform, or where the condition number is least.");
  rule.def_readwrite("fraction", &InternalPointRule::fraction,
                     "Of the way from the lower to the upper internal joints.")
      .def_readwrite("point", &InternalPointRule::point, "In the frame of its body.");
  request<LegLimits>(m, "LegLimits", "Least and greatest lengths of the nine legs.")
      .def_readwrite("low", &LegLimits::low, "Shape (9,).")
      .def_readwrite("high", &LegLimits::high, "Shape (9,).");
  request<WorkspaceCriteria>(m, "WorkspaceCriteria", "The limits of an allowed pose.")
      .def_readwrite("legs", &WorkspaceCriteria::legs, "Limits of the lengths of legs, or None.")
      .def_property("limits", copy_of(&WorkspaceCriteria::limits), setter_of(&WorkspaceCriteria::limits),
                    "Other limits with a value at every pose, copied when they are read.")
      .def_readwrite("exempt", &WorkspaceCriteria::exempt, "The pairs of legs that may meet if their joints coincide.")
      .def_readwrite("condition_number", &WorkspaceCriteria::condition_number, "The greatest, or None.")
      .def_readwrite("characteristic_length", &WorkspaceCriteria::characteristic_length, "Of the condition number.");
  py::class_<WorkspaceQuestion>(m, "WorkspaceQuestion", "A workspace that is asked for.")
      .def(py::init([](const Geometry& g, const py::kwargs& given) {
        return with_keywords(WorkspaceQuestion{g, {}, {}, {}, {}}, given);
      }))
      .def_readonly("geometry", &WorkspaceQuestion::geometry, "The robot.")
      .def_readwrite("domain", &WorkspaceQuestion::domain, "The set of poses.")
      .def_readwrite("rule", &WorkspaceQuestion::rule, "Where O is.")
      .def_readwrite("criteria", &WorkspaceQuestion::criteria, "The limits of an allowed pose.")
      .def_readwrite("home", &WorkspaceQuestion::home, "The home pose; None for the middle of the domain.");
}

}  // namespace ninedof::python
