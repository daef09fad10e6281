#include "ninedof/conditioning/axis_spectrum.hpp"

#include <algorithm>
#include <cmath>

namespace ninedof {

AxisSpectrum<double> axis_spectrum_of_any_size(const AxisDesign<double>& d, double characteristic_length) {
  const auto largest = [](const Xyz<double>& a) { return std::max({std::abs(a.x), std::abs(a.y), std::abs(a.z)}); };
  const double size = std::max({largest(d.base_external), largest(d.base_internal), largest(d.platform_external),
                                largest(d.platform_internal), std::abs(d.zp), std::abs(d.zs)});
  constexpr double ordinary = 0x1p50;
  if (!(size > ordinary || size < 1.0 / ordinary) || size == 0.0) return axis_spectrum(d, characteristic_length);
  const int exponent = std::ilogb(size);
  const auto scaled = [&](double x) { return std::ldexp(x, -exponent); };
  const auto scaled_point = [&](const Xyz<double>& a) -> Xyz<double> {
    return {scaled(a.x), scaled(a.y), scaled(a.z)};
  };
  AxisSpectrum<double> out =
      axis_spectrum(AxisDesign<double>{scaled_point(d.base_external), scaled_point(d.base_internal),
                                       scaled_point(d.platform_external), scaled_point(d.platform_internal),
                                       scaled(d.zp), scaled(d.zs)},
                    scaled(characteristic_length));
  for (double* length : {&out.l, &out.q, &out.r}) *length = std::ldexp(*length, exponent);
  return out;
}

}  // namespace ninedof
