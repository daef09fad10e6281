#include "workspace/criteria/limits_at_points.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "math/numbers.hpp"
#include "ninedof/batch/batch.hpp"
#include "ninedof/limits/numbers.hpp"
#include "ninedof/math/error.hpp"
#include "ninedof/singularity/singularity.hpp"

namespace ninedof {
namespace {

constexpr double barely_outside = -std::numeric_limits<double>::min();

using RowMajor3 = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;

double size_of(const Geometry& g) {
  double most = 0.0;
  for (const Triple* t : {&g.base_external(), &g.base_internal(), &g.platform_external(), &g.platform_internal()})
    for (const Vec3& joint : *t) most = std::max(most, joint.norm());
  return most;
}

/// Whether one margin stands for all items: of pairs of legs, and of forces, rates and powers, where room for nine each
/// would be room at every point of every workspace.
bool in_one(const LimitRow& row) {
  return row.pose->pairs || *row.info.needs != '\0';
}

}  // namespace

/// Poses of one block in the layout of batch.hpp, and the results of the kernels.
struct LimitsAtPoints::Block {
  explicit Block(long count)
      : p(size(3 * count)),
        q(size(9 * count)),
        s(size(3 * count)),
        length(size(9 * count)),
        kappa(size(count)),
        det(size(3 * count)),
        found(size(count), 1) {}
  static std::size_t size(long n) { return at_index(n); }
  std::vector<double> p, q, s, length, kappa, det;
  std::vector<char> found;  // whether there is an admissible O
  bool one_rotation = true;

  Configuration at(long k) const {
    return {Eigen::Map<const Vec3>(&p[size(3 * k)]), Eigen::Map<const RowMajor3>(&q[one_rotation ? 0 : size(9 * k)]),
            Eigen::Map<const Vec3>(&s[size(3 * k)])};
  }
};

LimitsAtPoints::LimitsAtPoints(const Geometry& g, const WorkspaceDomain& domain, const InternalPointRule& rule,
                               const WorkspaceCriteria& criteria, const std::optional<Configuration>& home)
    : g_(g),
      domain_(domain),
      criteria_(criteria),
      chart_(domain),
      placement_(g, rule, criteria),
      size_(size_of(g)),
      exempt_(pairs_sharing_a_joint(g, criteria.exempt)),
      limits_(criteria_besides_legs(criteria)) {
  set_ = domain.archetype == Archetype::reachable || domain.archetype == Archetype::inclusive;
  if (home) {
    home_ = *home;
  } else {
    home_.position = chart_.positional() ? Vec3(0.5 * (domain.low + domain.high)) : domain.position;
    home_.rotation = set_ ? Mat3(Mat3::Identity()) : domain.rotations.front();
    home_.internal_point = placement_.point(home_.position, home_.rotation);
    if (placement_.searched()) {
      const InternalPoint best = placement_.best({home_.position, home_.rotation});
      if (!best.s.hasNaN()) home_.internal_point = best.s;
    }
  }
  home_at_ = chart_.positional() ? home_.position : chart_.coordinates(home_.rotation);
  home_points_ = posed_points(g_, home_);
  const PerMechanism at_home = singularity_margins(g, home_);
  signs_ = {at_home.n < 0.0 ? -1.0 : 1.0, at_home.b < 0.0 ? -1.0 : 1.0, at_home.c < 0.0 ? -1.0 : 1.0};
  list_groups();
}

void LimitsAtPoints::list_groups() {
  // One margin for each leg and each cone: a minimum of several would have kinks between the points of a cell.
  const auto groups = [&](long count, double scale) {
    if (pose_groups_ + count >= most_groups)
      throw InvalidArgument("criteria", "more than " + std::to_string(most_groups - 1) + " margins", "fewer limits");
    for (long n = 0; n < count; ++n) scale_[at_index(pose_groups_++)] = scale;
  };
  if (criteria_.legs)
    for (int leg = 0; leg < (placement_.searched() ? 3 : 9); ++leg)
      if (criteria_.legs->low[leg] > 0.0 || std::isfinite(criteria_.legs->high[leg])) limited_legs_.push_back(leg);
  groups(std::ssize(limited_legs_), size_);
  // Legs and cones have bounds over cells. Where O is searched for its legs have none.
  std::vector<std::size_t> with_bounds;
  for (std::size_t n = 0; n < limited_legs_.size(); ++n) with_bounds.push_back(n);
  if (placement_.searched()) groups(1, size_);
  std::vector<BodyCones> cones;
  for (const PoseCriterion& c : limits_) {
    const PoseRow* row = c.row->pose;
    const bool sign = c.row->info.kind == LimitKind::sign;
    looks_at_signs_ |= sign;
    looks_at_points_ |= row != nullptr && !sign;
    const int first = pose_groups_;
    groups(row == nullptr || in_one(*c.row) ? 1 : row->items, c.row->info.kind == LimitKind::length ? size_ : 1.0);
    if (row == nullptr || row->cone_body < 0 || placement_.searched()) continue;
    BodyCones body{row->cone_body == 1, c.high, row->first_at_body, {}};
    for (int k = 0; k < row->items; ++k) {
      const PointLook look(home_points_, home_points_, c.options);
      const Xyz<double> axis = look.axis(body.platform, row->first_at_body + k);
      body.axis.emplace_back(axis.x, axis.y, axis.z);
      with_bounds.push_back(at_index(first + k));
    }
    cones.push_back(body);
  }
  groups_ = set_ ? (pose_groups_ > 0 ? 1 : 0) : pose_groups_ + (chart_.has_region() ? 1 : 0);
  bounds_.emplace(g_, domain_, chart_, placement_, criteria_.legs.value_or(LegLimits{}), limited_legs_, cones);
  all_bounded_ = std::cmp_equal(with_bounds.size(), pose_groups_);
  if (set_) {
    for (std::size_t n = 0; n < with_bounds.size(); ++n) all_bounded_ = all_bounded_ && !bounds_->constant(n);
    bounded_[0] = all_bounded_;
    return;
  }
  for (std::size_t n = 0; n < with_bounds.size(); ++n) bounded_[with_bounds[n]] = !bounds_->constant(n);
  if (chart_.has_region()) bounded_[at_index(groups_ - 1)] = true;
}

PlatformPose LimitsAtPoints::pose(const Vec3& x, std::size_t r) const {
  return chart_.positional() ? PlatformPose{x, domain_.rotations[r]}
                             : PlatformPose{domain_.position, chart_.rotation(x)};
}

void LimitsAtPoints::judge(Block& b, const Vec3* x, long count, std::size_t r, const BestAt& best_at,
                           PointMargins* out) const {
  b.one_rotation = chart_.positional();
  for (long k = 0; k < count; ++k) {
    const PlatformPose here = pose(x[k], r);
    Eigen::Map<Vec3>(&b.p[Block::size(3 * k)]) = here.position;
    if (k == 0 || !b.one_rotation) Eigen::Map<RowMajor3>(&b.q[Block::size(9 * k)]) = here.rotation;
    Vec3 s = placement_.point(here.position, here.rotation);
    if (placement_.searched()) {
      const InternalPoint best = best_at ? best_at(k, r, here) : placement_.best(here);
      b.found[Block::size(k)] = !best.s.hasNaN();
      b.kappa[Block::size(k)] = best.value;
      if (!best.s.hasNaN()) s = best.s;
    }
    Eigen::Map<Vec3>(&b.s[Block::size(3 * k)]) = s;
  }
  const batch::Configurations c{b.p.data(), b.q.data(), b.s.data(), count, 3, b.one_rotation ? 0 : 9, 3};
  if (criteria_.legs) batch::leg_lengths(g_, c, b.length.data());
  if (!placement_.searched())
    batch::condition_numbers(g_, c, {&criteria_.characteristic_length, 0}, Norm::two, b.kappa.data());
  if (looks_at_signs_) batch::singularity_margins(g_, c, b.det.data());
  for (long k = 0; k < count; ++k) out[k] = judge_one(b, k);
}

PointMargins LimitsAtPoints::judge_one(const Block& b, long k) const {
  PointMargins m;
  double legs = infinity;
  std::size_t next = 0;
  for (const int leg : limited_legs_) {
    const double length = b.length[Block::size(9 * k + leg)];
    const double above = cell_margin(LimitKind::length, Side::low, criteria_.legs->low[leg], length);
    const double below = cell_margin(LimitKind::length, Side::high, criteria_.legs->high[leg], length);
    m.put(next++, std::min(above, below), above < below ? limit::leg_low + leg : limit::leg_high + leg);
    legs = std::min({legs, above, below});
  }
  // Only whether there is an admissible O is known. It was not searched for where an external leg breaks its limits.
  if (placement_.searched()) {
    m.put(next, b.found[Block::size(k)] || legs < 0.0 ? scale_[next] : -scale_[next], limit::internal_point());
    ++next;
  }
  PosedPoints here;
  if (looks_at_points_) here = posed_points(g_, b.at(k));
  m.condition_number = b.kappa[Block::size(k)];
  for (const PoseCriterion& c : limits_) put_limit(c, b, k, here, m, next);
  return m;
}

void LimitsAtPoints::put_limit(const PoseCriterion& c, const Block& b, long k, const PosedPoints& here, PointMargins& m,
                               std::size_t& next) const {
  const PoseRow* row = c.row->pose;
  const LimitKind kind = c.row->info.kind;
  const auto above = [&](double value) { return cell_margin(kind, Side::low, c.low, value); };
  const auto below = [&](double value) { return cell_margin(kind, Side::high, c.high, value); };
  if (row == nullptr) {
    const double margin = below(m.condition_number);
    // Without an admissible O there is no condition number; that is the limit then, and not this.
    const double none = placement_.searched() ? 1.0 : -1.0;
    return m.put(next++, std::isnan(margin) ? none : margin, c.name);
  }
  if (kind == LimitKind::sign) {  // the kernel has the determinants of a block
    for (int d = 0; d < row->items; ++d) {
      const double margin = above(signs_[at_index(d)] * b.det[Block::size(3 * k + d)]);
      m.put(next++, margin == 0.0 ? barely_outside : margin, c.name + d);
    }
    return;
  }
  const PointLook look(here, home_points_, c.options, criteria_.characteristic_length);
  if (!in_one(*c.row)) {
    for (int item = 0; item < row->items; ++item) {
      const double number = row->number(look, item);
      m.put(next++, c.low > -infinity ? std::min(above(number), below(number)) : below(number), c.name + item);
    }
    return;
  }
  double worst = row->pairs ? infinity : -infinity;
  int at = 0;
  for (int item = 0; item < row->items; ++item) {
    const double number = row->pairs && exempt_[at_index(item)] ? infinity : row->number(look, item);
    if (row->pairs ? number < worst : number > worst) {
      worst = number;
      at = item;
    }
  }
  m.put(next, row->pairs ? above(std::min(worst, 10.0 * scale_[next])) : below(worst), c.name + at);
  ++next;
}

void LimitsAtPoints::evaluate(const Vec3* x, long count, PointMargins* out, const std::stop_token& stop,
                              const BestAt& best) const {
  if (stop.stop_requested()) throw Stopped{};
  Block b(count);
  if (!set_) {
    judge(b, x, count, 0, best, out);
    if (!chart_.has_region()) return;
    for (long k = 0; k < count; ++k) {
      out[k].put(at_index(groups_ - 1), chart_.region_margin(x[k]), limit::region());
    }
    return;
  }
  // One rotation of a set stands for all: that whose least margin is greatest (reachable) or least (inclusive).
  const bool some = domain_.archetype == Archetype::reachable;
  std::vector<PointMargins> now(at_index(count));
  for (std::size_t r = 0; r < domain_.rotations.size(); ++r) {
    if (stop.stop_requested()) throw Stopped{};
    judge(b, x, count, r, best, now.data());
    for (long k = 0; k < count; ++k) {
      PointMargins& one = now[at_index(k)];
      double least = infinity;
      std::uint8_t which = 0;
      for (std::size_t n = 0; n < at_index(pose_groups_); ++n)
        if (const double margin = one.margin[n] / scale_[n]; margin < least) {
          least = margin;
          which = one.limit[n];
        }
      one.margin[0] = least;
      one.limit[0] = which;
      PointMargins& all = out[k];
      if (r == 0) {
        all = one;
        continue;
      }
      const bool both = least >= 0.0 && all.margin[0] >= 0.0;
      // The condition number is that of the best allowed rotation, or of the worst of all.
      const double kappa = some && !both ? (least >= 0.0 ? one : all).condition_number
                           : some        ? std::min(all.condition_number, one.condition_number)
                                         : std::max(all.condition_number, one.condition_number);
      if (some ? least > all.margin[0] : least < all.margin[0]) all = one;
      all.condition_number = kappa;
    }
  }
}

double LimitsAtPoints::least(const PointMargins& m, bool without_bounds) const {
  double out = infinity;
  for (std::size_t n = 0; n < at_index(groups_); ++n) {
    if (without_bounds && bounded_[n]) continue;
    const double scale = set_ || std::cmp_greater_equal(n, pose_groups_) ? 1.0 : scale_[n];
    if (std::isnan(m.margin[n])) return -infinity;
    out = std::min(out, m.margin[n] / scale);
  }
  return out;
}

int LimitsAtPoints::violated(const PointMargins& m) const {
  double least = 0.0;
  int out = -1;
  for (std::size_t n = 0; n < at_index(groups_); ++n) {
    const double scale = set_ || std::cmp_greater_equal(n, pose_groups_) ? 1.0 : scale_[n];
    if (!(m.margin[n] / scale >= least)) {
      least = m.margin[n] / scale;
      out = m.limit[n];
    }
  }
  return out;
}

}  // namespace ninedof
