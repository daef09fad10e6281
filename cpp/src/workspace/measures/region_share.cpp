#include "ninedof/workspace/region_share.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>

#include "ninedof/conditioning/conditioning.hpp"
#include "ninedof/domains/region_sample.hpp"
#include "ninedof/limits/numbers.hpp"
#include "ninedof/math/error.hpp"
#include "ninedof/math/parallel.hpp"
#include "ninedof/robot/legs.hpp"
#include "workspace/criteria/limits.hpp"
#include "workspace/requirements.hpp"

namespace ninedof {
namespace {

constexpr long block = 512;  // of poses

struct JudgedLimit {
  LimitNumbers numbers;
  double low, high;

  bool keeps(const Configuration& c) const {
    std::array<double, 21> found{};
    numbers.at(c, found.data());
    return std::all_of(found.begin(), found.begin() + numbers.items(),
                       [&](double x) { return x >= low && !(x > high); });
  }
};

/// The criteria that are asked for, by name, and which of them a pose keeps.
class Judge {
 public:
  Judge(const Geometry& g, const Configuration& home, const WorkspaceCriteria& criteria) : g_(g), criteria_(criteria) {
    if (criteria.legs) names.emplace_back(leg_limits_name);
    const std::array<bool, 21> exempt = pairs_sharing_a_joint(g, criteria.exempt);
    for (const PoseCriterion& c : criteria_besides_legs(criteria)) {
      if (c.row->pose == nullptr) continue;
      names.emplace_back(c.row->info.name);
      // A determinant is positive on the side of home.
      const double low =
          c.row->info.kind == LimitKind::sign ? std::max(c.low, std::numeric_limits<double>::min()) : c.low;
      limits_.push_back(
          {LimitNumbers(names.back(), g, home, criteria.characteristic_length, c.options, exempt), low, c.high});
    }
    if (criteria.condition_number) names.emplace_back("condition_number");
  }

  /// In the order of `names`.
  std::vector<bool> keeps(const Configuration& c) const {
    std::vector<bool> out;
    if (criteria_.legs) {
      const Vec9 lengths = leg_lengths(g_, c);
      out.push_back((lengths.array() >= criteria_.legs->low.array()).all() &&
                    (lengths.array() <= criteria_.legs->high.array()).all());
    }
    for (const JudgedLimit& limit : limits_) out.push_back(limit.keeps(c));
    if (criteria_.condition_number)
      out.push_back(condition_number(g_, c, criteria_.characteristic_length) <= *criteria_.condition_number);
    return out;
  }

  std::vector<std::string> names;

 private:
  const Geometry& g_;
  const WorkspaceCriteria& criteria_;
  std::vector<JudgedLimit> limits_;
};

}  // namespace

RegionShare region_share(const Geometry& g, const Configuration& home, const WorkspaceCriteria& criteria,
                         const Region& region, long count, const Control& control) {
  region.validate();
  require_criteria(criteria);
  if (count < 1) throw InvalidArgument("count", std::to_string(count), "one or more");
  const Judge judge(g, home, criteria);
  const long blocks = (2 * count + block - 1) / block;
  std::vector<long> kept(at_index(blocks), 0);
  std::vector<std::vector<bool>> passed(at_index(blocks), std::vector<bool>(judge.names.size(), false));
  parallel_for(blocks, 1, 0, [&](long b, long) {
    if (control.stop.stop_requested()) return;
    for (long n = b * block; n < std::min(2 * count, (b + 1) * block); ++n) {
      const Vec6 at = n < count ? even_sample(region, n) : region_sample(region, n - count);
      const std::vector<bool> keeps = judge.keeps(region.configuration(at, home));
      for (std::size_t k = 0; k < keeps.size(); ++k)
        if (!keeps[k]) passed[at_index(b)][k] = true;
      if (n < count && std::ranges::find(keeps, false) == keeps.end()) ++kept[at_index(b)];
    }
  });
  if (control.stop.stop_requested()) throw Stopped{};
  RegionShare out;
  out.poses = 2 * count;
  out.share = static_cast<double>(std::accumulate(kept.begin(), kept.end(), 0L)) / static_cast<double>(count);
  for (std::size_t k = 0; k < judge.names.size(); ++k)
    if (std::ranges::any_of(passed, [k](const std::vector<bool>& some) { return some[k]; }))
      out.passed.push_back(judge.names[k]);
  return out;
}

}  // namespace ninedof
