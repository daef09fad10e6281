#include "ninedof/problem/problem.hpp"

#include <algorithm>
#include <cmath>

#include "limits/table.hpp"
#include "math/numbers.hpp"
#include "ninedof/math/error.hpp"
#include "ninedof/math/length_range.hpp"
#include "problem/design_state.hpp"

namespace ninedof {
namespace {

void require_bounds(const std::string& name, VariableKind kind, const Bounds& b) {
  const std::string text = format_interval(b.low, b.high);
  if (!(b.low <= b.high)) throw InvalidArgument(name, text, "low <= high, both numbers");
  if (b.low == b.high) require_finite(name.c_str(), b.low);
  if (kind == VariableKind::length && b.low < 0.0) throw InvalidArgument(name, text, "a length, low >= 0");
}

DesignState state_of(const Problem& problem, const Eigen::VectorXd& variables) {
  problem.validate();
  require_full("variables", problem, variables);
  const Coordinates coordinates = Coordinates::plain(problem);
  DesignState state;
  state.set(design_family(problem.family), problem, coordinates, pose_specs(problem, coordinates),
            static_cast<int>(problem.objective.poses.size()), variables);
  return state;
}

}  // namespace

double Problem::unit() const {
  using Choice = StudyLength::Choice;
  if (characteristic_length.choice == Choice::number) return characteristic_length.value;
  if (characteristic_length.choice == Choice::free)
    return std::sqrt(characteristic_length.bounds.low) * std::sqrt(characteristic_length.bounds.high);
  // From the bounds, so that a study in other units of length gives the same run.
  const auto& info = design_family(family).variables();
  double smallest = infinity;
  for (std::size_t k = 0; k < info.size() && k < variables.size(); ++k)
    if (info[k].kind == VariableKind::length && variables[k].high > 0.0)
      smallest = std::min(smallest, variables[k].high);
  return std::isfinite(smallest) ? 0.1 * smallest : 1.0;
}

std::vector<std::string> Problem::names() const {
  std::vector<std::string> out;
  for (const Variable& v : full_variables(*this)) out.push_back(v.name);
  return out;
}

void Problem::validate() const {
  const DesignFamily& f = design_family(family);
  const auto& info = f.variables();
  using Choice = StudyLength::Choice;
  if (characteristic_length.choice == Choice::number)
    require_length("characteristic_length", characteristic_length.value);
  if (characteristic_length.choice == Choice::free) {
    const Bounds& b = characteristic_length.bounds;
    require_bounds("characteristic_length", VariableKind::length, b);
    if (!(b.low > 0.0) || !std::isfinite(b.high))
      throw InvalidArgument("characteristic_length", format_interval(b.low, b.high), "0 < low <= high, both finite");
    for (const double end : {b.low, b.high}) require_length("characteristic_length", end);
  }
  if (variables.size() != info.size())
    throw InvalidArgument("variables", std::to_string(variables.size()) + " bounds",
                          std::to_string(info.size()) + ", one for each variable of " + family);
  for (std::size_t k = 0; k < info.size(); ++k) require_bounds(info[k].name, info[k].kind, variables[k]);
  for (std::size_t k = 0; k < limits.size(); ++k) {
    limits[k].validate();
    for (std::size_t j = 0; j < k; ++j)
      if (limits[j].label() == limits[k].label() && limit_row(limits[j].name).on_the_way())
        throw InvalidArgument(limits[k].label(), "two limits", "one, with one number of steps");
  }
  objective.validate();
  tool.validate();
  if (objective.index == Index::six_legged && !f.symmetric())
    throw InvalidArgument("objective.index", "\"six_legged\"", "a family symmetric about z with it, not " + family);
  if (objective.index == Index::six_legged && !tool.on_axis())
    throw InvalidArgument("objective.index", "\"six_legged\" and a tool beside the axis of the platform",
                          "[tool] position = [0, 0, z] with it");
  // Some design within the bounds must be a robot: throws where both sides of a plate are fixed at zero.
  std::vector<double> ordinary;
  for (std::size_t k = 0; k < info.size(); ++k) {
    const double size = info[k].kind == VariableKind::length ? unit() : 0.0;
    ordinary.push_back(std::clamp(size, variables[k].low, variables[k].high));
  }
  if (f.symmetric()) f.geometry(ordinary);
}

double characteristic_length(const Problem& problem, const Eigen::VectorXd& variables) {
  return state_of(problem, variables).characteristic_length;
}

Geometry geometry(const Problem& problem, const Eigen::VectorXd& variables) {
  if (variables.size() < std::ssize(problem.variables))
    throw InvalidArgument("variables", std::to_string(variables.size()) + " values",
                          std::to_string(problem.variables.size()));
  return problem.tool.seen(design_family(problem.family).geometry({variables.data(), problem.variables.size()}));
}

std::vector<Configuration> configurations(const Problem& problem, const Eigen::VectorXd& variables) {
  const DesignState state = state_of(problem, variables);
  std::vector<Configuration> out;
  for (std::size_t k = 0; k <= problem.objective.poses.size(); ++k) {
    const PoseState& pose = state.poses[k];
    out.push_back({pose.at[point_p], pose.rotation, pose.at[point_s]});
  }
  return out;
}

}  // namespace ninedof
