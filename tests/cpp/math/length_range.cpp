/// length_range.hpp: what is refused.

#include "ninedof/math/length_range.hpp"

#include <doctest/doctest.h>

#include "support/support.hpp"

using namespace ninedof;
using namespace support;

TEST_SUITE("length_range") {
  TEST_CASE("lengths: its ends are inside, zero and what is beyond are not") {
    for (const double good : {least_length, 1.0, most_length}) CHECK_NOTHROW(require_length("x", good));
    for (const double bad : {0.0, -1.0, 0.5 * least_length, 2.0 * most_length, infinity, not_a_number})
      CHECK(refuses("x", [&] { require_length("x", bad); }));
  }

  TEST_CASE("coordinates: zero and the smallest are inside, either sign") {
    for (const double good : {0.0, -5e-324, 1e-200, -most_length}) CHECK_NOTHROW(require_coordinate("x", good));
    for (const double bad : {2.0 * most_length, -2.0 * most_length, infinity, not_a_number}) {
      CHECK(refuses("x", [&] { require_coordinate("x", bad); }));
      for (int axis = 0; axis < 3; ++axis) {
        Vec3 point = Vec3::Ones();
        point[axis] = bad;
        CHECK(refuses("x", [&] { require_coordinates("x", point); }));
      }
    }
  }
}
