/// architecture_singularity.hpp: distances of triangles known by hand, moves along them, and similar triangles at
/// random.

#include "ninedof/robot/architecture_singularity.hpp"

#include <doctest/doctest.h>

#include "ninedof/singularity/singularity.hpp"
#include "support/support.hpp"

using namespace ninedof;
using namespace support;

namespace {

constexpr double longest = 40.0;
const Triple wide{Vec3(0, 0, 0), Vec3(longest, 0, 0), Vec3(10, 20, 5)};

void check_nearest(const Geometry& g, ArchitectureClass kind, double distance) {
  const ArchitectureSingularity nearest = nearest_architecture_singularity(g);
  CHECK(nearest.kind == kind);
  CHECK(nearest.distance == doctest::Approx(distance).epsilon(4.0 * eps));
  CHECK(nearest.relative == doctest::Approx(distance / longest).epsilon(4.0 * eps));
}

}  // namespace

TEST_SUITE("architecture_singularity") {
  TEST_CASE("half a height, the radius of a least circle, half of what legs are apart") {
    using enum ArchitectureClass;
    const Triple flat{Vec3(0, 0, 1), Vec3(8, 0, 1), Vec3(3, 0.5, 1)};
    check_nearest({wide, flat, wide, wide}, lower_on_line, 0.25);
    check_nearest({wide, wide, wide, flat}, upper_on_line, 0.25);
    const Triple right{Vec3(0, 0, 0), Vec3(3, 0, 0), Vec3(0, 4, 0)},
        obtuse{Vec3(0, 0, 0), Vec3(6, 0, 0), Vec3(2, 1, 0)};
    const double side = 1.5;
    const Triple equal{Vec3(0, 0, 0), Vec3(side, 0, 0), Vec3(side / 2, 0, side * std::sqrt(0.75))};
    check_nearest({right, wide, wide, wide}, base_in_point, 2.5);
    check_nearest({wide, wide, obtuse, wide}, platform_in_point, 3.0);
    check_nearest({wide, wide, equal, wide}, platform_in_point, side / std::sqrt(3.0));
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t k = (i + 1) % 3;
      Triple r = wide, u = wide;
      r[k] = r[i] + Vec3(0, 0, 0.5);
      u[k] = u[i] + Vec3(0.6, 0, 0);
      const ArchitectureSingularity nearest = nearest_architecture_singularity({r, wide, u, wide});
      CHECK(nearest.kind == legs_coincide);
      CHECK(nearest.distance == doctest::Approx(0.3));
      CHECK(nearest.leg == static_cast<int>(std::min(i, k)));
      CHECK(nearest.other == static_cast<int>(std::max(i, k)));
    }
  }

  TEST_CASE("similar triangles of any scale: parallel at two orientations, where det N is 0 at all positions") {
    Random random(71);
    for (int n = 0; n < cases(200); ++n) {
      const Triple r = random_triple(random, random.log_uniform(1e-6, 1e6));
      const Mat3 turn = random.rotation() * random.sign() * random.log_uniform(1e-100, 1e60);
      const Triple u{turn * r[0], turn * r[1], turn * r[2]};
      const Geometry g(r, random_triple(random, 1.0), u, random_triple(random, 1.0));
      const SimilarTriangles similar = similar_triangles(g);
      CHECK(similar.dissimilarity <= 64.0 * eps);
      for (const Mat3& rotation : similar.rotations) {
        CHECK((rotation * rotation.transpose() - Mat3::Identity()).norm() <= 64.0 * eps);
        CHECK(rotation.determinant() == doctest::Approx(1.0));
        CHECK(homothety_residual(g, rotation) <= 64.0 * eps);
      }
    }
    const Triple r = random_triple(random, 3.0), u = scaled(r, -0.4);
    const Geometry g(r, random_triple(random, 1.0), u, random_triple(random, 1.0));
    for (const Mat3& rotation : similar_triangles(g).rotations)
      for (int n = 0; n < 50; ++n) {
        const Configuration c{random.matrix<Vec3>(), rotation, random.matrix<Vec3>()};
        CHECK(std::abs(singularity_margins(g, c).n) <= 1e-12);
      }
  }

  TEST_CASE("hexagons are parallel at the yaw between their first joints, and at no other") {
    const Geometry alike = Geometry::hexagonal(1.0, 2.0, 0.5, 1.0), coupled = Geometry::hexagonal(0.0, 2.0, 1.0, 0.0);
    CHECK(homothety_residual(alike, Mat3::Identity()) <= 4.0 * eps);
    CHECK(homothety_residual(coupled, Mat3::Identity()) == doctest::Approx(std::sin(pi / 3.0)));
  }
}
