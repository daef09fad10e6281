/// form.hpp: every value of a formula at a point of the box lies within what its form allows. Oracle: the same
/// formula in long double at random points.

#include "math/form.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <random>

using namespace ninedof;

namespace {

using Point = std::array<double, PoseForm::size>;

template <class T>
struct BothOf {
  T form;
  long double value;
};

/// Whether the value is within the error of the form at the point.
template <class T>
bool holds(const BothOf<T>& x, const Point& t) {
  long double linear = x.form.c;
  for (std::size_t k = 0; k < T::size; ++k) linear += static_cast<long double>(x.form.a[k]) * t[k];
  for (std::size_t k = 0, n = 0; k < T::size && T::curved; ++k)
    for (std::size_t l = 0; l <= k; ++l, ++n) linear += static_cast<long double>(x.form.q[n]) * t[k] * t[l];
  return !(std::abs(x.value - linear) > x.form.r) && lower(x.form) <= x.value && x.value <= upper(x.form);
}

long double mean_cosine(long double u) {  // (1 - cos(theta)) / theta^2
  const long double half = std::sqrt(u) / 2.0L;
  return u < 1e-12L ? 0.5L - u / 24.0L : 0.5L * (std::sin(half) / half) * (std::sin(half) / half);
}

}  // namespace

TEST_SUITE("form") {
  TEST_CASE_TEMPLATE("values at points of a box are within the error of a form", T, PoseForm, CurvedForm) {
    using Both = BothOf<T>;
    std::mt19937_64 random(5);
    std::uniform_real_distribution<double> any(-1.0, 1.0);
    for (int trial = 0; trial < 20'000; ++trial) {
      const double size = std::exp(6.0 * any(random) - 4.0);
      Point t;
      for (double& x : t) x = trial % 3 == 0 ? std::copysign(1.0, any(random)) : any(random);
      std::array<Both, 3> x;
      for (std::size_t k = 0; k < x.size(); ++k) {
        const double middle = 3.0 * any(random), low = middle - size * std::abs(any(random)),
                     high = middle + size * std::abs(any(random));
        x[k].form = T::coordinate(low, high, k);
        x[k].value =
            0.5L * (static_cast<long double>(low) + high) + 0.5L * (static_cast<long double>(high) - low) * t[k];
      }
      const auto check = [&](const T& form, long double value) {
        const Both both{form, value};
        CHECK(holds(both, t));
        return both;
      };
      const Both sum = check(x[0].form + x[1].form, x[0].value + x[1].value);
      const Both product = check(sum.form * x[2].form, sum.value * x[2].value);
      const Both square = check(product.form * product.form - 0.3 * x[0].form,
                                product.value * product.value - static_cast<long double>(0.3) * x[0].value);
      const Both positive = check(square.form * square.form + 1.0, square.value * square.value + 1.0L);
      check(inverse(positive.form), 1.0L / positive.value);
      check(inverse_root(positive.form), 1.0L / std::sqrt(positive.value));
      check(sin(product.form), std::sin(product.value));
      check(cos(product.form), std::cos(product.value));
      const Both angle =
          check(x[0].form * x[0].form + x[1].form * x[1].form, x[0].value * x[0].value + x[1].value * x[1].value);
      if (upper(angle.form) > 19.0) continue;
      const long double theta = std::sqrt(angle.value);
      check(sine_over(angle.form), theta < 1e-9L ? 1.0L : std::sin(theta) / theta);
      check(one_minus_cosine_over(angle.form), mean_cosine(angle.value));
    }
  }
  TEST_CASE("the error of a product of degree 2 is of third order in the size of the box") {
    const auto error = [](double half) {
      const CurvedForm x = CurvedForm::coordinate(1.0 - half, 1.0 + half, 0),
                       y = CurvedForm::coordinate(2.0 - half, 2.0 + half, 1);
      return (x * x * y * sin(x)).r;
    };
    CHECK(error(1e-2) < 1.1e-3 * error(1e-1));
    CHECK(error(1e-3) < 1.1e-3 * error(1e-2));
  }
  TEST_CASE("nothing is known of what may be divided by zero") {
    const PoseForm x = PoseForm::coordinate(-1.0, 2.0, 0);
    CHECK(std::isinf(upper(inverse(x))));
    CHECK(std::isinf(lower(inverse_root(x))));
    CHECK(std::isinf(upper(inverse(x) * x - inverse(x))));
  }
  TEST_CASE("errors of roots do not get lost where powers leave the doubles") {
    std::mt19937_64 random(7);
    std::uniform_real_distribution<double> any(0.1, 1.0);
    for (int trial = 0; trial < 100; ++trial) {
      PoseForm x(any(random));
      x.a[0] = 0.9 * any(random) * x.c;
      const PoseForm small = 0x1p-420 * x;
      CHECK(inverse_root(small).r * 0x1p-210 >= inverse_root(x).r * (1.0 - 1e-13));
    }
  }

  TEST_CASE("the error is of second order in the size of the box") {
    const auto error = [](double half) {
      const PoseForm x = PoseForm::coordinate(1.0 - half, 1.0 + half, 0),
                     y = PoseForm::coordinate(2.0 - half, 2.0 + half, 1);
      return (inverse_root(x * x + y * y) * x * y).r;
    };
    CHECK(error(1e-3) < 1.1e-2 * error(1e-2));
    CHECK(error(1e-4) < 1.1e-2 * error(1e-3));
  }
}
