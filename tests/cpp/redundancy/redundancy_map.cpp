/// Continuation from neighbouring poses, and maps: compared with searches of single poses. The Python tests have
/// symmetry, a search over all O, and the audit.

#include "ninedof/redundancy/redundancy_map.hpp"

#include <doctest/doctest.h>

#include <bit>
#include <stop_token>

#include "ninedof/conditioning/conditioning.hpp"
#include "ninedof/robot/legs.hpp"
#include "redundancy/map/continuation.hpp"
#include "redundancy/map/lattice.hpp"
#include "support/support.hpp"

using namespace support;
using ninedof::best_internal_map;
using ninedof::best_internal_point;
using ninedof::Control;
using ninedof::Criterion;
using ninedof::InternalPoint;
using ninedof::InternalPointMap;
using ninedof::InternalPointProblem;
using ninedof::InternalPointStatus;
using ninedof::MapSettings;
using ninedof::PlatformPose;

namespace {

const Vec3 home(0.0, 0.0, 3.98);

InternalPointProblem with_limits(double low, double high) {
  InternalPointProblem problem;
  problem.limits.low.setConstant(low);
  problem.limits.high.setConstant(high);
  problem.limits.high.head<3>().setConstant(9.0);
  return problem;
}

std::vector<PlatformPose> plane(std::size_t n) {
  std::vector<PlatformPose> poses;
  const double step = 3.0 / static_cast<double>(n - 1);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j)
      poses.push_back(
          {Vec3(step * static_cast<double>(i) - 1.5, step * static_cast<double>(j) - 1.5, 3.98), Mat3::Identity()});
  return poses;
}

/// The optimum reached from one guess.
InternalPoint continued(const Geometry& g, const Vec3& p, const Mat3& q, const InternalPointProblem& problem,
                        const Vec3& start) {
  const ninedof::PoseResult before = ninedof::checked_pose(g, p, q, problem);
  if (before.point.status != InternalPointStatus::singular) return before.point;
  const std::vector<ninedof::Guess> guess{{start, 0.0}};
  return ninedof::continued_from(g, {p, q}, problem, start, guess, before).best.point;
}

bool same_bits(const InternalPoint& a, const InternalPoint& b) {
  const auto bits = [](double x) { return std::bit_cast<std::uint64_t>(x); };
  bool same = bits(a.value) == bits(b.value) && a.status == b.status && a.active.bits() == b.active.bits();
  for (Eigen::Index k = 0; k < 3; ++k) same = same && bits(a.s[k]) == bits(b.s[k]);
  return same;
}

}  // namespace

TEST_SUITE("redundancy_map") {
  TEST_CASE("continuation from a neighbouring pose finds the optimum of a search") {
    Random random(1);
    int compared = 0;
    for (int n = 0; n < cases(60); ++n) {
      const Vec3 p = home + random.unit();
      const Mat3 q = random.rotation(0.3);
      const Vec3 moved = p + random.log_uniform(1e-4, 5e-2) * random.unit();
      for (const Criterion criterion : {Criterion::condition_number, Criterion::singularity, Criterion::leg_centring}) {
        InternalPointProblem problem = with_limits(1.5, 5.0);
        problem.criterion = criterion;
        problem.clearance = 1e-3;
        const InternalPoint there = best_internal_point(published, p, q, problem);
        const InternalPoint searched = best_internal_point(published, moved, q, problem);
        if (there.status != InternalPointStatus::found || searched.status != InternalPointStatus::found) continue;
        if ((there.s - searched.s).norm() > 0.3) continue;  // another local optimum
        const InternalPoint near = continued(published, moved, q, problem, there.s);
        REQUIRE(near.status == InternalPointStatus::found);
        CHECK(relative_error(near.value, searched.value) < 1e-6);
        CHECK((near.s - searched.s).norm() < 1e-3);
        const ninedof::Vec9 length = ninedof::leg_lengths(published, {moved, q, near.s});
        // A limit whose multiplier is nearly zero may count as active in one of the two: both lie at it then.
        const std::uint32_t differing = near.active.bits() ^ searched.active.bits();
        for (int leg = 3; leg < 9; ++leg) {
          if (((differing >> ninedof::ActiveBounds::low(leg)) & 1U) != 0) CHECK(length[leg] - 1.5 < 1e-5);
          if (((differing >> ninedof::ActiveBounds::high(leg)) & 1U) != 0) CHECK(5.0 - length[leg] < 1e-5);
        }
        CHECK((differing >> ninedof::ActiveBounds::clearance(0)) == 0);
        CHECK(length.tail<6>().maxCoeff() < 5.0 + 1e-8);
        CHECK(length.tail<6>().minCoeff() > 1.5 - 1e-8);
        ++compared;
      }
    }
    CHECK(compared > cases(100));
  }

  TEST_CASE("no point near a continued optimum is better, from starts far and near") {
    Random random(2);
    const InternalPointProblem problem;
    for (int n = 0; n < cases(30); ++n) {
      const Vec3 p = home + 0.8 * random.unit();
      const Vec3 start = ninedof::default_internal_point(published, p, Mat3::Identity()) + 0.5 * random.unit();
      const InternalPoint near = continued(published, p, Mat3::Identity(), problem, start);
      REQUIRE(near.status == InternalPointStatus::found);
      const auto value = [&](const Vec3& s) { return ninedof::condition_number(published, {p, Mat3::Identity(), s}); };
      CHECK(relative_error(near.value, value(near.s)) < 1e-12);
      CHECK(near.value < value(start));
      for (int k = 0; k < 100; ++k)
        CHECK(value(near.s + random.log_uniform(1e-6, 1e-2) * random.unit()) >= near.value * (1.0 - 1e-9));
    }
  }

  TEST_CASE("continuation stays in the chamber of its start") {
    const InternalPointProblem problem;
    for (const double height : {1.5, 6.0}) {
      const InternalPoint near =
          continued(published, home + Vec3(0.1, 0.0, 0.0), Mat3::Identity(), problem, {0.0, 0.0, height});
      if (near.status == InternalPointStatus::found) CHECK((near.s.z() > 3.98) == (height > 3.98));
    }
  }

  TEST_CASE("continuation names the limits that leave no point") {
    InternalPointProblem problem = with_limits(1.0, 2.0);
    const Vec3 middle(0.0, 0.0, 2.0);
    const InternalPoint tight = continued(published, {0.0, 0.0, 8.0}, Mat3::Identity(), problem, middle);
    CHECK(tight.status == InternalPointStatus::infeasible);
    CHECK(!tight.active.empty());
    CHECK(tight.s.hasNaN());
    problem.limits.high.setConstant(4.0);
    const InternalPoint legs = continued(published, home, Mat3::Identity(), problem, middle);
    CHECK(legs.active.names() == std::vector<std::string>{"l1 high", "l2 high", "l3 high"});
    problem.limits.high.setConstant(infinity);
    CHECK(continued(published, home, Mat3::Identity(), problem, {0.1, 0.0, 0.0}).status ==
          InternalPointStatus::singular);
    CHECK(continued(published, {0.0, not_a_number, 4.0}, Mat3::Identity(), problem, middle).status ==
          InternalPointStatus::missing);
  }

  TEST_CASE("a map has the optima of single searches, for any number of threads") {
    constexpr std::size_t n = sanitized ? 16 : 24;
    const std::vector<PlatformPose> poses = plane(n);
    for (const InternalPointProblem& problem : {with_limits(1.8, 4.6), InternalPointProblem{}}) {
      if (sanitized && !problem.limits.high.allFinite()) continue;  // the map below, which is stopped, has no limits
      MapSettings settings;
      settings.threads = 1;
      const InternalPointMap map = best_internal_map(published, {poses, {n, n}, {}}, problem, settings);
      CHECK(map.complete);
      settings.threads = 3;
      const InternalPointMap other = best_internal_map(published, {poses, {n, n}, {}}, problem, settings);
      CHECK(map.audit.missed == 0);
      CHECK(map.searched < poses.size() / (sanitized ? 5 : 10));
      for (std::size_t k = 0; k < poses.size(); ++k) {
        CHECK(same_bits(map.points[k], other.points[k]));
        if (k % 7 != 0) continue;
        const InternalPoint one = best_internal_point(published, poses[k].position, poses[k].rotation, problem);
        CHECK(map.points[k].status == one.status);
        if (one.status == InternalPointStatus::found) CHECK(map.points[k].value < one.value * (1.0 + 1e-6));
      }
    }
  }

  TEST_CASE("a stopped map returns the poses placed so far") {
    const std::vector<PlatformPose> poses = plane(40);
    MapSettings settings;
    settings.threads = 2;
    std::stop_source source;
    const Control control{source.get_token(), [&](long done, long, double) {
                            if (done >= 600) source.request_stop();
                          }};
    const InternalPointMap map = best_internal_map(published, {poses, {40, 40}, {}}, {}, settings, control);
    CHECK(!map.complete);
    const auto missing = std::ranges::count(map.points, InternalPointStatus::missing, &InternalPoint::status);
    CHECK(missing > 0);
    CHECK(missing <= 1000);
  }

  TEST_CASE("invalid grids and problems are rejected, a start with NaN is missing") {
    const std::vector<PlatformPose> poses = plane(4);
    const std::vector<Vec3> two(2, home);
    CHECK(refuses("shape", [&] { best_internal_map(published, {poses, {4, 5}, {}}, {}); }));
    CHECK(refuses("starts", [&] { best_internal_map(published, {poses, {16}, two}, {}); }));
    MapSettings settings;
    settings.seed_every = 0;
    CHECK(refuses("seed_every", [&] { best_internal_map(published, {poses, {16}, {}}, {}, settings); }));
    CHECK(best_internal_map(published, {{}, {0, 4}, {}}, {}).points.empty());
    InternalPointProblem problem;
    problem.characteristic_length = 0.0;
    CHECK(refuses("characteristic_length", [&] { best_internal_map(published, {poses, {16}, {}}, problem); }));
    const Vec3 not_finite(0.1, not_a_number, 0.0);
    CHECK(best_internal_map(published, {poses, {16}, {&not_finite, 1}}, {}).points.front().status ==
          InternalPointStatus::missing);
  }

  TEST_CASE("refining a lattice ends with the whole grid, and neighbours are mutual") {
    const std::vector<std::size_t> shape{5, 1, 9};
    ninedof::Lattice lattice(shape, 9);
    const auto size = [&] {
      int n = 0;
      for (std::size_t k = 0; k < 45; ++k) n += lattice.has(k);
      return n;
    };
    CHECK(size() == 6);
    while (lattice.refine()) CHECK(size() > 6);
    CHECK(size() == 45);
    int pairs = 0;
    for (std::size_t k = 0; k < 45; ++k)
      lattice.neighbours(k, [&](std::size_t j, std::size_t beyond) {
        ++pairs;
        if (beyond != ninedof::Lattice::none) CHECK(beyond - j == j - k);
        int back = 0;
        lattice.neighbours(j, [&](std::size_t i, std::size_t) { back += i == k; });
        CHECK(back == 1);
      });
    CHECK(pairs == 2 * (4 * 9 + 5 * 8));
  }
}
