/// Declared in ninedof/statics/accuracy.hpp.

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "math/numbers.hpp"
#include "math/splitmix.hpp"
#include "ninedof/math/error.hpp"
#include "ninedof/position/tracking.hpp"
#include "ninedof/robot/legs.hpp"
#include "ninedof/statics/accuracy.hpp"
#include "singularity/unit_rows.hpp"

namespace ninedof {
namespace {

/// The sequence of random numbers of one sample: each is a hash of (seed, sample, position in the sequence).
class Draws {
 public:
  Draws(std::uint64_t seed, std::uint64_t sample) : next_(stream(seed, sample + 1)) {}

  /// In [-1, 1).
  double interval() { return 2.0 * unit() - 1.0; }

  /// In the unit ball.
  Vec3 ball() {
    const double z = interval(), angle = 2.0 * std::numbers::pi * unit(), radius = std::cbrt(unit());
    const double across = std::sqrt(1.0 - z * z);
    return radius * Vec3(across * std::cos(angle), across * std::sin(angle), z);
  }

 private:
  double unit() { return uniform_from(next_ += 0x8CB92BA72F3D8DD7ULL); }

  std::uint64_t next_;
};

Triple displaced(Triple joints, const double* radius, Draws& draws) {
  for (std::size_t i = 0; i < 3; ++i) joints[i] += radius[i] * draws.ball();
  return joints;
}

/// None if the errors make three internal joints collinear, or another robot that is singular at every pose.
std::optional<Geometry> built(const Geometry& g, const Tolerances& t, Draws& draws) {
  const double* radius = t.joints.data();
  const Triple r = displaced(g.base_external(), radius, draws), r_hat = displaced(g.base_internal(), radius + 3, draws);
  const Triple u = displaced(g.platform_external(), radius + 6, draws);
  const Triple u_tilde = displaced(g.platform_internal(), radius + 9, draws);
  try {
    return Geometry(r, r_hat, u, u_tilde);
  } catch (const InvalidArgument&) {
    return std::nullopt;
  }
}

}  // namespace

Vec9 error_sample(const Geometry& g, const Configuration& c, const Tolerances& t, std::uint64_t seed,
                  std::uint64_t index) {
  validate(t);
  const std::array<int, 3> intended = sides(unit_rows(spans(g, c)));
  if (std::ranges::count(intended, 0) > 0) return Vec9::Constant(not_a_number);  // singular: the side is not defined
  Draws draws(seed, index);
  Vec9 lengths = leg_lengths(g, c);
  for (Eigen::Index k = 0; k < 9; ++k) lengths[k] += t.legs[k] * draws.interval();
  const std::optional<Geometry> made = built(g, t, draws);
  if (!made || !(lengths.minCoeff() >= 0.0)) return Vec9::Constant(not_a_number);
  const Tracked found = track(*made, lengths, c);
  if (found.status != TrackStatus::tracked) return Vec9::Constant(not_a_number);
  // Large joint errors may put the intended configuration on another side of a singularity of the robot with errors.
  if (sides(unit_rows(spans(*made, found.configuration))) != intended) return Vec9::Constant(not_a_number);
  return minus(found.configuration, c);
}

}  // namespace ninedof
