/// The published design through the installed headers and library: exit status 0 if its condition number is right.

#include <cmath>
#include <cstdio>
#include <ninedof/conditioning/conditioning.hpp>
#include <ninedof/optimize/optimize.hpp>
#include <ninedof/robot/configuration.hpp>
#include <ninedof/robot/geometry.hpp>

int main() {
  // Base triangle of side 5.8124, platform triangle of half that side, O at the best height between them.
  const ninedof::Geometry geometry = ninedof::Geometry::hexagonal(0.0, 5.8124, 2.9062, 0.0);
  const ninedof::Configuration configuration = ninedof::neutral(3.9828, 2.4432);
  const double kappa = ninedof::condition_number(geometry, configuration);
  const double expected = 3.9070664186;
  std::printf("condition number %.10f, expected %.10f\n", kappa, expected);
  if (!(std::abs(kappa - expected) < 1e-9)) return 1;

  // One start of the optimizer: this reaches NLopt and the threads, so a dependency the package forgot fails to link.
  ninedof::Problem problem;
  for (const auto& variable : ninedof::design_family(problem.family).variables())
    problem.variables.push_back({variable.low, variable.high});
  problem.limits = {{.name = "radius_ratio", .high = 2.0}};
  const ninedof::Result result = ninedof::optimize(problem, {.starts = 1, .threads = 1});
  const double best = result.candidates.empty() ? HUGE_VAL : result.candidates.front().condition_number;
  std::printf("least condition number with a base at most twice the platform %.6f, expected 3.762659\n", best);
  return std::abs(best - 3.762659) < 1e-5 ? 0 : 1;
}
