#pragma once
/// What every family of C3 designs on the axis shares: from an AxisDesign over duals to quantities with gradients.

#include <algorithm>
#include <array>

#include "ninedof/design.hpp"
#include "ninedof/error.hpp"
#include "ninedof/symmetric.hpp"

namespace ninedof {

/// Derived must offer `template <class T> AxisDesign<T> axis_design(const std::array<T, N>&) const`.
template <class Derived, int N>
class AxisFamily : public DesignFamily {
 public:
  void evaluate(std::span<const double> x, double characteristic_length, DesignPoint& out) const override {
    using T = Dual<N>;
    require_positive("characteristic_length", characteristic_length);
    if (x.size() != N) throw InvalidArgument("x", std::to_string(x.size()) + " values", std::to_string(N));
    const AxisDesign<T> d = static_cast<const Derived&>(*this).axis_design(T::variables(x.first<N>()));
    const AxisSpectrum<T> s = axis_spectrum(d, characteristic_length);
    const T base = larger(radius(d.base_external), radius(d.base_internal));
    const T platform = larger(radius(d.platform_external), radius(d.platform_internal));
    out.gradient.resize(quantity_count, N);
    const std::array<const T*, quantity_count> all{
        &s.axial_max, &s.axial_min, &s.transverse_max, &s.transverse_min, &s.l, &s.q, &s.r, &base, &platform,
        &d.zp,        &d.zs};
    for (int row = 0; row < quantity_count; ++row) set_log(*all[index(row)], row, out);
  }

 private:
  static std::size_t index(int k) { return static_cast<std::size_t>(k); }

  template <class T>
  static T radius(const Point<T>& p) {
    return sqrt(p.x * p.x + p.y * p.y);
  }
  template <class T>
  static const T& larger(const T& a, const T& b) {
    return value_of(b) > value_of(a) ? b : a;
  }
  static void set_log(const Dual<N>& x, int row, DesignPoint& out) {
    constexpr double tiny = 1e-300;
    const bool gone = !(x.value > tiny);  // NaN included: a leg of zero length
    // Where even a largest singular value is gone the design must still look singular, not isotropic.
    const bool largest = row == log_axial_max || row == log_transverse_max;
    out.value[row] = std::log(!gone ? x.value : largest ? 1.0 : tiny);
    for (int k = 0; k < N; ++k) out.gradient(row, k) = gone ? 0.0 : x.gradient[index(k)] / x.value;
  }
};

}  // namespace ninedof
