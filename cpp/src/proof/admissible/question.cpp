/// What may be asked of sets of designs. Declared in ninedof/proof/admissible.hpp.

#include <algorithm>
#include <cmath>

#include "limits/table.hpp"
#include "math/numbers.hpp"
#include "ninedof/math/error.hpp"
#include "ninedof/proof/admissible.hpp"

namespace ninedof {

void DesignQuestion::validate(bool machine) const {
  problem.validate();
  const auto& variables = design_family(problem.family).variables();
  if (at.size() != variables.size())
    throw InvalidArgument("at", std::to_string(at.size()) + " values", std::to_string(variables.size()));
  if (varied.empty() != machine || varied.size() > most_varied)
    throw InvalidArgument("vary", std::to_string(varied.size()) + " variables", machine ? "none" : "one to six");
  if (low.size() != varied.size() || high.size() != varied.size())
    throw InvalidArgument("low, high", "other sizes", "an end for each variable that varies");
  for (std::size_t k = 0; k < varied.size(); ++k) {
    const int index = varied[k];
    if (index < 0 || static_cast<std::size_t>(index) >= variables.size() || std::ranges::count(varied, index) != 1)
      throw InvalidArgument("vary", std::to_string(index), "variables of the family, each once");
    const VariableInfo& variable = variables[static_cast<std::size_t>(index)];
    if (variable.kind == VariableKind::length && low[k] < 0.0)
      throw InvalidArgument(variable.name, format_interval(low[k], high[k]), "a length, low >= 0");
    if (!(low[k] < high[k] && std::isfinite(low[k]) && std::isfinite(high[k])))
      throw InvalidArgument(variables[static_cast<std::size_t>(index)].name, format_interval(low[k], high[k]),
                            "low < high, both finite");
  }
  for (std::size_t k = 0; k < at.size(); ++k) {
    require_finite(variables[k].name.c_str(), at[k]);
    if (variables[k].kind == VariableKind::length && at[k] < 0.0)
      throw InvalidArgument(variables[k].name, format_number(at[k]), "a length, at least 0");
  }
  if (region.size() > 1) throw InvalidArgument("region", std::to_string(region.size()) + " regions", "none or one");
  for (const Region& one : region) {
    one.validate();
    if (one.placed) throw InvalidArgument("region", "O placed anew at every pose", "O shifted with p, or held");
  }
  for (const Pose& pose : problem.objective.poses)
    if (pose.best_internal) throw InvalidArgument("poses", "O chosen at a pose", "poses that say where O is");
  if (!(condition > 1.0)) throw InvalidArgument("condition", format_number(condition), "a number above 1");
  const bool bounded = std::isfinite(condition) || std::isfinite(problem.objective.condition_limit) ||
                       std::isfinite(problem.objective.neutral_condition_limit);
  bool locked = false;
  for (const Limit& limit : problem.limits) {
    const LimitRow& row = limit_row(limit.name);
    if (row.pose != nullptr && row.pose->first_locked >= 0) locked = true;
    else if (row.pose != nullptr && !row.pose->pairs && row.pose->design_form == nullptr)
      throw InvalidArgument(limit.label(), "a limit without bounds over boxes of designs", "a study without it");
    const bool way_outside =
        region.empty() ? !problem.objective.poses.empty() : region.front().shape == Region::Shape::path;
    if (row.on_the_way() && limit.at == LimitAt::poses && way_outside)
      throw InvalidArgument(limit.label(), "a limit of the ways to poses", "a region that has these ways in it");
    if (row.spread != nullptr && limit.low > 0.0)
      throw InvalidArgument(limit.label(), "a least value", "a greatest value alone");
  }
  if ((bounded || locked) && problem.characteristic_length.choice != StudyLength::Choice::number)
    throw InvalidArgument("characteristic_length", "one that depends on the design",
                          "a number, where the condition number is limited");
}

}  // namespace ninedof
