#include "workspace/certified/pose_cuts.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "math/numbers.hpp"
#include "ninedof/limits/numbers.hpp"
#include "ninedof/math/error.hpp"
#include "robot/joint_cones.hpp"

namespace ninedof::certified {
namespace {

// Places of the criteria among the bits.
constexpr int legs_first = 0, base_first = 9, platform_first = 15, pairs_first = 21, signs_first = 42,
              condition_first = 45;
static_assert(pairs_first + leg_pairs == signs_first);

constexpr Criteria bit(int k) {
  return Criteria{1} << k;
}
constexpr Criteria bits(int first, int count) {
  return (bit(count) - 1) << first;
}

FormVector centroid_of(const Triple& t) {
  const PoseForm third = PoseForm::of(Interval(1.0) / 3.0);
  return third * (constant<PoseForm>(t[0]) + constant<PoseForm>(t[1]) + constant<PoseForm>(t[2]));
}

}  // namespace

PoseCuts::PoseCuts(const Geometry& g, const WorkspaceDomain& domain, const InternalPointRule& rule,
                   const WorkspaceCriteria& criteria, const Configuration& home)
    : geometry_(g),
      criteria_(criteria),
      rule_(rule),
      home_(g, home, Vec3::Zero()),
      some_(domain.archetype == Archetype::reachable) {
  for (const Mat3& q : domain.rotations) rotations_.push_back(rotation_columns(q));
  if (criteria.legs)
    for (int k = 0; k < 9; ++k)
      if (criteria.legs->low[k] > 0.0 || std::isfinite(criteria.legs->high[k])) all_ |= bit(legs_first + k);
  const auto cones = [&](const std::optional<ConeLimit>& limit, bool platform) {
    if (!limit || !(limit->angle < std::numbers::pi)) return;  // no angle is greater
    all_ |= bits(platform ? platform_first : base_first, legs_at_body);
    (platform ? platform_home_ : base_home_).emplace(g, home, limit->axis);
    (platform ? least_platform_cosine_ : least_base_cosine_) = PoseForm::of(cos(Interval(limit->angle)));
  };
  cones(criteria.base_cone, false);
  cones(criteria.platform_cone, true);
  if (criteria.leg_clearance) {
    const std::array<bool, leg_pairs> exempt = pairs_sharing_a_joint(g);
    for (int pair = 0; pair < leg_pairs; ++pair)
      if (!exempt[at_index(pair)]) all_ |= bit(pairs_first + pair);
  }
  if (criteria.singularity_free) {
    all_ |= bits(signs_first, 3);
    const FormPose at_home = form_pose(home);
    for (int d = 0; d < 3; ++d)
      if (!(lower(determinant_numerator(FormLook(g, at_home, home_), d)) > 0.0))
        throw InvalidArgument("home", "a configuration that rounding cannot tell from a singular one",
                              "a regular one with singularity_free");
  }
  if (criteria.condition_number) all_ |= bit(condition_first);
}

FormPose PoseCuts::pose(const PositionBox& box, std::size_t rotation) const {
  const auto coordinate = [&](Eigen::Index k) { return PoseForm::coordinate(box.low[k], box.high[k], at_index(k)); };
  FormPose out{{coordinate(0), coordinate(1), coordinate(2)}, {}, rotations_[rotation]};
  using Kind = InternalPointRule::Kind;
  if (rule_.kind == Kind::fixed) {
    out.s = constant<PoseForm>(rule_.point);
  } else if (rule_.kind == Kind::platform) {
    out.s = out.p + turned(out, rule_.point);
  } else {
    const FormVector lower = centroid_of(geometry_.base_internal()), arm = centroid_of(geometry_.platform_internal());
    const FormVector upper = out.p + (arm.x * out.q[0] + arm.y * out.q[1] + arm.z * out.q[2]);
    out.s = lower + PoseForm(rule_.fraction) * (upper - lower);
  }
  return out;
}

bool PoseCuts::decided(const PoseForm& f, Criteria which, Found& found) {
  if (!is_known(f)) {
    put({}, found);
    return false;
  }
  if (lower(f) > 0.0) {
    found.open &= ~which;
    return true;
  }
  if (upper(f) < 0.0) {
    found.violated = true;
    return true;
  }
  put({{f.a[0], f.a[1], f.a[2]}, ninedof::detail::above(f.r - f.c), ninedof::detail::below(-f.r - f.c)}, found);
  return false;
}

void PoseCuts::put(const Cut& cut, Found& found) {
  found.cuts.push_back(cut);
}

void PoseCuts::look_at_legs(const FormPose& pose, Found& found) const {
  const FormLook look(geometry_, pose, home_);
  for (int k = 0; k < 9; ++k) {
    if (!(found.open & bit(legs_first + k))) continue;
    const PoseForm squared = leg_length_row.form(look, k);
    const double low = criteria_.legs->low[k], high = criteria_.legs->high[k];
    bool both = true;
    if (low > 0.0) both = decided(squared - PoseForm::of(square(Interval(low))), 0, found) && both;
    if (std::isfinite(high)) both = decided(PoseForm::of(square(Interval(high))) - squared, 0, found) && both;
    if (found.violated) return;
    if (both) found.open &= ~bit(legs_first + k);
  }
}

void PoseCuts::look_at_cones(const FormPose& pose, bool platform, Found& found) const {
  const int first = platform ? platform_first : base_first;
  if (!(found.open & bits(first, legs_at_body))) return;
  const FormLook look(geometry_, pose, platform ? *platform_home_ : *base_home_);
  const PoseRow& row = platform ? platform_cone_row : base_cone_row;
  for (int k = 0; k < legs_at_body && !found.violated; ++k)
    if (found.open & bit(first + k))
      decided(row.form(look, k) - (platform ? least_platform_cosine_ : least_base_cosine_), bit(first + k), found);
}

void PoseCuts::look_at_clearance(const FormPose& pose, Found& found) const {
  const FormLook look(geometry_, pose, home_);
  const double distance = *criteria_.leg_clearance;
  for (int pair = 0; pair < leg_pairs; ++pair) {
    const Criteria which = bit(pairs_first + pair);
    if (!(found.open & which)) continue;
    const LegPairForms legs = leg_pair_forms(look, pair);
    Cut apart;
    if (all_apart(legs, distance, apart)) {
      found.open &= ~which;
      continue;
    }
    put(apart, found);
    const PoseForm lack = PoseForm::of(square(Interval(distance))) - squared_distance_above(legs);
    if (!is_known(lack)) continue;
    if (lower(lack) > 0.0) {
      found.violated = true;
      return;
    }
    // Less than the distance apart where lack > 0: slope . t below.
    put({{-lack.a[0], -lack.a[1], -lack.a[2]}, -infinity, ninedof::detail::below(lack.c - lack.r)}, found);
  }
}

bool PoseCuts::all_apart(const LegPairForms& legs, double distance, Cut& apart) {
  FormVector direction = turning_direction(legs);
  if (!is_known(direction.x)) direction = fixed_direction(legs);
  // The distance is at least the least of four numbers; each is above a plane of one slope, that of the least of them.
  std::array<PoseForm, 4> spare = end_distances(legs, direction).along;
  std::size_t lowest = 0;
  for (std::size_t k = 0; k < spare.size(); ++k) {
    spare[k] = spare[k] - PoseForm(distance);
    if (!is_known(spare[k])) return false;
    if (lower(spare[k]) < lower(spare[lowest])) lowest = k;
  }
  if (lower(spare[lowest]) > 0.0) return true;
  double level = -infinity;
  for (PoseForm rest : spare) {
    if (lower(rest) > 0.0) continue;
    for (std::size_t i = 0; i < 3; ++i) {
      apart.slope[i] = spare[lowest].a[i];
      rest.a[i] -= apart.slope[i];
      rest.r += 0x1p-52 * std::abs(rest.a[i]);
    }
    level = std::max(level, -lower(rest));
  }
  apart.allowed = ninedof::detail::above(level);
  return false;
}

void PoseCuts::look_at_signs(const FormPose& pose, Found& found) const {
  const FormLook look(geometry_, pose, home_);
  for (int d = 0; d < 3 && !found.violated; ++d)
    if (found.open & bit(signs_first + d)) decided(determinant_numerator(look, d), bit(signs_first + d), found);
}

void PoseCuts::look_at_condition(const FormPose& pose, Found& found) const {
  if (!(found.open & bit(condition_first))) return;
  Moves unused;
  const forms::ConditionSplit split = forms::split_by_condition(
      forms::split_gram(geometry_, criteria_.characteristic_length, pose, unused), *criteria_.condition_number);
  if (split.everywhere) {
    found.open &= ~bit(condition_first);
    return;
  }
  if (!is_known(split.excess)) {
    put({}, found);
    return;
  }
  if (lower(split.excess) > 0.0) {
    found.violated = true;
    return;
  }
  put({split.slope, split.level, ninedof::detail::below(split.excess.c - split.excess.r)}, found);
}

PoseCuts::Found PoseCuts::look(const PositionBox& box, std::size_t rotation, Criteria open, bool cheap_ones) const {
  const FormPose at = pose(box, rotation);
  Found found{open, false, {}};
  look_at_legs(at, found);
  if (!found.violated) look_at_cones(at, false, found);
  if (!found.violated) look_at_cones(at, true, found);
  if (!found.violated) look_at_signs(at, found);
  if (!found.violated) look_at_clearance(at, found);
  if (!found.violated && !cheap_ones) look_at_condition(at, found);
  return found;
}

PositionBox PoseCuts::reached_with(std::size_t rotation) const {
  PositionBox out{Vec3::Constant(-infinity), Vec3::Constant(infinity)};
  if (!criteria_.legs) return out;
  // A leg is k p + what it is at p = 0.
  const FormPose zero = pose({Vec3::Zero(), Vec3::Zero()}, rotation);
  using Kind = InternalPointRule::Kind;
  const Interval share = rule_.kind == Kind::fixed ? 0.0 : rule_.kind == Kind::platform ? 1.0 : rule_.fraction;
  for (int leg = 0; leg < 9; ++leg) {
    const Interval k = leg < 3 ? Interval(1.0) : leg < 6 ? share - 1.0 : share, high(criteria_.legs->high[leg]);
    if (!std::isfinite(high.hi) || (k.lo <= 0.0 && k.hi >= 0.0)) continue;
    const FormEnds e = ends_of(geometry_, zero, leg);
    const FormVector at = e.to - e.from;
    const std::array<const PoseForm*, 3> parts{&at.x, &at.y, &at.z};
    for (int i = 0; i < 3; ++i) {
      const Interval start(lower(*parts[at_index(i)]), upper(*parts[at_index(i)]));
      const Interval one = (-start - high) / k, other = (high - start) / k;
      out.low[i] = std::max(out.low[i], std::min(one.lo, other.lo));
      out.high[i] = std::min(out.high[i], std::max(one.hi, other.hi));
    }
  }
  return out;
}

PositionBox PoseCuts::reached() const {
  PositionBox out = reached_with(0);
  for (std::size_t r = 1; r < rotations_.size(); ++r) {
    const PositionBox one = reached_with(r);
    // Every rotation is wanted, or one is enough.
    out.low = some_ ? Vec3(out.low.cwiseMin(one.low)) : Vec3(out.low.cwiseMax(one.low));
    out.high = some_ ? Vec3(out.high.cwiseMax(one.high)) : Vec3(out.high.cwiseMin(one.high));
  }
  return out;
}

}  // namespace ninedof::certified
