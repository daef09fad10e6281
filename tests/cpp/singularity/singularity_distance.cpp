/// distance_to_singularity against signs of the margins sampled along the path, against paths that can be solved by
/// hand, and against paths built to touch a singularity without crossing it.

#include <doctest/doctest.h>

#include "ninedof/singularity/singularity.hpp"
#include "support/support.hpp"

using namespace ninedof;
using namespace support;

namespace {

Vec9 direction(const Vec3& omega, const Vec3& pdot, const Vec3& sdot) {
  Vec9 out;
  out << omega, pdot, sdot;
  return out;
}

Vec9 random_direction(Random& random, int kind) {
  Vec9 out = random.matrix<Vec9>();
  if (kind == 1) out.tail<6>().setZero();  // a pure rotation
  if (kind == 2) out.head<3>().setZero();  // pure translations
  return out;
}

double of(const PerMechanism& x, int k) {
  return k == 0 ? x.n : k == 1 ? x.b : x.c;
}

}  // namespace

TEST_SUITE("singularity_distance") {
  TEST_CASE("no margin changes sign before the distance, and the one named does there") {
    Random random(421);
    int crossings = 0;
    for (int n = 0; n < 300; ++n) {
      const auto [g, c] = random_robot(random);
      const Vec9 along = random_direction(random, n % 3);
      const SingularityDistance found = distance_to_singularity(g, c, along, 3.0);
      CHECK(found.resolved);
      CHECK(found.distance == std::min({found.each.n, found.each.b, found.each.c}));
      const PerMechanism start = singularity_margins(g, c);
      for (int k = 0; k < 3; ++k) {
        const double at = of(found.each, k), end = std::min(at, 3.0), sign = of(start, k);
        for (int i = 0; i < 200; ++i) {
          const double t = end * (1.0 - 1e-9) * i / 199.0;
          CHECK(of(singularity_margins(g, plus(c, t * along)), k) * sign > 0.0);
        }
        if (at == infinity) continue;
        ++crossings;
        CHECK(std::abs(of(singularity_margins(g, plus(c, at * along)), k)) <= 1e-12);
        CHECK(of(singularity_margins(g, plus(c, (at + 1e-7) * along)), k) * sign < 0.0);
      }
    }
    CHECK(crossings > 300);
  }

  TEST_CASE("straight moves of O: distances to the two planes, to rounding") {
    const Geometry g = Geometry::hexagonal(0.4, 3.0, 2.0, 0.3);
    const Configuration c{Vec3(0.1, 0.2, 2.0), Mat3::Identity(), Vec3(0.3, -0.2, 1.25)};
    const Vec3 none = Vec3::Zero();
    SingularityDistance found = distance_to_singularity(g, c, direction(none, none, Vec3(0.2, 0.1, -0.5)), 10.0);
    CHECK(found.each.b == doctest::Approx(2.5).epsilon(1e-15));
    CHECK(found.each.c == infinity);
    found = distance_to_singularity(g, c, direction(none, Vec3(0.0, 0.3, -0.5), Vec3(0.2, 0.0, 0.25)), 10.0);
    CHECK(found.each.c == doctest::Approx(1.0).epsilon(1e-15));
    CHECK(found.each.b == infinity);
    // The end of the path belongs to it.
    CHECK(distance_to_singularity(g, c, direction(none, none, Vec3(0, 0, -1.25))).each.b == 1.0);
    CHECK(distance_to_singularity(g, c, direction(none, none, Vec3(0, 0, -1.25 * (1 - 1e-13)))).each.b == infinity);
  }

  TEST_CASE("a turn that brings the platform's plane to O: crossed, touched or just missed") {
    Random random(422);
    for (int n = 0; n < 200; ++n) {
      const Vec3 y = random.matrix<Vec3>(), axis = random.unit();
      // Height of O over the plane, a + b cos t + c sin t - plane, greatest at t = top.
      const double a = axis.z() * axis.dot(y), b = y.z() - a, c = axis.cross(Vec3::UnitZ()).dot(y);
      const double radius = std::hypot(b, c), top = std::atan2(c, b);
      if (radius < 0.2 || top < 0.2) continue;
      for (const double gap : {-1e-2, -1e-5, -1e-9, 0.0, 1e-12, 1e-9, 1e-5}) {
        const double plane = a + radius + gap;
        const Robot r = random_robot(random);
        Triple upper = r.geometry.platform_internal();
        for (Vec3& joint : upper) joint.z() = plane;
        const Geometry g(r.geometry.base_external(), r.geometry.base_internal(), r.geometry.platform_external(), upper);
        const Configuration pose{r.configuration.internal_point - y, Mat3::Identity(), r.configuration.internal_point};
        const double at = distance_to_singularity(g, pose, direction(axis, Vec3::Zero(), Vec3::Zero()), 6.0).each.c;
        CAPTURE(gap);
        const double before = std::acos(std::max(-1.0, 1.0 + gap / radius));
        if (gap > 0.0) {
          CHECK(at == infinity);
        } else if (gap == 0.0) {
          CHECK(std::abs(at - top) <= 1e-6);
        } else if (before < top) {
          CHECK(std::abs(at - (top - before)) <= 1e-13 / std::sqrt(-gap));
        }
      }
    }
  }

  TEST_CASE("two legs that point at O at the same moment: det N touches zero and turns back") {
    Random random(423);
    int touched = 0;
    for (int n = 0; n < 100; ++n) {
      const Robot r = random_robot(random);
      const Configuration& then = r.configuration;
      Triple base = r.geometry.base_external();
      for (std::size_t i = 0; i < 2; ++i) {
        const Vec3 head = then.position + then.rotation * r.geometry.platform_external()[i];
        base[i] = then.internal_point + random.uniform(-2.0, -0.5) * (head - then.internal_point);
      }
      const Geometry g(base, r.geometry.base_internal(), r.geometry.platform_external(),
                       r.geometry.platform_internal());
      const Vec9 along = random_direction(random, n % 3);
      const double before = random.uniform(0.01, 0.3);
      const Configuration c = plus(then, -before * along);
      const PerMechanism start = singularity_margins(g, c), after = singularity_margins(g, plus(then, 0.01 * along));
      const double at = distance_to_singularity(g, c, along).each.n;
      CHECK(at <= before + 1e-6);
      if (at < before - 1e-6) continue;  // another zero came first
      ++touched;
      CHECK(start.n * after.n > 0.0);
    }
    CHECK(touched > 50);
  }

  TEST_CASE("singular at the start: 0, whatever the direction") {
    const Geometry g = Geometry::hexagonal(0.4, 3.0, 2.0, 0.3), similar = Geometry::hexagonal(1.0, 3.0, 0.5, 1.5);
    Random random(424);
    for (const Vec9& along : {Vec9(Vec9::Zero()), random_direction(random, 0), random_direction(random, 1)}) {
      const SingularityDistance b = distance_to_singularity(g, neutral(2.0, 0.0), along);
      CHECK((b.distance == 0.0 && b.mechanism == Mechanism::b));
      const SingularityDistance c = distance_to_singularity(g, neutral(2.0, 2.0), along);
      CHECK((c.distance == 0.0 && c.mechanism == Mechanism::c));
      const SingularityDistance m = distance_to_singularity(similar, neutral(2.0, 0.7), along);
      CHECK((m.distance == 0.0 && m.mechanism == Mechanism::n));
    }
    const SingularityDistance still = distance_to_singularity(g, neutral(2.0, 1.0), Vec9::Zero());
    CHECK((still.distance == infinity && still.mechanism == Mechanism::none && still.resolved));
  }

  TEST_CASE("a margin that stays next to zero all along the way is followed and found free") {
    for (const double off : {1e-4, 1e-7, 1e-10}) {
      const Geometry g = Geometry::hexagonal(1.0, 3.0, 0.5, 1.5 * (1.0 + off));
      const Vec9 along = direction(Vec3::Zero(), Vec3(0, 0, 0.5), Vec3(0, 0, 0.2));
      const SingularityDistance found = distance_to_singularity(g, neutral(2.0, 0.7), along);
      CHECK((found.resolved && found.distance == infinity));
    }
  }

  TEST_CASE("paths too long to settle say how far they are free") {
    Random random(425);
    int free = 0;
    for (int n = 0; n < 5000 && free < 2; ++n) {
      const auto [g, c] = random_robot(random);
      const Vec9 turn = random_direction(random, 1).normalized();
      if (distance_to_singularity(g, c, turn, 7.0).distance < infinity) continue;
      ++free;
      const SingularityDistance found = distance_to_singularity(g, c, turn, 1e7);
      CHECK(!found.resolved);
      CHECK((found.distance > 1000.0 && found.distance < 1e7));
      CHECK(found.mechanism != Mechanism::none);
    }
    CHECK(free == 2);
  }

  TEST_CASE("length unit: the same bits for powers of two; huge and tiny robots") {
    Random random(426);
    for (int n = 0; n < 30; ++n) {
      const Robot r = random_robot(random);
      const Vec9 along = random_direction(random, n % 3);
      const SingularityDistance one = distance_to_singularity(r.geometry, r.configuration, along, 3.0);
      for (const double factor : {0x1p-20, 0x1p40, 1e-6, 1e6}) {
        const Robot other = scaled(r, factor);
        Vec9 far = along;
        far.tail<6>() *= factor;
        const SingularityDistance found = distance_to_singularity(other.geometry, other.configuration, far, 3.0);
        CHECK(found.mechanism == one.mechanism);
        if (factor == 0x1p-20 || factor == 0x1p40) CHECK(found.distance == one.distance);
        else if (one.distance < infinity) CHECK(relative_error(found.distance, one.distance) <= 1e-9);
      }
    }
  }

  TEST_CASE("NaN in, NaN out; bad arguments by name") {
    const Geometry g = Geometry::hexagonal(0, 3, 2, 0);
    Configuration c = neutral(2, 1);
    Vec9 along = Vec9::Ones();
    for (const double bad : {0.0, -1.0, infinity, not_a_number})
      CHECK(refuses("most", [&] { distance_to_singularity(g, c, along, bad); }));
    along[4] = -infinity;
    CHECK(refuses("direction", [&] { distance_to_singularity(g, c, along); }));
    along[4] = not_a_number;
    CHECK(std::isnan(distance_to_singularity(g, c, along).distance));
    c.internal_point.x() = not_a_number;
    const SingularityDistance found = distance_to_singularity(g, c, Vec9::Ones());
    CHECK((std::isnan(found.distance) && std::isnan(found.each.c) && !found.resolved));
    CHECK(found.mechanism == Mechanism::none);
  }
}
