/// Designs on their axis: the closed forms, alone and in stacks, against the singular values of the general matrix and
/// against proved bounds.

#include <algorithm>
#include <array>

#include "ninedof/batch/batch.hpp"
#include "ninedof/conditioning/conditioning.hpp"
#include "ninedof/conditioning/symmetric.hpp"
#include "ninedof/proof/bounds.hpp"
#include "ninedof/proof/closed_form_bounds.hpp"
#include "ninedof/robot/legs.hpp"
#include "support/bytes.hpp"

using namespace fuzz;

namespace {

/// Above it, divided by `shortness`, a condition number says no more than that the design is singular or nearly so.
constexpr double trusted = 1e12;

double condition(const AxisSpectrum<double>& s) {
  return std::max(s.axial_max, s.transverse_max) / std::min(s.axial_min, s.transverse_min);
}

/// Equal but for rounding, which a badly conditioned design magnifies, and so does a leg much shorter than the
/// coordinates of its ends: the two ways round the images of the first joints differently.
bool agree(double a, double b, double shortness) {
  const double loss = 1e-12 + 1e-14 * (std::min(a, b) + shortness) * shortness;
  if (!(loss < 1e-2)) return true;
  return std::abs(a / b - 1.0) <= loss;
}

/// The largest coordinate over the shortest leg.
double shortness_of(const Geometry& g, const Configuration& c) {
  double most = c.position.cwiseAbs().maxCoeff() + c.internal_point.cwiseAbs().maxCoeff();
  for (const Triple* t : {&g.base_external(), &g.base_internal(), &g.platform_external(), &g.platform_internal()})
    for (const Vec3& joint : *t) most = std::max(most, joint.cwiseAbs().maxCoeff());
  return std::max(1.0, most) / leg_lengths(g, c).minCoeff();  // 1: the characteristic length
}

void compare(const Geometry& g, const Configuration& c, double kappa, const Interval& proved) {
  EXPECT(proved.lo <= proved.hi && proved.lo >= 1.0);
  const double shortness = shortness_of(g, c);
  EXPECT(agree(kappa, condition_number(g, c), shortness));
  const Interval general = condition_number_bounds(g, c);
  const double loss = 1.0 + 1e-12 + 1e-14 * (kappa + shortness) * shortness;
  EXPECT(general.lo <= proved.hi * loss && proved.lo <= general.hi * loss);
  if (kappa * shortness < trusted) EXPECT(proved.lo <= kappa * loss && proved.hi * loss >= kappa);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Bytes in(data, size);
  std::array<double, 6> design{};
  const bool wild = in.byte() >= 192;
  for (double& x : design) x = wild ? in.any() : in.near_coarse();
  double kappa = 0.0;
  std::array<double, 2> proved{};
  batch::hexagonal_condition_numbers(design.data(), 1, &kappa);
  hexagonal_condition_number_bounds(design.data(), 1, proved.data());
  EXPECT(kappa >= 1.0 || wild);
  EXPECT(!std::isnan(kappa) || wild);
  EXPECT(proved[0] <= proved[1]);
  try {
    const Geometry g = Geometry::hexagonal(design[0], design[1], design[2], design[3]);
    const Configuration c = neutral(design[4], design[5]);
    if (!wild) compare(g, c, kappa, {proved[0], proved[1]});
  } catch (const InvalidArgument&) {
  }

  std::array<Orbit, 4> orbits;
  for (Orbit& o : orbits) o = {in.near_coarse(), in.near_coarse(), in.near_coarse()};
  const double zp = in.near_coarse(), zs = in.near_coarse(), turn = in.near_coarse();
  try {
    const Geometry g = Geometry::symmetric(orbits[0], orbits[1], orbits[2], orbits[3]);
    const Configuration c = neutral(zp, zs, turn);
    compare(g, c, condition(axis_spectrum(axis_design(g, c), 1.0)), axis_condition_number_bounds(g, c));
  } catch (const InvalidArgument&) {
  }
  return 0;
}
