/// Declared in ninedof/optimize/optimize.hpp.

#include <cmath>

#include "ninedof/math/rotation.hpp"
#include "optimize/minimax/minimax.hpp"

namespace ninedof {
namespace {

/// Lengths below zero are no robot, and no bound has kept them out here.
void require_robot(const Problem& problem, const Eigen::VectorXd& x) {
  const std::vector<Variable> all = full_variables(problem);
  for (std::size_t k = 0; k < all.size(); ++k) {
    const double value = x[static_cast<Eigen::Index>(k)];
    if (all[k].kind == VariableKind::length && value < 0.0)
      throw InvalidArgument(all[k].name, format_number(value), "a length >= 0");
  }
}

}  // namespace

Evaluation evaluate(const Problem& problem, const Eigen::VectorXd& variables) {
  problem.validate();
  require_full("variables", problem, variables);
  require_robot(problem, variables);
  const Prepared p(problem);
  Look l;
  look(p, variables, l);
  Eigen::VectorXd level_slopes;
  p.objective(l.levels, &level_slopes);
  Evaluation out;
  // A pose that is singular spoils the worst, whatever its share.
  constexpr double singular = 460.0;
  const bool spoilt =
      p.levels > p.looked && p.levels > 1 && level_slopes[p.levels - 1] > 0.0 && l.levels.maxCoeff() > singular;
  out.log_objective = spoilt ? l.levels.maxCoeff() : l.log_objective;
  out.gradient = ruling_gradient(p, l, level_slopes);
  out.condition_number = neutral_condition(p, l);
  out.conditions = conditions(p, l);
  out.characteristic_length = l.view.characteristic_length;
  for (Eigen::Index k = 0; k < l.m.size(); ++k) {
    const std::string& name = p.margin_name(static_cast<int>(k));
    const Eigen::VectorXd gradient = l.m_gradient.row(k).transpose();
    if (out.margins.empty() || out.margins.back().name != name) out.margins.push_back({name, l.m[k], gradient});
    else if (l.m[k] < out.margins.back().value) out.margins.back() = {name, l.m[k], gradient};
  }
  return out;
}

namespace {

DesignState view_of(const Problem& problem, const Eigen::VectorXd& variables) {
  problem.validate();
  require_full("variables", problem, variables);
  const Prepared p(problem);
  DesignState v;
  v.set(*p.family, p.coordinates, problem.characteristic_length, p.places, p.looked, variables);
  return v;
}

}  // namespace

double characteristic_length(const Problem& problem, const Eigen::VectorXd& variables) {
  return view_of(problem, variables).characteristic_length;
}

std::vector<Configuration> configurations(const Problem& problem, const Eigen::VectorXd& variables) {
  const DesignState v = view_of(problem, variables);
  std::vector<Configuration> out;
  for (std::size_t k = 0; k <= problem.objective.poses.size(); ++k) {
    const PoseState& pose = v.poses[k];
    out.push_back({pose.at[point_p], pose.rotation, pose.at[point_s]});
  }
  return out;
}

}  // namespace ninedof
