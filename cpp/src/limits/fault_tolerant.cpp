/// fault_tolerant: the condition number of J' with one internal leg locked, for each of the six. An external leg takes
/// a freedom in every design (conditioning/locked_legs.hpp), and is no item. Not a formula over every number type: a
/// dual through singular values is wrong at ties, and over boxes of poses matrices are tested
/// (conditioning/forms/split.cpp). Declared in limits/rows.hpp.

#include <cmath>

#include "limits/rows.hpp"
#include "ninedof/conditioning/locked_legs.hpp"

namespace ninedof {
namespace {

struct FaultTolerant {
  static constexpr int items = 6, first_locked = 3;

  static std::string part(int item) { return leg_name(first_locked + item); }
  static double number(const PointLook& look, int item) {
    const LockedLegs legs(look.here().at, look.here().legs, look.characteristic_length());
    return legs.condition_number({first_locked + item});
  }
  static void numbers(const PointLook& look, double* out) {
    const LockedLegs legs(look.here().at, look.here().legs, look.characteristic_length());
    for (int item = 0; item < items; ++item) out[item] = legs.condition_number({first_locked + item});
  }
  static double slopes(const PointLook& look, int item, PointSlopes& out) {
    const double kappa = number(look, item);
    out.points = out.home_points = 0;
    out.turns = false;
    out.length = 0.0;
    if (!std::isfinite(kappa)) return kappa;
    const PosedPoints& here = look.here();
    const Spectrum s = locked_spectrum(here.at, here.legs, look.characteristic_length(), first_locked + item);
    PointGradient by = zero_gradient();
    for (const auto& [place, sign] : {std::pair{0, 1.0}, std::pair{5, -1.0}}) {
      const double sigma = s.sigma[place];
      add_spectrum_gradient(here.at, here.legs, s, place, place, sign * 0.5 * kappa / (sigma * sigma), by);
    }
    for (int point = 0; point < point_count; ++point)
      out.at[at_index(out.points++)] = {point, by.point[at_index(point)]};
    out.length = by.length;
    return kappa;
  }
};

}  // namespace

constinit const PoseRow fault_tolerant_row = pose_row_of<FaultTolerant>();

}  // namespace ninedof
