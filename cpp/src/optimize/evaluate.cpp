#include "ninedof/optimize/evaluate.hpp"

#include "ninedof/math/error.hpp"
#include "optimize/minimax/subproblem.hpp"

namespace ninedof {
namespace {

/// Throws for negative lengths: bounds are not enforced here.
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
  const PreparedProblem p(problem);
  DesignEvaluation design;
  evaluate_design(p, variables, design);
  Eigen::VectorXd level_slopes;
  p.objective(design.levels, &level_slopes);
  Evaluation out;
  // With weights, a singular pose decides however small its share: the largest level alone is the objective.
  constexpr double singular = 460.0;
  const bool decisive = p.levels > p.mean_weights.size() && p.levels > 1 && level_slopes[p.levels - 1] > 0.0 &&
                        design.levels.maxCoeff() > singular;
  out.log_objective = decisive ? design.levels.maxCoeff() : design.log_objective;
  out.gradient = objective_gradient(p, design, level_slopes);
  out.condition_number = neutral_condition(p, design);
  out.conditions = conditions(p, design);
  out.characteristic_length = design.state.characteristic_length;
  for (Eigen::Index k = 0; k < design.margins.size(); ++k) {
    const std::string& name = p.margin_name(static_cast<int>(k));
    const auto [value, slope] = p.shown_margin(static_cast<int>(k), design.margins[k]);
    const bool first = out.margins.empty() || out.margins.back().name != name;
    if (!first && !(value < out.margins.back().value)) continue;
    if (first) out.margins.emplace_back();
    // With a leg of no length a ratio is infinite, and its margin has no gradient.
    const double by = std::isfinite(slope) ? slope : 0.0;
    out.margins.back() = {name, value, by * design.margin_gradient.row(k).transpose(),
                          p.limited_value(static_cast<int>(k), design.margins[k]), p.margin_part(static_cast<int>(k))};
  }
  return out;
}

}  // namespace ninedof
