#include "problem/full_variables.hpp"

#include "ninedof/math/error.hpp"

namespace ninedof {
namespace {

/// Largest offset of s from its stated position, in zp: it reaches the other plate.
constexpr double reach = 1.0;
/// Range of an "optimal" characteristic length, in Problem::unit.
constexpr double smallest_length = 1e-4, largest_length = 1e4;

bool length_is_free(const StudyLength& l) {
  return l.choice == StudyLength::Choice::free ||
         (l.choice == StudyLength::Choice::kind && l.kind == LengthKind::optimal);
}

}  // namespace

bool optimizes_internal_point(const Pose& pose) {
  return pose.best_internal && !(pose.position.isZero(0.0) && pose.rotation.isZero(0.0));
}

bool on_axis(const Problem& problem, const Pose& pose) {
  const auto along_z = [](const Vec3& v) { return v.x() == 0.0 && v.y() == 0.0; };
  return design_family(problem.family).symmetric() && problem.tool.on_axis() && along_z(pose.position) &&
         along_z(pose.rotation) && along_z(pose.internal);
}

std::vector<Variable> full_variables(const Problem& problem) {
  std::vector<Variable> out;
  const auto& info = design_family(problem.family).variables();
  for (std::size_t k = 0; k < info.size() && k < problem.variables.size(); ++k)
    out.push_back({info[k].name, info[k].kind, problem.variables[k]});
  const StudyLength& l = problem.characteristic_length;
  if (l.choice == StudyLength::Choice::free) out.push_back({"characteristic_length", VariableKind::length, l.bounds});
  else if (length_is_free(l))
    out.push_back({"characteristic_length",
                   VariableKind::length,
                   {smallest_length * problem.unit(), largest_length * problem.unit()},
                   true});
  for (std::size_t k = 0; k < problem.objective.poses.size(); ++k) {
    const Pose& pose = problem.objective.poses[k];
    if (!optimizes_internal_point(pose)) continue;
    const std::string name = "pose" + std::to_string(k + 1) + ".s_";
    for (const char axis : {'x', 'y', 'z'})
      if (axis == 'z' || !on_axis(problem, pose))
        out.push_back({name + axis, VariableKind::fraction, {-reach, reach}, true});
  }
  return out;
}

int length_variable(const Problem& problem) {
  return length_is_free(problem.characteristic_length) ? static_cast<int>(problem.variables.size()) : -1;
}

std::array<int, 3> offset_variables(const Problem& problem, std::size_t k) {
  const auto& poses = problem.objective.poses;
  if (!optimizes_internal_point(poses[k])) return {-1, -1, -1};
  int at = static_cast<int>(problem.variables.size()) + (length_variable(problem) >= 0 ? 1 : 0);
  for (std::size_t j = 0; j < k; ++j)
    if (optimizes_internal_point(poses[j])) at += on_axis(problem, poses[j]) ? 1 : 3;
  if (on_axis(problem, poses[k])) return {-1, -1, at};
  return {at, at + 1, at + 2};
}

void require_full(const char* argument, const Problem& problem, const Eigen::VectorXd& x) {
  const auto count = static_cast<Eigen::Index>(full_variables(problem).size());
  if (x.size() != count || !x.allFinite())
    throw InvalidArgument(argument, std::to_string(x.size()) + " values" + (x.allFinite() ? "" : ", not all finite"),
                          std::to_string(count) + " finite ones, one for each variable");
}

}  // namespace ninedof
