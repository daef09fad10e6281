/// dual.hpp: every operator against differences of plain doubles.

#include "ninedof/math/dual.hpp"

#include <doctest/doctest.h>

#include <vector>

#include "support/support.hpp"

using namespace ninedof;
using namespace support;

namespace {

using D = Dual<2>;

template <class T>
concept divides_by_a_constant = requires(T x) { x / 1.7; };

/// Fourth-order central difference of f in coordinate k.
template <class F>
double difference(const F& f, std::array<double, 2> x, std::size_t k) {
  const double h = 1e-3 * std::min(1.0, std::abs(x[k]));
  const auto at = [&](double step) {
    std::array<double, 2> y = x;
    y[k] += step * h;
    return f(y[0], y[1]);
  };
  return (8.0 * (at(1.0) - at(-1.0)) - (at(2.0) - at(-2.0))) / (12.0 * h);
}

/// Compares a formula over dual numbers: its value with doubles, its gradient with differences.
template <class F>
void check_formula(const std::string& what, const F& f) {
  CAPTURE(what);
  Random random(21);
  for (int k = 0; k < 50; ++k) {
    const auto draw = [&] { return random.sign() * random.log_uniform(0.2, 3.0); };
    const std::array<double, 2> x{draw(), draw()};
    CAPTURE(x[0]);
    CAPTURE(x[1]);
    const D out = f(D::variable(x[0], 0), D::variable(x[1], 1));
    // Not bit-equal: a quotient is a product with the reciprocal.
    const double value = f(x[0], x[1]);
    CHECK(std::abs(out.value - value) <= 16.0 * eps * std::max(1.0, std::abs(value)));
    for (std::size_t i = 0; i < 2; ++i) {
      const double expected = difference(f, x, i);
      CHECK(std::abs(out.gradient[i] - expected) <= 1e-9 * std::max(1.0, std::abs(expected)));
    }
  }
}

}  // namespace

TEST_SUITE("dual") {
  TEST_CASE("sums, differences, products, quotients of two duals") {
    check_formula("+", [](const auto& x, const auto& y) { return x + y; });
    check_formula("-", [](const auto& x, const auto& y) { return x - y; });
    check_formula("*", [](const auto& x, const auto& y) { return x * y; });
    check_formula("/", [](const auto& x, const auto& y) { return x / y; });
    check_formula("unary -", [](const auto& x, const auto& y) { return -(x + y) - -x; });
  }

  TEST_CASE("with a constant on either side") {
    check_formula("x + c", [](const auto& x, const auto&) { return x + 1.7; });
    check_formula("c + x", [](const auto& x, const auto&) { return 1.7 + x; });
    check_formula("x - c", [](const auto& x, const auto&) { return x - 1.7; });
    check_formula("c - x", [](const auto& x, const auto&) { return 1.7 - x; });
    check_formula("x * c", [](const auto& x, const auto&) { return x * 1.7; });
    check_formula("c * x", [](const auto& x, const auto&) { return 1.7 * x; });
    check_formula("c / x", [](const auto& x, const auto&) { return 1.7 / x; });
    check_formula("integer", [](const auto& x, const auto& y) { return 2 * x - 3 / y + 1; });
  }

  TEST_CASE("a dual divided by a constant") {
    // A requires-expression: a missing operator fails this test instead of the build of all tests.
    check_formula("x / c", [](const auto& x, const auto&) {
      using T = std::decay_t<decltype(x)>;
      if constexpr (divides_by_a_constant<T>) return x / 1.7;
      else return x / T(1.7);
    });
    CHECK(divides_by_a_constant<D>);
  }

  TEST_CASE("functions") {
    check_formula("sqrt", [](const auto& x, const auto& y) {
      using std::sqrt;
      return sqrt(x * x + y * y + 0.1);
    });
    check_formula("log", [](const auto& x, const auto& y) {
      using std::log;
      return log(x * x + 0.5 * (y * y) + 3.0);
    });
    check_formula("sin", [](const auto& x, const auto& y) {
      using std::sin;
      return sin(x * y);
    });
    check_formula("cos", [](const auto& x, const auto& y) {
      using std::cos;
      return cos(x - 2.0 * y);
    });
    check_formula("abs", [](const auto& x, const auto& y) {
      using std::abs;
      return abs(x) * abs(y);
    });
  }

  TEST_CASE("a deep formula, the same variable in several places") {
    check_formula("deep", [](const auto& x, const auto& y) {
      using std::cos;
      using std::log;
      using std::sin;
      using std::sqrt;
      const auto r = sqrt(1.0 + x * x);
      return sin(x / (2.0 + cos(y))) * log(3.0 + r * r) - (y - 0.5) / (r + y * y) * (1.0 - x);
    });
  }

  TEST_CASE("constants have no gradient, variables a unit one") {
    const D constant = 3.5;
    CHECK(constant.value == 3.5);
    CHECK(constant.gradient == std::array{0.0, 0.0});
    CHECK(D::variable(-2.0, 1).gradient == std::array{0.0, 1.0});
    CHECK(D::variable(-2.0, 0).gradient == std::array{1.0, 0.0});
    CHECK(D().value == 0.0);
    CHECK(value_of(D::variable(-2.0, 0)) == -2.0);
    CHECK(value_of(-2.0) == -2.0);
  }

  TEST_CASE("square, and an odd number of variables") {
    check_formula("square", [](const auto& x, const auto& y) { return square(x - y) * square(y); });
    const std::array<double, 3> at{2.0, 3.0, 5.0};
    const auto [x, y, z] = Dual<3>::variables(at);
    const Dual<3> product = x * y * z;
    CHECK(product.value == 30.0);
    CHECK(product.gradient[0] == 15.0);
    CHECK(product.gradient[1] == 10.0);
    CHECK(product.gradient[2] == 6.0);
  }

  TEST_CASE("kinks: the derivative of sqrt at zero is 0, that of abs at zero is finite") {
    const D root = sqrt(D::variable(0.0, 0));
    CHECK(root.value == 0.0);
    CHECK(root.gradient == std::array{0.0, 0.0});
    const D size = abs(D::variable(0.0, 0));
    CHECK(size.value == 0.0);
    CHECK(std::abs(size.gradient[0]) <= 1.0);
  }

  TEST_CASE("NaN and infinity propagate") {
    CHECK(std::isnan(sqrt(D::variable(-1.0, 0)).value));
    CHECK(std::isnan(log(D::variable(-1.0, 0)).value));
    CHECK(std::isnan((D(not_a_number) * D::variable(1.0, 0)).value));
    CHECK(std::isinf((1.0 / D(0.0)).value));
    CHECK(std::isinf(log(D(0.0)).value));
  }
}
