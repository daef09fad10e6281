#pragma once
/// What every family of C3 designs shares: from four orbits over dual numbers to blueprints and the closed form.

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "ninedof/conditioning/hexapod.hpp"
#include "ninedof/conditioning/symmetric.hpp"
#include "ninedof/families/design_family.hpp"
#include "ninedof/math/error.hpp"

namespace ninedof {

/// The first joint of each triple in its body's frame, and the neutral configuration, over a number type.
template <class T>
struct Orbits {
  Xyz<T> base_external, base_internal, platform_external, platform_internal;
  T zp, zs, theta_z;
};

/// Derived must offer `template <class T> Orbits<T> orbits(std::span<const T, N>) const`.
template <class Derived, int N>
class AxisFamily : public DesignFamily {
 public:
  bool symmetric() const override { return true; }

  void blueprint(std::span<const double> x, Blueprint& out) const override {
    const auto variables = Dual<N>::variables(checked(x));
    const Orbits<Dual<N>> o = derived().template orbits<Dual<N>>(variables);
    out.gradient.resize(blueprint_rows, N);
    place(o.base_external, point_r, out);
    place(o.base_internal, point_r_hat, out);
    place(o.platform_external, point_u, out);
    place(o.platform_internal, point_u_tilde, out);
    out.zp = o.zp.value;
    out.zs = o.zs.value;
    out.theta_z = o.theta_z.value;
    for (int k = 0; k < N; ++k) {
      out.gradient(row_zp, k) = o.zp.gradient[at(k)];
      out.gradient(row_zs, k) = o.zs.gradient[at(k)];
      out.gradient(row_theta_z, k) = o.theta_z.gradient[at(k)];
    }
  }

  void axis(std::span<const double> x, double characteristic_length, const AxisShift& shift, Machine machine,
            AxisPoint& out) const override {
    using T = Dual<N + 1>;  // the last one is the characteristic length
    require_positive("characteristic_length", characteristic_length);
    std::array<double, N + 1> all;
    std::ranges::copy(checked(x), all.begin());
    all[N] = characteristic_length;
    const auto variables = T::variables(std::span<const double, N + 1>(all));
    const AxisDesign<T> d = shifted(derived().template orbits<T>(std::span(variables).template first<N>()), shift);
    out.gradient.resize(AxisPoint::rows, N + 1);
    if (machine == Machine::nine_legged) {
      const AxisSpectrum<T> s = axis_spectrum(d, variables[N]);
      set(s, out);
    } else {
      const HexapodSpectrum<T> s = hexapod_spectrum(d, variables[N]);
      set(s, out);
    }
  }

 private:
  static std::size_t at(int k) { return static_cast<std::size_t>(k); }
  const Derived& derived() const { return static_cast<const Derived&>(*this); }

  static std::span<const double, N> checked(std::span<const double> x) {
    if (x.size() != N) throw InvalidArgument("x", std::to_string(x.size()) + " values", std::to_string(N));
    return x.first<N>();
  }

  /// Three joints from the first: -120 degrees at a time, as eqs. (37)-(38) number them.
  static void place(const Xyz<Dual<N>>& first, int triple, Blueprint& out) {
    static constexpr std::array<double, 3> cosine{1.0, -0.5, -0.5};
    static constexpr std::array<double, 3> sine{0.0, -0.5 * std::numbers::sqrt3, 0.5 * std::numbers::sqrt3};
    for (int i = 0; i < 3; ++i) {
      const double c = cosine[at(i)], s = sine[at(i)];
      const int row = 3 * (triple + i);
      out.joint[at(triple + i)] =
          Vec3(c * first.x.value - s * first.y.value, s * first.x.value + c * first.y.value, first.z.value);
      for (int k = 0; k < N; ++k) {
        const double dx = first.x.gradient[at(k)], dy = first.y.gradient[at(k)];
        out.gradient(row, k) = c * dx - s * dy;
        out.gradient(row + 1, k) = s * dx + c * dy;
        out.gradient(row + 2, k) = first.z.gradient[at(k)];
      }
    }
  }

  template <class T>
  static AxisDesign<T> shifted(const Orbits<T>& o, const AxisShift& by) {
    using std::cos;
    using std::sin;
    const T angle = o.theta_z + by.turn;
    const T c = cos(angle), s = sin(angle);
    const auto turned = [&](const Xyz<T>& u) { return Xyz<T>{c * u.x - s * u.y, s * u.x + c * u.y, u.z - by.tool}; };
    return {o.base_external,
            o.base_internal,
            turned(o.platform_external),
            turned(o.platform_internal),
            o.zp * (1.0 + by.p_in_zp) + by.tool + by.p,
            o.zs + o.zp * by.s_in_zp + by.s};
  }

  template <class S>
  static void set(const S& s, AxisPoint& out) {
    set_log(s.axial_max, AxisPoint::axial_max, 1.0, out);
    set_log(s.axial_min, AxisPoint::axial_min, AxisPoint::vanished, out);
    set_log(s.transverse_max, AxisPoint::transverse_max, 1.0, out);
    set_log(s.transverse_min, AxisPoint::transverse_min, AxisPoint::vanished, out);
  }

  static void set_log(const Dual<N + 1>& x, int row, double stand_in, AxisPoint& out) {
    const bool gone = !(x.value > AxisPoint::vanished);  // NaN included: a leg of zero length
    out.value[row] = std::log(gone ? stand_in : x.value);
    const double inverse = gone ? 0.0 : 1.0 / x.value;
    for (int k = 0; k <= N; ++k) out.gradient(row, k) = gone ? 0.0 : inverse * x.gradient[at(k)];
  }
};

}  // namespace ninedof
