#include "workspace/criteria/cell_bounds.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "math/numbers.hpp"
#include "ninedof/robot/legs.hpp"

namespace ninedof {

CellBounds::CellBounds(const Geometry& g, const WorkspaceDomain& domain, const Chart& chart, const Placement& placement,
                       const WorkspaceCriteria& criteria, const std::vector<int>& limited)
    : chart_(chart),
      rotations_(chart.positional() ? domain.rotations.size() : 1),
      some_(domain.archetype == Archetype::reachable) {
  const Motion o = placement.motion();
  double size = 0.0;
  for (const int leg : limited) {
    const auto i = at_index(leg % 3);
    const Vec3 zero = Vec3::Zero();
    const Motion from = leg < 3   ? Motion{0.0, zero, g.base_external()[i]}
                        : leg < 6 ? Motion{1.0, g.platform_internal()[i], zero}
                                  : Motion{0.0, zero, g.base_internal()[i]};
    const Motion to = leg < 3 ? Motion{1.0, g.platform_external()[i], zero} : o;
    const double k = to.share - from.share;
    const Vec3 arm = to.arm - from.arm, at = to.at - from.at;
    Leg one{criteria.legs->low[leg], criteria.legs->high[leg], k, {}, arm};
    for (std::size_t r = 0; r < rotations_; ++r)
      one.at.push_back(chart.positional() ? Vec3(at + domain.rotations[r] * arm) : Vec3(at + k * domain.position));
    const double reach =
        chart.positional() ? std::abs(k) * (chart.high() - chart.low()).norm() : std::min(one.at[0].norm(), arm.norm());
    size = std::max({size, one.at[0].norm(), arm.norm(), std::abs(k) * chart.low().norm()});
    constant_.push_back(reach <= idle_share * size);
    if (!constant_.back()) legs_.push_back(std::move(one));
  }
  rounding_ = 1e-12 * size;
}

CellBounds::Range CellBounds::length(const Leg& leg, std::size_t r, const Vec3& centre, const Vec3& half) const {
  const Vec3 away = (leg.k * centre + leg.at[r]).cwiseAbs(), reach = std::abs(leg.k) * half;
  return {(away - reach).cwiseMax(0.0).norm(), (away + reach).norm()};
}

CellBounds::Range CellBounds::turned(const Leg& leg, const Mat3& q, const Mat3& spin, const Vec3& half) const {
  const Vec3 &at = leg.at[0], arm = q * leg.arm;
  const double a = at.norm(), w = arm.norm(), product = a * w, dot = at.dot(arm);
  // The angle between both changes by at most that of the rotation; and Taylor's theorem with two terms.
  const double turn = chart_.turning() * half.norm(), angle = std::acos(std::clamp(dot / product, -1.0, 1.0));
  const double linear = half.dot((spin.transpose() * arm.cross(at)).cwiseAbs());
  const double rest = 0.5 * chart_.bending() * product * half.squaredNorm();
  const double most = std::min(product * std::cos(std::max(angle - turn, 0.0)), dot + linear + rest);
  const double least = std::max(product * std::cos(std::min(angle + turn, std::numbers::pi)), dot - linear - rest);
  const double sum = a * a + w * w;
  return {std::sqrt(std::max(sum + 2.0 * least, 0.0)), std::sqrt(std::max(sum + 2.0 * most, 0.0))};
}

CellBounds::Range CellBounds::region(const Vec3& centre, const Vec3& half) const {
  const Vec3 near = (centre.cwiseAbs() - half).cwiseMax(0.0), far = centre.cwiseAbs() + half;
  return {chart_.region_margin(far), chart_.region_margin(near)};
}

Proof CellBounds::over(const Vec3& centre, const Vec3& half) const {
  Mat3 q = Mat3::Identity(), spin = q;
  if (!chart_.positional() && !legs_.empty()) {
    q = chart_.rotation(centre);
    spin = chart_.spin(centre);
  }
  Proof all{some_, !some_};
  for (std::size_t r = 0; r < rotations_; ++r) {
    Proof one;
    for (const Leg& leg : legs_) {
      const Range l = chart_.positional() ? length(leg, r, centre, half) : turned(leg, q, spin, half);
      one.inside =
          one.inside && l.least >= leg.low + (leg.low > 0.0 ? rounding_ : 0.0) && l.most <= leg.high - rounding_;
      one.outside = one.outside || l.least > leg.high + rounding_ || l.most < leg.low - rounding_;
      if (one.outside) break;
    }
    one.inside = one.inside && !one.outside;
    all.outside = some_ ? all.outside && one.outside : all.outside || one.outside;
    all.inside = some_ ? all.inside || one.inside : all.inside && one.inside;
    if (some_ ? all.inside : all.outside) break;
  }
  if (chart_.has_region()) {
    const Range margin = region(centre, half);
    all.outside = all.outside || margin.most < -1e-12;
    all.inside = all.inside && margin.least >= 1e-12;
  }
  return all;
}

double CellBounds::clear(const Vec3& x) const {
  double least = infinity;
  for (std::size_t r = 0; r < rotations_; ++r)
    for (const Leg& leg : legs_) {
      const double l = (leg.k * x + leg.at[r]).norm();
      const double above = leg.low > 0.0 ? l - leg.low : infinity;  // a lower limit of zero limits nothing
      least = std::min(least, (std::min(above, leg.high - l) - rounding_) / std::abs(leg.k));
    }
  return least;
}

}  // namespace ninedof
