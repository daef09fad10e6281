/// nearest_singularity against the distance of O to the planes of the internal joints, and against random directions.

#include <doctest/doctest.h>

#include "ninedof/singularity/singularity.hpp"
#include "support/support.hpp"

using namespace ninedof;
using namespace support;

namespace {

/// Motions of one part: 0 turns, 3 shifts of the platform, 6 of O.
Motions motions_of(int first) {
  Motions out = Motions::Zero();
  out.middleRows<3>(first).setIdentity();
  return out;
}

}  // namespace

TEST_SUITE("nearest_singularity") {
  TEST_CASE("O alone, near the plane of the lower joints: the distance to it, along its normal") {
    const Geometry g = Geometry::hexagonal(0.3, 5.0, 2.5, 0.2);
    const NearestSingularity found = nearest_singularity(g, {neutral(4.0, 0.1)}, motions_of(6), 8.0);
    CHECK(found.mechanism == Mechanism::b);
    CHECK(relative_error(found.distance, 0.1) <= 1e-12);
    CHECK(std::abs(found.direction.z() + 1.0) <= 1e-12);
    CHECK(found.resolved);
  }

  TEST_CASE("no random direction is nearer; of several poses the nearest; the same for any number of threads") {
    Random random(431);
    for (int n = 0; n < cases(24); ++n) {
      const auto [g, c] = random_robot(random);
      const std::vector<Configuration> poses{c, c, plus(c, 0.1 * random.matrix<Vec9>())};
      const Motions motions = motions_of(3 * (n % 3));
      const double most = n % 3 == 0 ? pi : 20.0;
      const NearestSingularity found = nearest_singularity(g, poses, motions, most, 300, 1);
      for (const Configuration& pose : poses)
        for (int k = 0; k < 300; ++k) {
          const Vec9 along = motions * random.unit();
          CHECK(distance_to_singularity(g, pose, along, most).distance >= found.distance * (1.0 - 1e-9));
        }
      CHECK(found.pose != 1);
      const NearestSingularity again = nearest_singularity(g, poses, motions, most, 300, 3);
      CHECK((again.distance == found.distance && again.direction == found.direction && again.pose == found.pose));
    }
  }

  TEST_CASE("nothing up to `most`, a singular pose, and bad arguments") {
    const Geometry g = Geometry::hexagonal(0.3, 5.0, 2.5, 0.2);
    CHECK(nearest_singularity(g, {neutral(4.0, 2.0)}, motions_of(3), 1e-3).distance == infinity);
    CHECK(nearest_singularity(g, {neutral(4.0, 0.0)}, motions_of(3), 1.0).distance == 0.0);
    CHECK(refuses("poses", [&] { nearest_singularity(g, {}, motions_of(3), 1.0); }));
    CHECK(refuses("most", [&] { nearest_singularity(g, {neutral(4.0, 2.0)}, motions_of(3), -1.0); }));
  }

  TEST_CASE("three ways of moving: each as its own search, O held or with the platform in a shift") {
    Random random(433);
    const auto [g, c] = random_robot(random);
    for (const bool held : {true, false}) {
      const NearestSingularities found = nearest_singularities(g, {c, plus(c, 0.1 * random.matrix<Vec9>())}, held);
      const SingularMotions motions = singular_motions(held);
      CHECK(motions.turn == motions_of(0));
      CHECK(motions.shift == (held ? motions_of(3) : Motions(motions_of(3) + motions_of(6))));
      CHECK(found.turn.distance <= nearest_singularity(g, {c}, motions.turn, pi).distance * (1.0 + 1e-9));
      for (int k = 0; k < cases(300); ++k) {
        CHECK(distance_to_singularity(g, c, motions.shift * random.unit(), 40.0).distance >=
              found.shift.distance * (1.0 - 1e-9));
        CHECK(distance_to_singularity(g, c, motions.internal * random.unit(), 40.0).distance >=
              found.internal.distance * (1.0 - 1e-9));
      }
    }
  }
}
