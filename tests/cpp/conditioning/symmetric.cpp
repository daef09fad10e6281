/// symmetric.hpp against the general path of conditioning.hpp (which forms M from nine legs without symmetry), and
/// against the complex-step oracle where all singular values nearly meet. Gradients: symmetric_gradient.cpp.

#include "ninedof/conditioning/symmetric.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "ninedof/conditioning/axis_spectrum.hpp"
#include "ninedof/conditioning/conditioning.hpp"
#include "ninedof/robot/legs.hpp"
#include "support/axis.hpp"
#include "support/oracle.hpp"
#include "support/support.hpp"

using namespace ninedof;
using namespace support;
using namespace axis;

namespace {

/// The six singular values of M on the axis, the transverse pair twice, descending.
Vec6 six(const AxisSpectrum<double>& s) {
  Vec6 out;
  out << s.axial_max, s.axial_min, s.transverse_max, s.transverse_max, s.transverse_min, s.transverse_min;
  std::sort(out.begin(), out.end(), std::greater<>());
  return out;
}

double condition_number_of(const AxisSpectrum<double>& s) {
  return std::max(s.axial_max, s.transverse_max) / std::min(s.axial_min, s.transverse_min);
}

/// kappa = 1.0143, O far above the platform: found by random search.
const Robot almost_isotropic{Geometry::symmetric({5.962025, 0.320382, 0.416900}, {1.335971, -7.853464, 1.415718},
                                                 {1.879075, 3.964643, -0.095595}, {1.893601, 3.349726, -4.043400}),
                             neutral(0.512088, 10.699252)};

}  // namespace

TEST_SUITE("symmetric") {
  TEST_CASE(
      "10 000 random C3 designs, non-planar, rotated, O anywhere on the axis: all six singular values and the legs") {
    Random random(101);
    double worst = 0.0, worst_legs = 0.0;
    for (int n = 0; n < 10'000; ++n) {
      const auto [g, c] = random_symmetric_robot(random);
      const double lc = random.log_uniform(0.05, 20.0);
      const AxisSpectrum<double> s = axis_spectrum(axis_design(g, c), lc);
      const Vec6 expected = singular_values(g, c, lc).cwiseInverse().reverse();
      worst = std::max(worst, matrix_error(six(s), expected));
      Vec9 lengths;
      lengths << s.l, s.l, s.l, s.q, s.q, s.q, s.r, s.r, s.r;
      worst_legs = std::max(worst_legs, matrix_error(lengths, leg_lengths(g, c)));
    }
    CHECK(worst <= 32.0 * eps);
    CHECK(worst_legs <= 16.0 * eps);
  }

  TEST_CASE("the axial pair belongs to rotation about and translation along z") {
    // On the axis M^T M has (omega_z, p_z) as an invariant plane: eigenvalues of that 2x2 block of the general M.
    Random random(102);
    for (int n = 0; n < 1000; ++n) {
      const auto [g, c] = random_symmetric_robot(random);
      const AxisSpectrum<double> s = axis_spectrum(axis_design(g, c), 1.0);
      const Mat6 m = conditioning_matrix(g, c);
      const Mat6 square = m.transpose() * m;
      const double trace = square(2, 2) + square(5, 5), scale = square.trace();
      const double determinant = square(2, 2) * square(5, 5) - square(2, 5) * square(5, 2);
      CHECK(std::abs(s.axial_max * s.axial_max + s.axial_min * s.axial_min - trace) <= 32.0 * eps * scale);
      CHECK(std::abs(std::pow(s.axial_max * s.axial_min, 2) - determinant) <= 64.0 * eps * scale * scale);
    }
  }

  TEST_CASE("no digit is lost where all singular values are nearly equal") {
    // T^2 - 4 D^2 of the textbook form loses half the digits here.
    const auto& [g, c] = almost_isotropic;
    const AxisSpectrum<double> s = axis_spectrum(axis_design(g, c), 1.0);
    const oracle::Vector expected = oracle::singular_values(oracle::jacobian(g, c, 1.0));
    for (Eigen::Index k = 0; k < 6; ++k)
      CHECK(relative_error(six(s)[k], 1.0 / static_cast<double>(expected[5 - k])) <= 32.0 * eps);
    CHECK(condition_number_of(s) == doctest::Approx(1.014276).epsilon(1e-5));

    Random random(103);
    const Flat x = flat(axis_design(g, c));
    for (int n = 0; n < 300; ++n) {
      Flat y = x;
      for (double& value : y) value += 1e-3 * random.normal();
      const double lc = random.uniform(0.99, 1.01);
      const AxisDesign<double> d = design_of(y);
      const auto orbit = [](const Xyz<double>& p) { return Orbit{std::hypot(p.x, p.y), std::atan2(p.y, p.x), p.z}; };
      const Geometry near = Geometry::symmetric(orbit(d.base_external), orbit(d.base_internal),
                                                orbit(d.platform_external), orbit(d.platform_internal));
      const double general = condition_number(near, neutral(d.zp, d.zs), lc);
      CHECK(relative_error(condition_number_of(axis_spectrum(d, lc)), general) <= 32.0 * eps);
    }
  }

  TEST_CASE("the smallest singular value is accurate to the digits that its condition number allows") {
    Random random(104);
    for (int n = 0; n < 1000; ++n) {
      const auto [g, c] = random_symmetric_robot(random);
      const double expected = static_cast<double>(oracle::condition_number(g, c, 1.0));
      const double got = condition_number_of(axis_spectrum(axis_design(g, c), 1.0));
      CHECK(relative_error(got, expected) <= 32.0 * eps * expected);
    }
  }

  TEST_CASE("of any size: the bits of a design do not depend on the unit") {
    Random random(105);
    for (int n = 0; n < 100; ++n) {
      const auto [g, c] = random_symmetric_robot(random);
      const Flat x = flat(axis_design(g, c));
      const double expected = condition_number_of(axis_spectrum_of_any_size(design_of(x), 1.0));
      CHECK(relative_error(expected, condition_number_of(axis_spectrum(design_of(x), 1.0))) <= 32.0 * eps * expected);
      for (const int exponent : {-300, -90, 3, 90, 300}) {
        Flat y = x;
        for (double& value : y) value = std::ldexp(value, exponent);
        CHECK(condition_number_of(axis_spectrum_of_any_size(design_of(y), std::ldexp(1.0, exponent))) == expected);
      }
    }
  }

  TEST_CASE("axis_design takes platform joints in base axes and rejects asymmetric robots by name") {
    Random random(108);
    const auto [g, c] = random_symmetric_robot(random);
    const AxisDesign<double> d = axis_design(g, c);
    const Vec3 u = c.rotation * g.platform_external()[0], u_tilde = c.rotation * g.platform_internal()[0];
    CHECK(Vec3(d.platform_external.x, d.platform_external.y, d.platform_external.z) == u);
    CHECK(Vec3(d.platform_internal.x, d.platform_internal.y, d.platform_internal.z) == u_tilde);
    CHECK(Vec3(d.base_external.x, d.base_external.y, d.base_external.z) == g.base_external()[0]);
    CHECK(Vec3(d.base_internal.x, d.base_internal.y, d.base_internal.z) == g.base_internal()[0]);
    CHECK(d.zp == c.position.z());
    CHECK(d.zs == c.internal_point.z());

    const Triple &r = g.base_external(), &rh = g.base_internal(), &v = g.platform_external(),
                 &vt = g.platform_internal();
    const auto refused = [&](const std::string& name, const Geometry& geometry, const Configuration& at) {
      return refuses(name, [&] { axis_design(geometry, at); });
    };
    for (std::size_t joint = 0; joint < 3; ++joint) {
      const auto off = [&](Triple t) {
        t[joint] += Vec3(0, 0, 1e-6);
        return t;
      };
      CHECK(refused("base_external", {off(r), rh, v, vt}, c));
      CHECK(refused("base_internal", {r, off(rh), v, vt}, c));
      CHECK(refused("platform_external", {r, rh, off(v), vt}, c));
      CHECK(refused("platform_internal", {r, rh, v, off(vt)}, c));
    }
    CHECK(refused("base_external", {{r[0], r[2], r[1]}, rh, v, vt}, c));  // an orbit in the opposite direction
    Configuration moved = c;
    moved.position.x() += 1e-6;
    CHECK(refused("position", g, moved));
    moved = c;
    moved.internal_point.y() -= 1e-6;
    CHECK(refused("internal_point", g, moved));
    moved = c;
    moved.rotation = Eigen::AngleAxisd(1e-6, Vec3::UnitX()).toRotationMatrix() * c.rotation;
    CHECK(refused("rotation", g, moved));
    moved = c;
    moved.rotation.col(2) *= -1.0;
    CHECK(refused("rotation", g, moved));
    moved = c;
    moved.internal_point.z() = not_a_number;
    CHECK(refused("internal_point", g, moved));
    for (const double scale : {1e-12, 1e12})
      CHECK_NOTHROW(axis_design(scaled({g, c}, scale).geometry, scaled({g, c}, scale).configuration));
  }
}
