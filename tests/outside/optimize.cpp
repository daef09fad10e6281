/// A machine found and certified in C++ alone: the study of examples/18_requirement, in millimetres. Exit status 0 if
/// the optimum is the known one and every limit is proved at every pose of the region.

#include <cmath>
#include <cstdio>
#include <ninedof/optimize/region_study.hpp>
#include <ninedof/proof/machine.hpp>

using namespace ninedof;

int main() {
  const double degree = std::acos(-1.0) / 180.0;
  Problem study;  // a1, a2, b1, b2, zp, zs, theta_z; two sides of 0: joints in pairs
  study.variables = {{0.0, 0.0}, {100.0, 850.0}, {50.0, 350.0}, {0.0, 0.0}, {300.0, 700.0}, {50.0, 650.0}, {0.0, 0.0}};
  study.characteristic_length.value = 150.0;
  study.limits = {{.name = "stroke_ratio", .high = 1.4},
                  {.name = "base_cone", .high = 45.0 * degree},
                  {.name = "platform_cone", .high = 45.0 * degree},
                  {.name = "leg_clearance", .low = 20.0}};
  Region region;  // every tilt up to 10 degrees at every position of a box
  region.size = {60.0, 60.0, 40.0};
  region.tilt = 10.0 * degree;

  RegionStudySettings settings;
  settings.phase = [](const std::string& words) { std::printf("%s\n", words.c_str()); };
  const RegionResult found = optimize_region(study, region, settings);
  std::printf("%s: %s\n", to_string(found.result.status), found.result.reason.c_str());
  if (found.result.candidates.empty()) return 1;
  const Candidate& best = found.result.candidates.front();
  std::printf("worst condition number %.6f, at most %.1e left to gain\n", best.objective, found.region.gain);

  const DesignFamily& family = design_family(study.family);
  const std::span<const double> x{best.variables.data(), family.variables().size()};
  for (std::size_t k = 0; k < x.size(); ++k) std::printf("  %s = %.4f\n", family.variables()[k].name.c_str(), x[k]);
  const PosedRobot machine{family.geometry(x), family.configuration(x), best.characteristic_length, {region}, {}, {}};

  bool proved = true;
  for (const LimitOverPoses& one :
       limits_over_poses(machine, study.limits, exempt_pairs(study), margin_tolerance, {}).limits) {
    proved = proved && one.answer == LimitOverPoses::Answer::proved;
    std::printf("%s %s: worst in [%.6g, %.6g], limit %.6g (%s)\n", one.name.c_str(),
                one.side == Side::high ? "max" : "min", one.value.lo, one.value.hi, one.limit, one.part.c_str());
  }
  const Extreme worst = worst_condition(machine, {.gap = 0.05}).extreme;
  std::printf("worst condition number: %.6f was met, at most %.6f\n", worst.low, worst.high);
  const bool known = std::abs(best.objective - 4.023420) < 1e-6 && found.region.gain <= 1e-7;
  return known && found.result.status == Status::optimal && proved && worst.high < 4.25 ? 0 : 1;
}
