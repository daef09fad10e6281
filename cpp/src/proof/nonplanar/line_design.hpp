#pragma once
/// A C3 design by the line of its external leg: what decides the condition number on the axis, and the limits.
///
/// The row of an external leg depends on its line alone: its distance delta from the axis, its elevation epsilon, and
/// eta, the height of the foot of the common perpendicular above P times cos epsilon. Internal legs act by their slopes
/// alone. docs/theory/proof.md has the lemma. Lengths are in characteristic lengths.
///
/// Shares no code with conditioning/symmetric.hpp: the tests check each against the other.

#include <array>
#include <vector>

#include "math/numbers.hpp"
#include "ninedof/math/dual.hpp"
#include "proof/nonplanar/chords.hpp"

namespace ninedof::proof {

namespace line {
enum Coordinate : std::size_t {
  distance,   ///< delta
  moment,     ///< eta
  elevation,  ///< epsilon, from 0 to 90 degrees: the mirror image has the other sign
  drop,       ///< zp - zs
  upper,      ///< u: horizontal over vertical part of an upper internal leg
  lower,      ///< l: the same of a lower one
  platform,   ///< x_b: where on the line the platform's joint is, along the horizontal; 0 at the foot
  base,       ///< x_a: the same of the base's joint
  height,     ///< zp
  upper_up,   ///< vertical part of an upper leg
  lower_up,   ///< vertical part of a lower leg
  coordinates
};
}  // namespace line

template <class T>
using LinePoint = std::array<T, line::coordinates>;
using LineBox = LinePoint<Interval>;

/// The blocks of M^T M, the second Hermitian: [[axial_11, axial_12], [axial_12, axial_22]] and
/// [[across_11, conj(z)], [z, across_22]].
template <class T>
struct LineBlocks {
  T axial_11, axial_12, axial_22, across_11, across_re, across_im, across_22;
};

/// On which sides of O the internal joints are: 1 where the platform's are above it (the base's below it), else -1.
struct SidesOfO {
  double upper = 1.0, lower = 1.0;
};

/// What a study asks of a design, an infinite end asks nothing.
struct LineLimits {
  /// Radii of the triples and their heights: external and internal of the base, external and internal of the platform.
  std::array<Interval, 4> radius, height;
  Interval zp, zs, share{0.0, 1.0}, radius_ratio{0.0, infinity};
  double leg_ratio = infinity;
  std::array<Interval, 3> length, length_in_zp;  ///< of external, upper and lower legs
  double joint_height = infinity, joint_height_in_radius = infinity;
};

/// A design over a number type.
template <class T>
class LineDesign {
 public:
  explicit LineDesign(const LinePoint<T>& at)
      : x_(at), c_(cosine_of(at[line::elevation])), s_(sine_of(at[line::elevation])) {}

  LineBlocks<T> blocks() const {
    const T &u = x_[line::upper], &l = x_[line::lower], &eta = x_[line::moment], &y = x_[line::drop];
    const T along = reciprocal(2.0 + square(u) + square(l));
    const T across = reciprocal(2.0 + reciprocal_square(u) + reciprocal_square(l));
    const T d = x_[line::distance] * c_, e = x_[line::distance] * s_, lever = y * across, mixed = d * s_;
    return {3.0 * square(d),
            3.0 * mixed,
            3.0 * (square(s_) + along),
            1.5 * (square(eta) + square(e) + y * lever),
            -1.5 * mixed,
            1.5 * (lever - eta * c_),
            1.5 * (square(c_) + across)};
  }

  /// Numbers that are not positive where the limits are kept. Heights and lengths of external legs are taken times
  /// cos epsilon, which saves divisions.
  std::vector<T> rules(const LineLimits& limits, const SidesOfO& sides) const {
    std::vector<T> out;
    out.reserve(64);
    const auto least = [&](double low, const T& unit, const T& x) {
      if (low > -infinity) out.push_back(low * unit - x);
    };
    const auto most = [&](const T& x, double high, const T& unit) {
      if (high < infinity) out.push_back(x - high * unit);
    };
    const auto within = [&](const T& x, const Interval& range, const T& unit) {
      least(range.lo, unit, x);
      most(x, range.hi, unit);
    };
    const T one(1.0), &zp = x_[line::height], &y = x_[line::drop], &up = x_[line::upper_up], &down = x_[line::lower_up];
    const T delta2 = square(x_[line::distance]), &x_b = x_[line::platform], &x_a = x_[line::base];

    const std::array<T, 4> radius{root_of(delta2 + square(x_a)), x_[line::lower] * down, root_of(delta2 + square(x_b)),
                                  x_[line::upper] * up};
    for (std::size_t k = 0; k < 4; ++k) within(radius[k], limits.radius[k], one);
    const T widest_base = larger(radius[0], radius[1]), widest_platform = larger(radius[2], radius[3]);
    if (limits.radius_ratio.lo > 0.0) least(limits.radius_ratio.lo, widest_platform, widest_base);
    most(widest_base, limits.radius_ratio.hi, widest_platform);

    const T zs = zp - y;
    within(zs, limits.zs, one);
    within(zs, limits.share, zp);
    const std::array<T, 4> height{c_ * zp + x_[line::moment] + x_a * s_, zs - sides.lower * down,
                                  x_[line::moment] + x_b * s_, sides.upper * up - y};
    const T widest = larger(widest_base, widest_platform), tilted = c_ * widest;
    for (const std::size_t k : {0, 1, 2, 3}) {
      const bool external = k % 2 == 0;
      within(height[k], limits.height[k], external ? c_ : one);
      for (const T& side : {height[k], -height[k]}) {
        most(side, limits.joint_height, external ? c_ : one);
        most(side, limits.joint_height_in_radius, external ? tilted : widest);
      }
    }

    const T between = x_b - x_a, span = larger(between, -between);
    const T upper = up * root_of(1.0 + square(x_[line::upper])), lower = down * root_of(1.0 + square(x_[line::lower]));
    const std::array<T, 3> leg{span, upper, lower};
    const T flat_zp = c_ * zp, flat_upper = c_ * upper, flat_lower = c_ * lower;
    for (std::size_t k = 0; k < 3; ++k) {
      within(leg[k], limits.length[k], k == 0 ? c_ : one);
      within(leg[k], limits.length_in_zp[k], k == 0 ? flat_zp : zp);
    }
    for (const T& internal : {flat_upper, flat_lower}) {
      most(span, limits.leg_ratio, internal);
      most(internal, limits.leg_ratio, span);
    }
    most(upper, limits.leg_ratio, lower);
    most(lower, limits.leg_ratio, upper);
    return out;
  }

 private:
  const LinePoint<T>& x_;
  T c_, s_;
};

}  // namespace ninedof::proof
