/// What a certified workspace proves of positions, against the boxes and planes that it was made of by hand. The Python
/// tests compare proofs with the machine.

#include "ninedof/workspace/certified.hpp"

#include "ninedof/proof/checker.hpp"
#include "support/support.hpp"

using namespace support;
using namespace ninedof;

namespace {

constexpr int cells_a_side = 12;

/// Boxes of [0, 12)^3, each inner, outer or open at random; an open one is cut by two planes.
struct Cubes {
  CertifiedWorkspace found;
  std::vector<int> kind;  // 0 outer, 1 inner, 2 open
  std::vector<std::size_t> open;  // the number of an open box

  Cubes() {
    Random random(1);
    found.beyond = CertifiedWorkspace::Beyond::unknown;
    found.box_low = Vec3::Constant(-1.0);
    found.box_high = Vec3::Constant(cells_a_side + 1.0);
    for (int n = 0; n < cells_a_side * cells_a_side * cells_a_side; ++n) {
      const Vec3 low(n % cells_a_side, n / cells_a_side % cells_a_side, n / (cells_a_side * cells_a_side)),
          high = low + Vec3::Ones();
      kind.push_back(static_cast<int>(random.uniform(0.0, 3.0)));
      open.push_back(found.open_low.size());
      if (kind.back() == 1) {
        found.inner_low.push_back(low);
        found.inner_high.push_back(high);
      } else if (kind.back() == 2) {
        found.open_low.push_back(low);
        found.open_high.push_back(high);
        found.first_cut.push_back(std::ssize(found.cuts));
        for (int k = 0; k < 2; ++k) {
          const double middle = random.uniform(-0.5, 0.5);
          found.cuts.push_back({random.unit(), middle + 0.2, middle - 0.2});
        }
      }
    }
    found.first_cut.push_back(std::ssize(found.cuts));
  }

  int expected(const Vec3& x) const {
    const Vec3 cell = x.array().floor();
    const auto n = at_index(static_cast<int>(cell.x() + cells_a_side * (cell.y() + cells_a_side * cell.z())));
    if (kind[n] != 2) return kind[n] == 1 ? 1 : -1;
    const Vec3 t = 2.0 * (x - cell) - Vec3::Ones();
    bool allowed = true, forbidden = false;
    for (std::size_t k = 2 * open[n]; k < 2 * open[n] + 2; ++k) {
      allowed = allowed && found.cuts[k].slope.dot(t) > found.cuts[k].allowed;
      forbidden = forbidden || found.cuts[k].slope.dot(t) < found.cuts[k].forbidden;
    }
    return allowed ? 1 : forbidden ? -1 : 0;
  }
};

}  // namespace

TEST_SUITE("certified") {
  TEST_CASE("points have the state of the box and of the planes around them") {
    const Cubes cubes;
    Random random(2);
    std::vector<Vec3> points;
    for (int n = 0; n < 5000; ++n)
      points.push_back(
          {random.uniform(0.0, cells_a_side), random.uniform(0.0, cells_a_side), random.uniform(0.0, cells_a_side)});
    const std::vector<std::int8_t> states = proved_states(cubes.found, points);
    REQUIRE(states.size() == points.size());
    std::array<int, 3> seen{};
    for (std::size_t n = 0; n < points.size(); ++n) {
      CHECK(states[n] == cubes.expected(points[n]));
      ++seen[at_index(states[n] + 1)];
    }
    for (const int times : seen) CHECK(times > 100);
  }

  TEST_CASE("a point on a face of an inner box is inside, whichever side the box is on") {
    const Cubes cubes;
    std::vector<Vec3> points;
    for (std::size_t n = 0; n < cubes.found.inner_low.size(); ++n) {
      const Vec3 middle = cubes.found.inner_low[n] + Vec3::Constant(0.37);
      for (int axis = 0; axis < 3; ++axis)
        for (const Vec3& end : {cubes.found.inner_low[n], cubes.found.inner_high[n]}) {
          points.push_back(middle);
          points.back()[axis] = end[axis];
        }
    }
    for (const std::int8_t state : proved_states(cubes.found, points)) CHECK(state == 1);
  }

  TEST_CASE("a point on a face of two open boxes has what either proves") {
    CertifiedWorkspace found;
    found.open_low = {Vec3::Zero(), Vec3::UnitX()};
    found.open_high = {Vec3::Ones(), Vec3::Ones() + Vec3::UnitX()};
    found.first_cut = {0, 1, 2};
    found.cuts = {{Vec3::UnitZ(), 0.9, -0.9}, {Vec3::UnitZ(), 0.1, -0.1}};
    CHECK(proved_states(found, {Vec3(1.0, 0.5, 0.7), Vec3(1.0, 0.5, 0.3), Vec3(1.0, 0.5, 0.5)}) ==
          std::vector<std::int8_t>{1, -1, 0});
    std::swap(found.cuts[0], found.cuts[1]);
    CHECK(proved_states(found, {Vec3(1.0, 0.5, 0.7), Vec3(1.0, 0.5, 0.3), Vec3(1.0, 0.5, 0.5)}) ==
          std::vector<std::int8_t>{1, -1, 0});
  }

  TEST_CASE("outside all boxes nothing is allowed, and outside the box asked for nothing may be known") {
    Cubes cubes;
    const std::vector<Vec3> points{Vec3::Constant(-0.5), Vec3::Constant(-1.5)};
    CHECK(proved_states(cubes.found, points) == std::vector<std::int8_t>{-1, 0});
    cubes.found.beyond = CertifiedWorkspace::Beyond::nothing;
    CHECK(proved_states(cubes.found, points) == std::vector<std::int8_t>{-1, -1});
  }

  TEST_CASE("rounding counts against both proofs, and a box without planes proves nothing") {
    CertifiedWorkspace found;
    found.open_low = {Vec3::Constant(1e6), Vec3::Zero()};
    found.open_high = {Vec3::Constant(1e6 + 1e-3), Vec3::Ones()};
    found.first_cut = {0, 1, 1};
    found.cuts = {{Vec3::UnitX(), 0.0, 0.0}};
    const double middle = 1e6 + 0.5e-3;
    const auto at = [&](double x) { return Vec3(x, middle, middle); };
    CHECK(proved_states(found, {at(middle), at(middle + 1e-5), at(middle - 1e-5), Vec3::Constant(0.5)}) ==
          std::vector<std::int8_t>{0, 1, -1, 0});
  }

  TEST_CASE("the checker replays a proof, and no file is written of another question") {
    const Geometry g = Geometry::hexagonal(0.0, 5.8124, 2.9062, 0.0);
    WorkspaceDomain domain;
    domain.low = Vec3::Constant(-9.0);
    domain.high = Vec3::Constant(9.0);
    WorkspaceCriteria criteria;
    criteria.legs = LegLimits{Vec9::Constant(2.5), Vec9::Constant(6.5)};
    CertifySettings settings;
    settings.gap = 0.4;
    CertifiedWorkspace found = certified_workspace(g, domain, {}, criteria, settings);
    const checker::Verdict verdict = checker::check(workspace_certificate(g, domain, {}, criteria, found));
    CHECK_MESSAGE(verdict.proved, verdict.words);
    CHECK(verdict.leaves > static_cast<long>(found.inner_low.size() + found.open_low.size()));
    found.high *= 1.1;
    CHECK_THROWS_AS(workspace_certificate(g, domain, {}, criteria, found), InvalidArgument);
  }

  TEST_CASE("a stop ends the work") {
    std::stop_source source;
    source.request_stop();
    CHECK_THROWS_AS(proved_states(Cubes().found, {Vec3::Ones()}, source.get_token()), Stopped);
  }
}
