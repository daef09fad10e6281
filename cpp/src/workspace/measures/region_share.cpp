#include "ninedof/workspace/region_share.hpp"

#include <algorithm>
#include <memory>

#include "ninedof/conditioning/conditioning.hpp"
#include "ninedof/domains/region_sample.hpp"
#include "ninedof/limits/numbers.hpp"
#include "ninedof/robot/legs.hpp"
#include "workspace/criteria/limits.hpp"

namespace ninedof {
namespace {

/// One criterion at poses.
struct Judge {
  std::string name;
  std::function<bool(const Configuration&)> keeps;
};

std::vector<Judge> judges_of(const Geometry& g, const Configuration& home, const WorkspaceCriteria& criteria) {
  std::vector<Judge> out;
  if (criteria.legs)
    out.push_back({"leg_limits", [&](const Configuration& c) {
                     const Vec9 lengths = leg_lengths(g, c);
                     return (lengths.array() >= criteria.legs->low.array()).all() &&
                            (lengths.array() <= criteria.legs->high.array()).all();
                   }});
  const std::array<bool, 21> exempt = pairs_sharing_a_joint(g, criteria.exempt);
  for (const PoseCriterion& c : criteria_besides_legs(criteria)) {
    const std::string name = c.row->info.name;
    if (c.row->pose == nullptr) {
      out.push_back({name, [&g, c, length = criteria.characteristic_length](const Configuration& at) {
                       return condition_number(g, at, length) <= c.high;
                     }});
      continue;
    }
    // A determinant is on the side of home where it is positive.
    const double low =
        c.row->info.kind == LimitKind::sign ? std::max(c.low, std::numeric_limits<double>::min()) : c.low;
    const auto numbers = std::make_shared<LimitNumbers>(name, g, home, c.axis);
    out.push_back({name, [=, pairs = c.row->pose->pairs](const Configuration& at) {
                     std::array<double, 21> found{};
                     numbers->at(at, found.data());
                     for (int item = 0; item < numbers->items(); ++item) {
                       const double x = found[at_index(item)];
                       if (!(pairs && exempt[at_index(item)]) && !(x >= low && x <= c.high)) return false;
                     }
                     return true;
                   }});
  }
  return out;
}

}  // namespace

RegionShare region_share(const Geometry& g, const Configuration& home, const WorkspaceCriteria& criteria,
                         const Region& region, long count) {
  region.validate();
  const std::vector<Judge> judges = judges_of(g, home, criteria);
  RegionShare out;
  std::vector<bool> passed(judges.size(), false);
  long kept = 0;
  for (long n = 0; n < 2 * count; ++n) {
    const Vec6 at = n < count ? even_sample(region, n) : region_sample(region, n - count);
    const Configuration c = region.configuration(at, home);
    bool all = true;
    for (std::size_t k = 0; k < judges.size(); ++k) {
      const bool keeps = judges[k].keeps(c);
      all = all && keeps;
      passed[k] = passed[k] || !keeps;
    }
    kept += n < count && all ? 1 : 0;
  }
  out.share = static_cast<double>(kept) / static_cast<double>(std::max(count, 1L));
  out.poses = 2 * count;
  for (std::size_t k = 0; k < judges.size(); ++k)
    if (passed[k]) out.passed.push_back(judges[k].name);
  return out;
}

}  // namespace ninedof
