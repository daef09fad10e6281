#include "ninedof/robot/legs.hpp"

#include "robot/leg_vectors.hpp"

namespace ninedof {
namespace {

/// Returns the length of `leg` and sets its direction (zero for a leg of zero length).
double split(const Vec3& leg, Vec3& direction) {
  const double length = leg.norm();
  if (length == 0.0) direction.setZero();
  else direction = leg / length;
  return length;
}

/// Of a short leg: its squares may underflow.
double split_short(const Vec3& leg, Vec3& direction) {
  const double length = leg.stableNorm();
  if (length == 0.0) direction.setZero();
  else direction = leg / length;
  return length;
}

bool has_short_leg(double shortest, double longest) {
  return shortest * shortest <= short_leg * (longest * longest);
}

/// Leg i of the external, upper and lower ones: those that are short again, with all their digits.
Vec3 external_again(const Geometry& g, const Configuration& c, std::size_t i) {
  return -exact_leg(g.base_external()[i], c.position, c.rotation, g.platform_external()[i]);
}
Vec3 upper_again(const Geometry& g, const Configuration& c, std::size_t i) {
  return exact_leg(c.internal_point, c.position, c.rotation, g.platform_internal()[i]);
}

[[gnu::noinline]] void mend_short_legs(const Geometry& g, const Configuration& c, double longest, Legs& out) {
  for (std::size_t i = 0; i < 3; ++i) {
    const auto k = static_cast<Eigen::Index>(i);
    if (has_short_leg(out.l[k], longest)) out.l[k] = split_short(external_again(g, c, i), out.e[i]);
    if (has_short_leg(out.q[k], longest)) out.q[k] = split_short(upper_again(g, c, i), out.e_tilde[i]);
    if (has_short_leg(out.r[k], longest)) out.r[k] = split_short(lower_leg(c, g.base_internal()[i]), out.e_hat[i]);
  }
}

[[gnu::noinline]] void mend_short_lengths(const Geometry& g, const Configuration& c, double longest, Vec9& out) {
  for (std::size_t i = 0; i < 3; ++i) {
    const auto k = static_cast<Eigen::Index>(i);
    if (has_short_leg(out[k], longest)) out[k] = external_again(g, c, i).stableNorm();
    if (has_short_leg(out[k + 3], longest)) out[k + 3] = upper_again(g, c, i).stableNorm();
    if (has_short_leg(out[k + 6], longest)) out[k + 6] = lower_leg(c, g.base_internal()[i]).stableNorm();
  }
}

}  // namespace

Legs legs(const Geometry& g, const Configuration& c) {
  Legs out;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto k = static_cast<Eigen::Index>(i);
    out.u[i] = c.rotation * g.platform_external()[i];
    out.u_tilde[i] = c.rotation * g.platform_internal()[i];
    out.l[k] = split(external_leg(c, out.u[i], g.base_external()[i]), out.e[i]);
    out.q[k] = split(upper_leg(c, out.u_tilde[i]), out.e_tilde[i]);
    out.r[k] = split(lower_leg(c, g.base_internal()[i]), out.e_hat[i]);
  }
  const double shortest = out.l.cwiseMin(out.q).cwiseMin(out.r).minCoeff();
  const double longest = out.l.cwiseMax(out.q).cwiseMax(out.r).maxCoeff();
  if (has_short_leg(shortest, longest)) mend_short_legs(g, c, longest, out);
  return out;
}

Vec9 leg_lengths(const Geometry& g, const Configuration& c) {
  Vec9 out;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto k = static_cast<Eigen::Index>(i);
    out[k] = external_leg(c, c.rotation * g.platform_external()[i], g.base_external()[i]).norm();
    out[k + 3] = upper_leg(c, c.rotation * g.platform_internal()[i]).norm();
    out[k + 6] = lower_leg(c, g.base_internal()[i]).norm();
  }
  const double longest = out.maxCoeff();
  if (has_short_leg(out.minCoeff(), longest)) mend_short_lengths(g, c, longest, out);
  return out;
}

std::array<bool, 9> idle_legs(const Vec9& shortest, const Vec9& longest) {
  std::array<bool, 9> out{};
  const double most = idle_share * longest.maxCoeff();
  for (std::size_t k = 0; k < 9; ++k) {
    const auto leg = static_cast<Eigen::Index>(k);
    out[k] = longest[leg] - shortest[leg] <= most;
  }
  return out;
}

}  // namespace ninedof
