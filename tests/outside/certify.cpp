/// A machine certified in C++ alone: the design of examples/18_requirement over its region, in millimetres. Exit status
/// 0 if every limit is kept everywhere, the worst condition number is proved, and the nearest singularity is found.

#include <cmath>
#include <cstdio>
#include <ninedof/problem/problem.hpp>
#include <ninedof/proof/machine.hpp>
#include <ninedof/singularity/singularity.hpp>

using namespace ninedof;

int main() {
  const double degree = std::acos(-1.0) / 180.0;
  PosedRobot machine{Geometry::hexagonal(0.0, 850.0, 292.90821, 0.0), neutral(483.34702, 319.32469), 150.0, {}, {}, {}};
  Region region;
  region.size = {60.0, 60.0, 40.0};
  region.tilt = 10.0 * degree;
  machine.region.push_back(region);

  Problem study;  // whose designs say which legs may meet
  for (const auto& v : design_family(study.family).variables()) study.variables.push_back({v.low, v.high});
  for (const int side_of_no_length : {0, 3}) study.variables[static_cast<std::size_t>(side_of_no_length)] = {0.0, 0.0};
  study.limits = {{.name = "stroke_ratio", .high = 1.4},
                  {.name = "base_cone", .high = 45.0 * degree},
                  {.name = "platform_cone", .high = 45.0 * degree},
                  {.name = "leg_clearance", .low = 20.0}};

  bool kept = true;
  const LimitsOverPoses found = limits_over_poses(machine, study.limits, exempt_pairs(study), 1e-6, {});
  for (const LimitOverPoses& one : found.limits) {
    const bool high = one.side == Side::high;
    kept = kept && one.answer == LimitOverPoses::Answer::proved;
    std::printf("%s: %s %.6g, limit %.6g (%s)\n", one.name.c_str(), high ? "at most" : "at least",
                high ? one.value.hi : one.value.lo, one.limit, one.part.c_str());
  }
  const Extreme worst = worst_condition(machine, {.gap = 0.05}).extreme;
  std::printf("worst condition number: %.6f was met, at most %.6f\n", worst.low, worst.high);

  Motions shifts = Motions::Zero();  // of the platform, O at rest
  shifts.middleRows<3>(3).setIdentity();
  const NearestSingularity nearest = nearest_singularity(machine.geometry, {machine.neutral}, shifts, 1000.0);
  std::printf("nearest singularity: %.4f mm (%s)\n", nearest.distance, to_string(nearest.mechanism));
  const bool proved = worst.low > 4.01 && worst.high < 4.25, near = std::abs(nearest.distance - 164.0223) < 1e-3;
  return kept && proved && near ? 0 : 1;
}
