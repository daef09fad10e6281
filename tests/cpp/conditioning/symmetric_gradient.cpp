/// symmetric.hpp: exact gradients by dual numbers, against differences, for neutral, tiny, huge and random designs, and
/// at singular designs.

#include <doctest/doctest.h>

#include <algorithm>

#include "support/axis.hpp"
#include "support/support.hpp"

using namespace ninedof;
using namespace support;
using namespace axis;

namespace {

/// Gradients of all seven quantities against fourth-order differences of the same formula over plain doubles: they
/// share the formula (tested elsewhere) but no rule of differentiation.
void check_gradients(const Flat& x, double lc, double tolerance) {
  using D = Dual<coordinates>;
  std::array<D, coordinates> variables;
  double size = 0.0;
  for (std::size_t k = 0; k < x.size(); ++k) {
    variables[k] = D::variable(x[k], static_cast<int>(k));
    size = std::max(size, std::abs(x[k]));
  }
  const auto exact = values(axis_spectrum(design_of(variables), lc));
  const auto plain = values(axis_spectrum(design_of(x), lc));
  for (std::size_t v = 0; v < exact.size(); ++v) CHECK(relative_error(exact[v].value, plain[v]) <= 16.0 * eps);
  for (std::size_t k = 0; k < x.size(); ++k) {
    const double h = 2e-4 * size;
    const auto at = [&](int steps) {
      Flat y = x;
      y[k] += steps * h;
      return values(axis_spectrum(design_of(y), lc));
    };
    const auto a = at(-2), b = at(-1), c = at(1), d = at(2);
    for (std::size_t v = 0; v < exact.size(); ++v) {
      const double expected = (8.0 * (c[v] - b[v]) - (d[v] - a[v])) / (12.0 * h);
      CAPTURE(k);
      CAPTURE(v);
      CHECK(std::abs(exact[v].gradient[k] - expected) * size <=
            tolerance * std::max(plain[v], std::abs(expected) * size));
    }
  }
}

/// Not close to a kink (a singular value of zero, two equal ones of a pair) and not close to a singularity.
bool smooth(const AxisSpectrum<double>& s) {
  return s.axial_min > 0.05 * s.axial_max && s.axial_min < 0.95 * s.axial_max &&
         s.transverse_min > 0.05 * s.transverse_max && s.transverse_min < 0.95 * s.transverse_max;
}

}  // namespace

TEST_SUITE("symmetric_gradient") {
  TEST_CASE("exact gradients: random designs") {
    Random random(105);
    int checked = 0;
    while (checked < 100) {
      const auto [g, c] = random_symmetric_robot(random);
      const AxisDesign<double> d = axis_design(g, c);
      if (!smooth(axis_spectrum(d, 1.0))) continue;
      check_gradients(flat(d), 1.0, 1e-7);
      ++checked;
    }
  }

  TEST_CASE("exact gradients: hexagons at the neutral configuration, coupled joints included") {
    Random random(106);
    int checked = 0;
    while (checked < 50) {
      const double a1 = checked % 2 == 0 ? 0.0 : random.uniform(0.0, 1.0),
                   b2 = checked % 3 == 0 ? 0.0 : random.uniform(0.0, 1.0);
      const Geometry g = Geometry::hexagonal(a1, random.uniform(2.0, 6.0), random.uniform(1.0, 3.0), b2);
      const AxisDesign<double> d = axis_design(g, neutral(random.uniform(2.5, 5.0), random.uniform(0.5, 2.0)));
      if (!smooth(axis_spectrum(d, 1.0))) continue;
      check_gradients(flat(d), 1.0, 1e-7);
      ++checked;
    }
  }

  TEST_CASE("exact gradients: tiny and huge robots") {
    Random random(107);
    for (const double scale : {1e-9, 1e-3, 1e3, 1e9})
      for (int checked = 0; checked < 10;) {
        const auto [g, c] = scaled(random_symmetric_robot(random), scale);
        const AxisDesign<double> d = axis_design(g, c);
        if (!smooth(axis_spectrum(d, scale))) continue;
        check_gradients(flat(d), scale, 1e-7);
        ++checked;
      }
  }

  TEST_CASE("singular designs: the least singular value is zero or rounding, values and gradients stay finite") {
    using D = Dual<coordinates>;
    const auto least = [](const Geometry& g, const Configuration& c) {
      const Flat x = flat(axis_design(g, c));
      std::array<D, coordinates> variables;
      for (std::size_t k = 0; k < x.size(); ++k) variables[k] = D::variable(x[k], static_cast<int>(k));
      double smallest = infinity;
      for (const D& v : values(axis_spectrum(design_of(variables), 1.0))) {
        CHECK(std::isfinite(v.value));
        for (const double slope : v.gradient) CHECK(std::isfinite(slope));
        smallest = std::min(smallest, v.value);
      }
      return smallest;
    };
    const Geometry g = Geometry::hexagonal(0.5, 3, 2, 0.5), alike = Geometry::hexagonal(0.5, 3, 0.5, 3);
    CHECK(least(g, neutral(2, 0)) == 0.0);  // det B
    CHECK(least(alike, neutral(0, 1)) == 0.0);  // external legs of zero length
    CHECK(least(g, neutral(2, 2)) == 0.0);  // det C
    CHECK(least(Geometry::hexagonal(1, 2, 0.5, 1), neutral(2, 1)) <= 4.0 * eps);  // det N: similar hexagons
    CHECK(least(Geometry::hexagonal(0, 3, 0, 2), neutral(3, 1)) <= 4.0 * eps);
  }
}
