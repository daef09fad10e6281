#include "workspace/criteria/cell_bounds.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "math/numbers.hpp"
#include "ninedof/robot/legs.hpp"

namespace ninedof {

CellBounds::CellBounds(const Geometry& g, const WorkspaceDomain& domain, const Chart& chart, const Placement& placement,
                       const LegLimits& limits, const std::vector<int>& limited, const std::vector<BodyCones>& cones)
    : chart_(chart),
      rotations_(chart.positional() ? domain.rotations.size() : 1),
      some_(domain.archetype == Archetype::reachable) {
  const Vec3 zero = Vec3::Zero();
  const auto line = [&](int leg, double sense) {
    const auto i = at_index(leg % 3);
    const Motion from = leg < 3   ? Motion{0.0, zero, g.base_external()[i]}
                        : leg < 6 ? Motion{1.0, g.platform_internal()[i], zero}
                                  : Motion{0.0, zero, g.base_internal()[i]};
    const Motion to = leg < 3 ? Motion{1.0, g.platform_external()[i], zero} : placement.motion();
    Line out{sense * (to.share - from.share), {}, sense * (to.arm - from.arm)};
    const Vec3 at = sense * (to.at - from.at);
    for (std::size_t r = 0; r < rotations_; ++r)
      out.at.push_back(chart.positional() ? Vec3(at + domain.rotations[r] * out.arm)
                                          : Vec3(at + out.k * domain.position));
    size_ = std::max({size_, out.at[0].norm(), out.arm.norm(), std::abs(out.k) * chart.low().norm()});
    return out;
  };
  const auto moves = [&](const Line& leg, double turned) {
    const double reach = chart.positional() ? std::abs(leg.k) * (chart.high() - chart.low()).norm() : turned;
    return reach > rounding_;
  };
  for (const int leg : limited) line(leg, 1.0);  // for the size, before anything is compared with it
  for (const BodyCones& body : cones)
    for (const int k : body.legs()) line(leg_at(body.platform, k), sense_at(body.platform, k));
  rounding_ = 1e-12 * size_;
  for (const int leg : limited) {
    Leg one{line(leg, 1.0), limits.low[leg], limits.high[leg]};
    constant_.push_back(!moves(one, std::min(one.at[0].norm(), one.arm.norm())));
    if (!constant_.back()) legs_.push_back(std::move(one));
  }
  for (const BodyCones& body : cones)
    for (const int k : body.legs()) {
      const bool platform = body.platform;
      const Vec3& axis = body.axis[at_index(k - body.first)];
      ConedLeg one{line(leg_at(platform, k), sense_at(platform, k)), {}, platform};
      for (std::size_t r = 0; r < rotations_; ++r)
        one.cone.emplace_back(platform && chart.positional() ? Vec3(domain.rotations[r] * axis) : axis, body.angle);
      const bool limits_it = body.angle < std::numbers::pi;
      constant_.push_back(!(limits_it && moves(one, platform ? one.at[0].norm() : one.arm.norm())));
      if (!constant_.back()) cones_.push_back(std::move(one));
    }
}

// Over a box a leg is a box of vectors: its length and its cone have exact ends, where forms of the rows leave a rest.
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

Proof CellBounds::coned(const ConedLeg& leg, std::size_t r, const Mat3& q, const Vec3& centre, const Vec3& half) const {
  const ConvexCone& cone = leg.cone[r];
  if (chart_.positional()) {
    const Vec3 middle = leg.k * centre + leg.at[r], reach = std::abs(leg.k) * half;
    return {cone.forbids_box(middle, reach, rounding_), cone.allows_box(middle, reach, rounding_)};
  }
  // Of the two parts of the leg one is fixed in the body's frame; the other turns by at most this angle.
  const double turn = chart_.turning() * half.norm();
  const Vec3 middle = leg.of_platform ? Vec3(q.transpose() * leg.at[0] + leg.arm) : Vec3(leg.at[0] + q * leg.arm);
  const double reach = turn * (leg.of_platform ? leg.at[0] : leg.arm).norm() + rounding_, clear = cone.clear(middle);
  return {clear < -reach, clear >= reach};
}

CellBounds::Range CellBounds::region(const Vec3& centre, const Vec3& half) const {
  const Vec3 near = (centre.cwiseAbs() - half).cwiseMax(0.0), far = centre.cwiseAbs() + half;
  return {chart_.region_margin(far), chart_.region_margin(near)};
}

Proof CellBounds::over(const Vec3& centre, const Vec3& half) const {
  Mat3 q = Mat3::Identity(), spin = q;
  if (!chart_.positional()) {
    q = chart_.rotation(centre);
    if (!legs_.empty()) spin = chart_.spin(centre);
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
    for (const ConedLeg& leg : cones_) {
      if (one.outside) break;
      const Proof cone = coned(leg, r, q, centre, half);
      one.inside = one.inside && cone.inside;
      one.outside = cone.outside;
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
  for (std::size_t r = 0; r < rotations_; ++r) {
    for (const Leg& leg : legs_) {
      const double l = (leg.k * x + leg.at[r]).norm();
      const double above = leg.low > 0.0 ? l - leg.low : infinity;  // a lower limit of zero limits nothing
      least = std::min(least, (std::min(above, leg.high - l) - rounding_) / std::abs(leg.k));
    }
    for (const ConedLeg& leg : cones_)
      least = std::min(least, (leg.cone[r].clear(leg.k * x + leg.at[r]) - rounding_) / std::abs(leg.k));
  }
  return least;
}

}  // namespace ninedof
