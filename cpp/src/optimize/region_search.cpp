#include "ninedof/optimize/region_search.hpp"

#include <algorithm>

#include "math/numbers.hpp"
#include "optimize/region/design_at_poses.hpp"
#include "problem/full_variables.hpp"

namespace ninedof {
RegionWorst search_region(const Problem& problem, const Region& region, const Eigen::VectorXd& variables,
                          const RegionSettings& settings, const Control& control) {
  problem.validate();
  region.validate();
  require_full("variables", problem, variables);
  const DesignAtPoses design(problem, region, variables);
  const auto make = [&] { return std::make_unique<DesignAtPoses>(problem, region, variables); };
  const RegionExtremes found = region_extremes(region, make, settings, control);

  RegionWorst out;
  out.poses = found.poses;
  for (int k = 0; k < design.margins(); ++k)
    for (const MetNumber& met : found.ends[at_index(RegionNumber::first_margin + k)])
      out.limits.push_back({design.margin_name(k), k, design.shown_margin(k, met.value).value, met.at});
  for (const MetNumber& met : found.ends[RegionNumber::index]) out.index.push_back({-met.value, met.at});
  for (int leg = 0; leg < 9; ++leg) {
    out.shortest_at[at_index(leg)] = found.least(at_index(RegionNumber::shortest + leg)).at;
    out.longest_at[at_index(leg)] = found.least(at_index(RegionNumber::longest + leg)).at;
  }
  return out;
}

}  // namespace ninedof
