/// geometry.hpp: the printed coordinates of eqs. (37)-(38), orbits by complex numbers, and every kind of invalid input.

#include "ninedof/robot/geometry.hpp"

#include <doctest/doctest.h>

#include <complex>
#include <functional>

#include "support/support.hpp"

using namespace ninedof;
using namespace support;

namespace {

const Triple good{Vec3(1.0, 0.1, 0.0), Vec3(-0.4, 0.9, 0.2), Vec3(-0.5, -0.8, -0.1)};

struct Place {
  std::string name;
  std::function<Geometry(const Triple&)> with;
};

/// A geometry with one of its triples given, for each of the four.
const std::vector<Place> places{
    {"base_external", [](const Triple& t) { return Geometry(t, good, good, good); }},
    {"base_internal", [](const Triple& t) { return Geometry(good, t, good, good); }},
    {"platform_external", [](const Triple& t) { return Geometry(good, good, t, good); }},
    {"platform_internal", [](const Triple& t) { return Geometry(good, good, good, t); }},
};

void check_joints(const Triple& joints, const std::array<std::array<double, 2>, 3>& expected) {
  for (std::size_t i = 0; i < 3; ++i) {
    CAPTURE(i);
    CHECK(joints[i].x() == doctest::Approx(expected[i][0]).epsilon(2.0 * eps));
    CHECK(joints[i].y() == doctest::Approx(expected[i][1]).epsilon(2.0 * eps));
    CHECK(joints[i].z() == 0.0);
  }
}

/// An orbit by its definition, with complex exponentials in place of rotation matrices.
void check_orbit(const Triple& joints, const Orbit& o) {
  for (std::size_t i = 0; i < 3; ++i) {
    const std::complex<double> at = std::polar(o.radius, o.angle - 2.0 * pi / 3.0 * static_cast<double>(i));
    CHECK((joints[i] - Vec3(at.real(), at.imag(), o.height)).norm() <= 8.0 * eps * o.radius);
  }
}

}  // namespace

TEST_SUITE("geometry") {
  TEST_CASE("the hexagons of eqs. (37)-(38), a1 = 1, a2 = 2, b1 = 3, b2 = 4, calculated by hand") {
    const Geometry g = Geometry::hexagonal(1.0, 2.0, 3.0, 4.0);
    check_joints(g.base_external(),
                 {{{0.5, -1.4433756729740645}, {-1.5, 0.28867513459481287}, {1.0, 1.1547005383792517}}});
    check_joints(g.base_internal(),
                 {{{-0.5, -1.4433756729740645}, {-1.0, 1.1547005383792517}, {1.5, 0.28867513459481287}}});
    check_joints(g.platform_external(),
                 {{{1.5, -3.1754264805429417}, {-3.5, 0.28867513459481287}, {2.0, 2.8867513459481287}}});
    check_joints(g.platform_internal(),
                 {{{-1.5, -3.1754264805429417}, {-2.0, 2.8867513459481287}, {3.5, 0.28867513459481287}}});
  }

  TEST_CASE("walking round a hexagon, sides a1 and a2 alternate and turn by 60 degrees") {
    Random random(31);
    for (int n = 0; n < 200; ++n) {
      const double a1 = n % 10 == 0 ? 0.0 : random.log_uniform(1e-3, 1e3), a2 = random.log_uniform(1e-3, 1e3);
      const Geometry g = Geometry::hexagonal(a1, a2, a2, a1);
      const Triple &r = g.base_external(), &rh = g.base_internal();
      const std::array<Vec3, 7> corners{rh[0], r[0], rh[2], r[2], rh[1], r[1], rh[0]};
      for (std::size_t k = 0; k < 6; ++k) {
        const double side = k % 2 == 0 ? a1 : a2, course = pi / 3.0 * static_cast<double>(k);
        const Vec3 expected(side * std::cos(course), side * std::sin(course), 0.0);
        CHECK((corners[k + 1] - corners[k] - expected).norm() <= 16.0 * eps * (a1 + a2));
      }
      CHECK((r[0] + r[1] + r[2]).norm() <= 16.0 * eps * (a1 + a2));
    }
  }

  TEST_CASE("symmetric(): radius, angle and height of each orbit, clockwise") {
    Random random(32);
    for (int n = 0; n < 200; ++n) {
      const Orbit a = random_orbit(random), b = random_orbit(random), c = random_orbit(random),
                  d = random_orbit(random);
      const Geometry g = Geometry::symmetric(a, b, c, d);
      check_orbit(g.base_external(), a);
      check_orbit(g.base_internal(), b);
      check_orbit(g.platform_external(), c);
      check_orbit(g.platform_internal(), d);
    }
  }

  TEST_CASE("joints are kept as given, bit for bit") {
    Random random(33);
    const Triple a = random_triple(random, 1.0), b = random_triple(random, 2.0), c = random_triple(random, 3.0);
    const Geometry g(a, b, c, good);
    CHECK(g.base_external() == a);
    CHECK(g.base_internal() == b);
    CHECK(g.platform_external() == c);
    CHECK(g.platform_internal() == good);
  }

  TEST_CASE("the test for a triangle does not depend on size and position") {
    for (const Place& place : places) {
      CAPTURE(place.name);
      for (const double scale : {1e-95, 1e-12, 1e-6, 1.0, 1e6, 1e12, 1e95}) {
        CAPTURE(scale);
        CHECK_NOTHROW(place.with(scaled(good, scale)));
        Triple far = scaled(good, scale);
        for (Vec3& joint : far) joint += 1e3 * scale * Vec3(1, -2, 3);
        CHECK_NOTHROW(place.with(far));
        // Collinear joints at any scale and in any direction: external ones are no reason to refuse.
        const Vec3 from = scale * Vec3(0.3, -0.7, 0.2), along = scale * Vec3(1, 2, -1);
        CHECK(refuses(place.name, [&] { place.with({from, from, from}); }));
        for (const Triple& flat : {Triple{from, from + along, from + 2.5 * along}, Triple{from, from + along, from}}) {
          if (place.name.ends_with("internal")) CHECK(refuses(place.name, [&] { place.with(flat); }));
          else CHECK_NOTHROW(place.with(flat));
        }
      }
      CHECK(refuses(place.name, [&] { place.with({Vec3::Zero(), Vec3::Zero(), Vec3::Zero()}); }));
    }
  }

  TEST_CASE("collinear is a height below 1e-9 of the longest side, whichever joint is out of line") {
    for (const Place& place : {places[1], places[3]})
      for (std::size_t turn = 0; turn < 3; ++turn) {
        const auto flat = [&](double height) {
          Triple t{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0.4, height, 0)};
          std::rotate(t.begin(), t.begin() + static_cast<std::ptrdiff_t>(turn), t.end());
          return place.with(t);
        };
        CHECK_NOTHROW(flat(2e-9));
        CHECK(refuses(place.name, [&] { flat(0.5e-9); }));
        CHECK(message_of([&] { flat(0.5e-9); }).find("collinear") != std::string::npos);
      }
  }

  TEST_CASE("two external legs coincide if both of their ends do, to 1e-9 of the longest sides") {
    for (std::size_t i = 0; i < 3; ++i)
      for (const double scale : {1e-6, 1.0, 1e6}) {
        const auto with = [&](double base_apart, double platform_apart) {
          Triple base = scaled(good, scale), platform = good;
          base[(i + 1) % 3] = base[i] + Vec3(0, 0, base_apart * scale);
          platform[(i + 1) % 3] = platform[i] + Vec3(0, platform_apart, 0);
          return Geometry(base, good, platform, good);
        };
        CHECK_NOTHROW(with(0.0, 1e-8));
        CHECK_NOTHROW(with(1e-8, 0.0));
        CHECK(refuses("base_external, platform_external", [&] { with(0.0, 0.0); }));
        CHECK(refuses("base_external, platform_external", [&] { with(1e-10, 1e-10); }));
      }
  }

  TEST_CASE("a coordinate that is not finite is rejected by triple and joint") {
    for (const Place& place : places)
      for (std::size_t joint = 0; joint < 3; ++joint)
        for (Eigen::Index axis = 0; axis < 3; ++axis)
          for (const double bad : {not_a_number, infinity, -infinity}) {
            Triple t = good;
            t[joint][axis] = bad;
            CHECK(refuses(place.name, [&] { place.with(t); }));
            CHECK(message_of([&] { place.with(t); }).find("joint " + std::to_string(joint + 1)) != std::string::npos);
          }
  }

  TEST_CASE("invalid sides of hexagons are rejected by name") {
    for (const double bad : {-1.0, -1e-300, not_a_number, infinity, -infinity}) {
      CAPTURE(bad);
      CHECK(refuses("a1", [&] { Geometry::hexagonal(bad, 1, 1, 1); }));
      CHECK(refuses("a2", [&] { Geometry::hexagonal(1, bad, 1, 1); }));
      CHECK(refuses("b1", [&] { Geometry::hexagonal(1, 1, bad, 1); }));
      CHECK(refuses("b2", [&] { Geometry::hexagonal(1, 1, 1, bad); }));
    }
    CHECK(refuses("a1, a2", [] { Geometry::hexagonal(0, 0, 1, 1); }));
    CHECK(refuses("b1, b2", [] { Geometry::hexagonal(1, 1, 0, -0.0); }));
    CHECK_NOTHROW(Geometry::hexagonal(0, 1, 1, 0));
    CHECK_NOTHROW(Geometry::hexagonal(1e-12, 0, 0, 1e12));
  }

  TEST_CASE("invalid orbits are rejected by name and field") {
    const Orbit o{1.0, 0.3, 0.1};
    for (const double bad : {0.0, -1.0, not_a_number, infinity}) {
      CHECK(refuses("base_external.radius", [&] { Geometry::symmetric({bad, 0, 0}, o, o, o); }));
      CHECK(refuses("platform_internal.radius", [&] { Geometry::symmetric(o, o, o, {bad, 0, 0}); }));
    }
    CHECK(refuses("base_internal.angle", [&] { Geometry::symmetric(o, {1, not_a_number, 0}, o, o); }));
    CHECK(refuses("platform_external.height", [&] { Geometry::symmetric(o, o, {1, 0, infinity}, o); }));
  }
}
