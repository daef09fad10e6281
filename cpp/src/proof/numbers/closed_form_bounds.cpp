#include "ninedof/proof/closed_form_bounds.hpp"

#include "ninedof/conditioning/symmetric.hpp"
#include "ninedof/math/error.hpp"
#include "ninedof/math/length_range.hpp"
#include "ninedof/proof/bounds.hpp"
#include "proof/numbers/condition_bounds.hpp"
#include "proof/numbers/leg_bounds.hpp"

namespace ninedof {

Interval axis_condition_number_bounds(const Geometry& g, const Configuration& c, double characteristic_length) {
  require_length("characteristic_length", characteristic_length);
  require_sound_arithmetic();
  const AxisDesign<double> d = axis_design(g, c);  // for its checks
  const auto exact = [](const Xyz<double>& v) { return Xyz<Interval>{v.x, v.y, v.z}; };
  const LegBounds k = leg_bounds(g, c);
  const AxisSpectrum<Interval> s = axis_spectrum(
      AxisDesign<Interval>{exact(d.base_external), exact(d.base_internal), k.u[0], k.u_tilde[0], d.zp, d.zs},
      Interval(characteristic_length));
  return at_least_one(ratio_bounds(max(s.axial_max, s.transverse_max), min(s.axial_min, s.transverse_min)));
}

}  // namespace ninedof
