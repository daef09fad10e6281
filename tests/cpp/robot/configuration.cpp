/// configuration.hpp: the neutral configuration as printed, the tangent by differences, round trips, invalid input.

#include "ninedof/robot/configuration.hpp"

#include <doctest/doctest.h>

#include "support/support.hpp"

using namespace ninedof;
using namespace support;

namespace {

Configuration random_configuration(Random& random) {
  return {random.matrix<Vec3>(), random.rotation(), random.matrix<Vec3>()};
}

/// omega of the given length, any dp and ds.
Vec9 random_tangent(Random& random, double angle) {
  Vec9 t = random.matrix<Vec9>();
  t.head<3>() = angle * random.unit();
  return t;
}

double distance(const Configuration& a, const Configuration& b) {
  return std::max({(a.position - b.position).norm(), (a.internal_point - b.internal_point).norm(),
                   (a.rotation - b.rotation).cwiseAbs().maxCoeff()});
}

}  // namespace

TEST_SUITE("configuration") {
  TEST_CASE("neutral is eq. (6), rotated about z") {
    const Configuration c = neutral(3.0, 1.0);
    CHECK(c.position == Vec3(0, 0, 3));
    CHECK(c.internal_point == Vec3(0, 0, 1));
    CHECK(c.rotation == Mat3::Identity());
    const Configuration turned = neutral(-2.0, 0.0, 0.7);
    CHECK((turned.rotation - Eigen::AngleAxisd(0.7, Vec3::UnitZ()).toRotationMatrix()).cwiseAbs().maxCoeff() <=
          2.0 * eps);
    CHECK(refuses("zp", [] { neutral(not_a_number, 1.0); }));
    CHECK(refuses("zs", [] { neutral(1.0, infinity); }));
    CHECK(refuses("theta_z", [] { neutral(1.0, 1.0, -infinity); }));
  }

  TEST_CASE("plus: omega rotates the platform in the base frame, dp moves it, ds moves O") {
    // Eigen's angle-axis on the left; no ninedof rotation is called.
    Random random(41);
    for (int n = 0; n < 300; ++n) {
      const Configuration c = random_configuration(random);
      const Vec9 t = random_tangent(random, random.log_uniform(1e-12, 7.0));
      const Configuration moved = plus(c, t);
      const Mat3 turn = Eigen::AngleAxisd(t.head<3>().norm(), t.head<3>().normalized()).toRotationMatrix();
      CHECK((moved.rotation - turn * c.rotation).cwiseAbs().maxCoeff() <= 16.0 * eps);
      CHECK(moved.position == c.position + t.segment<3>(3));
      CHECK(moved.internal_point == c.internal_point + t.tail<3>());
    }
    CHECK(distance(plus(neutral(2, 1, 0.4), Vec9::Zero()), neutral(2, 1, 0.4)) == 0.0);
  }

  TEST_CASE("minus undoes plus below a half turn: tiny, ordinary, almost half a turn") {
    Random random(42);
    for (const double angle : {0.0, 1e-100, 1e-12, 1e-6, 0.1, 1.0, 3.0, pi - 1e-6})
      for (int n = 0; n < 50; ++n) {
        CAPTURE(angle);
        const Configuration c = random_configuration(random);
        const Vec9 t = random_tangent(random, angle);
        const Vec9 back = minus(plus(c, t), c);
        CHECK((back - t).cwiseAbs().maxCoeff() <= 32.0 * eps);
      }
  }

  TEST_CASE("plus undoes minus for any two configurations, a half turn apart included") {
    Random random(43);
    for (int n = 0; n < 500; ++n) {
      const Configuration from = random_configuration(random);
      Configuration to = random_configuration(random);
      if (n % 3 == 0) {
        const Vec3 axis = random.unit();
        to.rotation = (2.0 * axis * axis.transpose() - Mat3::Identity()) * from.rotation;
      }
      const Vec9 t = minus(to, from);
      CHECK(t.head<3>().norm() <= pi * (1.0 + 2.0 * eps));
      CHECK(distance(plus(from, t), to) <= 32.0 * eps);
    }
  }

  TEST_CASE("validate names the invalid argument") {
    const Configuration good = neutral(2, 1);
    CHECK_NOTHROW(validate(good));
    for (Eigen::Index k = 0; k < 3; ++k)
      for (const double bad : {not_a_number, infinity}) {
        Configuration c = good;
        c.position[k] = bad;
        CHECK(refuses("position", [&] { validate(c); }));
        c = good;
        c.internal_point[k] = bad;
        CHECK(refuses("internal_point", [&] { validate(c); }));
        c = good;
        c.rotation(k, 0) = bad;
        CHECK(refuses("rotation", [&] { validate(c); }));
      }
    Configuration mirrored = good;
    mirrored.rotation(1, 1) = -1.0;
    CHECK(refuses("rotation", [&] { validate(mirrored); }));
  }
}
