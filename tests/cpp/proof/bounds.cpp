/// bounds.hpp and closed_form_bounds.hpp: arithmetic that is unfit is refused, sums that cancel are exact, small and
/// large matrices. Against balls of 400 bits in tests/python/proof.

#include "ninedof/proof/bounds.hpp"

#include <doctest/doctest.h>

#include <cfenv>
#include <stdexcept>

#include "ninedof/conditioning/conditioning.hpp"
#include "ninedof/math/error.hpp"
#include "ninedof/proof/closed_form_bounds.hpp"
#include "proof/numbers/exact_dot.hpp"
#include "proof/numbers/verified_singular_values.hpp"

using namespace ninedof;

TEST_SUITE("bounds") {
  TEST_CASE("another rounding mode is refused") {
    const Configuration c = neutral(3.9828, 2.3745);
    const double design[6] = {0.0, 5.8124, 2.9062, 0.0, 3.9828, 2.3745};
    double out[2];
    for (const int mode : {FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO}) {
      std::fesetround(mode);
      const auto with_mode_restored = [&](auto call) {
        try {
          call();
        } catch (...) {
          std::fesetround(FE_TONEAREST);
          throw;
        }
        std::fesetround(FE_TONEAREST);
      };
      CHECK_THROWS_WITH_AS(with_mode_restored([&] { condition_number_bounds(published, c); }),
                           "the arithmetic of this process is unfit for proofs: numbers are not rounded to nearest",
                           std::runtime_error);
      std::fesetround(mode);
      CHECK_THROWS_AS(with_mode_restored([&] { leg_length_bounds(published, c); }), std::runtime_error);
      std::fesetround(mode);
      CHECK_THROWS_AS(with_mode_restored([&] { hexagonal_condition_number_bounds(design, 1, out); }),
                      std::runtime_error);
    }
    CHECK(contains(condition_number_bounds(published, c), condition_number(published, c)));
  }

  TEST_CASE("a sum of products is known to the last bit however much cancels") {
    const double x = 1.0 + 0x1p-30;
    const Interval tiny = DotSum().product(x, x).number(-1.0).product(-2.0, 0x1p-30).value();
    CHECK(contains(tiny, 0x1p-60));
    CHECK(width(tiny) <= 1e-32);
    const Interval lost = DotSum().number(1e300).number(1.0).number(-1e300).value();
    CHECK(contains(lost, 1.0));
    CHECK(width(lost) <= 1e-14);
    CHECK(contains(DotSum().product(1e-200, 1e-200).value(), 0.0));
    CHECK(DotSum().product(1e-200, 1e-200).value().hi > 0.0);
    const Interval beyond = DotSum().product(1e200, 1e200).number(1.0).value();
    CHECK(beyond.lo <= std::numeric_limits<double>::max());
    CHECK(beyond.hi > std::numeric_limits<double>::max());
  }

  TEST_CASE("singular values of matrices that have known ones") {
    Mat6 m = Mat6::Zero();
    m.diagonal() << 3.0, -2.0, 1.0, 1.0, 1e-9, 0.0;
    const auto found = verified_singular_values(m, 0.0);
    const double expected[6] = {3.0, 2.0, 1.0, 1.0, 1e-9, 0.0};
    for (std::size_t k = 0; k < 6; ++k) CHECK(contains(found[k], expected[k]));
    CHECK(width(found[4]) < 1e-14);
    const auto wider = verified_singular_values(m, 0.25);
    CHECK(contains(wider[0], 3.25));
    CHECK(contains(wider[0], 2.75));
    CHECK(verified_singular_values(Mat6::Constant(std::nan("")), 0.0)[0].hi == std::numeric_limits<double>::infinity());
    CHECK(verified_singular_values(Mat6::Zero(), 0.0)[0].lo == 0.0);
    const auto equal = verified_singular_values(2.0 * Mat6::Identity(), 0.0);
    CHECK(contains(equal[0], 2.0));
    CHECK(contains(equal[5], 2.0));
  }

  TEST_CASE("the least singular value of a tall matrix") {
    Eigen::Matrix<double, 6, 3> m = Eigen::Matrix<double, 6, 3>::Zero();
    m(0, 0) = 2.0;
    m(4, 1) = 1.0;
    m(5, 2) = 0x1p-20;
    const double found = least_singular_value(m, 0.0);
    CHECK(found <= 0x1p-20);
    CHECK(found > 0.5 * 0x1p-20);
    CHECK(least_singular_value(m, 1e-3) == 0.0);
    m(5, 2) = 0.0;
    CHECK(least_singular_value(m, 0.0) == 0.0);
  }

  TEST_CASE("what is not a length is refused, and NaN says nothing") {
    const Configuration c = neutral(3.9828, 2.3745);
    CHECK_THROWS_AS(condition_number_bounds(published, c, 0.0), InvalidArgument);
    CHECK_THROWS_AS(jacobian_bounds(published, c, std::nan("")), InvalidArgument);
    const Configuration unknown{Vec3::Constant(std::nan("")), Mat3::Identity(), Vec3::Zero()};
    CHECK(condition_number_bounds(published, unknown).lo == 1.0);
    CHECK(condition_number_bounds(published, unknown).hi == std::numeric_limits<double>::infinity());
    CHECK(determinant_bounds(published, unknown).n.lo == -1.0);
  }
}
