#include "solve_near.hpp"

#include <cmath>

#include "ninedof/legs.hpp"
#include "ninedof/velocity.hpp"

namespace ninedof {
namespace {

constexpr double shortest_piece = 1.0 / 64.0;  // of the way
constexpr double rounding = 1e-13;  // residual, against legs and coordinates, after which one step is the last
constexpr int most_steps = 12;  // halving alone does not get there: convergence must turn quadratic

std::optional<Configuration> contracting_newton(const Geometry& g, const Vec9& lengths, Configuration c) {
  const double longest = lengths.maxCoeff();
  const double reach = longest + c.position.norm() + c.internal_point.norm();
  double allowed = 0.5 * longest;
  for (int k = 0; k < most_steps; ++k) {
    const Vec9 residual = lengths - leg_lengths(g, c);
    const Velocity v = forward_velocity(g, c, residual);
    const double moved =
        std::sqrt(longest * longest * v.omega.squaredNorm() + v.pdot.squaredNorm() + v.sdot.squaredNorm());
    if (!(moved <= allowed)) return std::nullopt;  // NaN included
    allowed = 0.5 * moved;
    Vec9 step;
    step << v.omega, v.pdot, v.sdot;
    c = plus(c, step);
    if (residual.cwiseAbs().maxCoeff() <= rounding * reach) return c;
  }
  return std::nullopt;
}

}  // namespace

std::optional<Configuration> solve_near(const Geometry& g, const Vec9& lengths, const Configuration& start) {
  const Vec9 first = leg_lengths(g, start);
  Configuration at = start;
  double done = 0.0, piece = 1.0;
  while (done < 1.0) {
    const double next = std::min(1.0, done + piece);
    if (const auto found = contracting_newton(g, first + next * (lengths - first), at)) {
      at = *found;
      done = next;
    } else if (piece > shortest_piece) {
      piece *= 0.5;
    } else {
      return std::nullopt;
    }
  }
  return at;
}

}  // namespace ninedof
