/// interval.hpp: ends at zero and infinity, turning points, the closed form. Against balls of 200 bits in
/// tests/python/proof/test_interval.py.

#include "ninedof/math/interval.hpp"

#include <doctest/doctest.h>

#include <limits>

#include "ninedof/conditioning/symmetric.hpp"
#include "ninedof/math/dual.hpp"
#include "ninedof/math/error.hpp"

using namespace ninedof;

namespace {

constexpr double inf = std::numeric_limits<double>::infinity();
constexpr double least = std::numeric_limits<double>::denorm_min();

bool inside(const Interval& outer, const Interval& inner) {
  return outer.lo <= inner.lo && inner.hi <= outer.hi;
}

/// The closed form at the published sides, over a number type.
template <class T>
AxisSpectrum<T> published_sides(const T& zp, const T& zs) {
  const T a(5.8124), b(2.9062), none(0.0);
  const AxisDesign<T> d{{0.5 * a, 0.25 * a, none},
                        {0.5 * a, -0.25 * a, none},
                        {0.5 * b, -0.25 * b, none},
                        {0.5 * b, 0.25 * b, none},
                        zp,
                        zs};
  return axis_spectrum(d, T(1.0));
}

}  // namespace

TEST_SUITE("interval") {
  TEST_CASE("an inverted interval is refused") {
    CHECK_THROWS_WITH_AS(Interval::between(2.0, 1.0), "interval: got [2, 1], expected a lower end at most the upper",
                         InvalidArgument);
    CHECK_THROWS_AS(Interval::between(std::nan(""), 1.0), InvalidArgument);
    CHECK(Interval::between(1.0, 1.0).lo == 1.0);
  }

  TEST_CASE("no end becomes NaN at zero and infinity") {
    const Interval zero(0.0), all = Interval::whole(), positive(0.0, inf), huge(1e308, inf);
    for (const Interval& a : {zero, all, positive, huge, -huge, Interval(-1.0, 1.0), Interval(least)})
      for (const Interval& b : {zero, all, positive, huge, -huge, Interval(-1.0, 1.0), Interval(least)})
        for (const Interval& r :
             {a + b, a - b, a * b, a / b, square(a), sqrt(a), abs(a), exp(a), log(a), sin(a), cos(a), atan(a), acos(a)})
          CHECK(r.lo <= r.hi);  // false for NaN
    CHECK(inside(zero * all, zero));
    CHECK((1.0 / Interval(-1.0, 1.0)).hi == inf);
    CHECK((huge * huge).lo <= std::numeric_limits<double>::max());
    CHECK((Interval(least) * Interval(0.5)).lo == 0.0);
    CHECK((Interval(least) * Interval(0.5)).hi >= least);
  }

  TEST_CASE("turning points of sine and cosine are found") {
    CHECK(sin(Interval(1.0, 2.0)).hi == 1.0);
    CHECK(sin(Interval(4.0, 5.0)).lo == -1.0);
    CHECK(cos(Interval(-0.1, 0.1)).hi == 1.0);
    CHECK(cos(Interval(3.0, 3.2)).lo == -1.0);
    CHECK(cos(Interval(6.2, 6.4)).hi == 1.0);
    CHECK(cos(Interval(0.1, 3.0)).hi < 1.0);
    CHECK(sin(Interval(1e300)).lo == -1.0);
  }

  TEST_CASE("angles keep their ends") {
    CHECK(contains(atan(Interval(-1.0, inf)), -0.785398163397448));
    CHECK(atan(Interval(-1.0, inf)).hi == doctest::Approx(1.5707963267948966));
    CHECK(acos(Interval(-2.0, 2.0)).lo == 0.0);
    CHECK(acos(Interval(-2.0, 2.0)).hi > 3.141592653589793);
    CHECK(acos(Interval(0.0)).hi - acos(Interval(0.0)).lo < 1e-14);
  }

  TEST_CASE("the closed form over intervals encloses its values and gradients over a box") {
    const Interval zp(3.95, 4.0), zs(2.40, 2.44);
    const auto box = published_sides(zp, zs);
    const auto slopes = published_sides(Dual<2, Interval>::variable(zp, 0), Dual<2, Interval>::variable(zs, 1));
    const auto curved = [&](double p, double s) {
      using First = Dual<2, Interval>;
      Dual<2, First> x(First::variable(p, 0)), y(First::variable(s, 1));
      x.gradient[0] = First(1.0);
      y.gradient[1] = First(1.0);
      return published_sides(x, y).axial_max.gradient[0].gradient[1];
    };
    for (double a : {0.0, 0.3, 1.0})
      for (double b : {0.0, 0.6, 1.0}) {
        const double p = zp.lo + a * width(zp), s = zs.lo + b * width(zs);
        const auto value = published_sides(p, s);
        const auto gradient = published_sides(Dual<2>::variable(p, 0), Dual<2>::variable(s, 1));
        CHECK(contains(box.axial_max, value.axial_max));
        CHECK(contains(box.transverse_min, value.transverse_min));
        for (std::size_t k = 0; k < 2; ++k) {
          CHECK(contains(slopes.axial_min.gradient[k], gradient.axial_min.gradient[k]));
          CHECK(contains(slopes.transverse_max.gradient[k], gradient.transverse_max.gradient[k]));
        }
        const double h = 1e-5;
        const auto slope = [&](double at) {
          return published_sides(Dual<2>::variable(p, 0), Dual<2>::variable(at, 1)).axial_max.gradient[0];
        };
        CHECK(middle(curved(p, s)) == doctest::Approx((slope(s + h) - slope(s - h)) / (2.0 * h)).epsilon(1e-6));
      }
  }

  TEST_CASE("the middle lies inside, of the smallest and of the largest numbers too") {
    const double least = std::numeric_limits<double>::denorm_min(), most = std::numeric_limits<double>::max();
    for (const Interval& x : {Interval(least), Interval(-least), Interval(3.0 * least), Interval(least, 2.0 * least),
                              Interval(-most, most), Interval(most), Interval(0.5 * most, most), Interval::whole()})
      CHECK(contains(x, middle(x)));
  }

  TEST_CASE("the arithmetic of this process is sound") {
    CHECK(arithmetic_fault() == nullptr);
  }
}
