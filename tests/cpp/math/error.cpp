/// error.hpp: messages, numbers in messages, status words.

#include "ninedof/math/error.hpp"

#include <doctest/doctest.h>

#include <cstdlib>
#include <limits>

#include "support/support.hpp"

using namespace ninedof;
using namespace support;

TEST_SUITE("error") {
  TEST_CASE("a message names the argument, the value received and the value expected") {
    CHECK(std::string(InvalidArgument("zp", "-1", "a finite number > 0").what()) ==
          "zp: got -1, expected a finite number > 0");
    CHECK_THROWS_AS(require_positive("x", 0.0), std::invalid_argument);
  }

  TEST_CASE("require_positive and require_finite") {
    for (const double bad : {not_a_number, infinity, -infinity}) {
      CHECK(refuses("x", [&] { require_positive("x", bad); }));
      CHECK(refuses("x", [&] { require_finite("x", bad); }));
    }
    for (const double bad : {0.0, -0.0, -1e-300}) {
      CHECK(refuses("x", [&] { require_positive("x", bad); }));
      CHECK_NOTHROW(require_finite("x", bad));
    }
    CHECK_NOTHROW(require_positive("x", 5e-324));
    CHECK_NOTHROW(require_positive("x", std::numeric_limits<double>::max()));
  }

  TEST_CASE("format_number: the shortest text that reads back as the same number") {
    CHECK(format_number(0.1) == "0.1");
    CHECK(format_number(-2.0) == "-2");
    CHECK(format_number(1e300) == "1e+300");
    CHECK(format_number(infinity) == "inf");
    CHECK(format_number(not_a_number) == "nan");
    Random random(141);
    for (int n = 0; n < 1000; ++n) {
      const double x = random.sign() * random.log_uniform(1e-300, 1e300);
      CHECK(std::strtod(format_number(x).c_str(), nullptr) == x);
    }
    for (const double x : {5e-324, -std::numeric_limits<double>::denorm_min(), std::numeric_limits<double>::lowest()})
      CHECK(std::strtod(format_number(x).c_str(), nullptr) == x);
  }
}
