/// Tracking against fine continuation: random steps of the leg lengths, and trajectories through singularities.
///
///     ninedof_continuation [steps of each kind] [trajectories of each kind] [seed]
///
/// Counts answers "tracked" that are not where a continuation in small steps ends, or where it meets a singularity.
/// The continuation shares nothing with the tracker: Newton's method on all nine coordinates. Exit status 1 if any is
/// wrong.

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <mutex>
#include <optional>
#include <vector>

#include "ninedof/math/parallel.hpp"
#include "ninedof/position/tracking.hpp"
#include "ninedof/robot/legs.hpp"
#include "support/baseline_motion.hpp"
#include "support/data.hpp"

namespace {

using ninedof::Configuration;
using ninedof::Geometry;
using ninedof::Mat9;
using ninedof::Tracked;
using ninedof::TrackStatus;
using ninedof::Vec3;
using ninedof::Vec9;

/// Derivative of the nine lengths by the coordinates of `plus`.
Mat9 rates(const Geometry& g, const Configuration& c) {
  return bench::plain::rates(bench::plain::Legs(g, c));
}

/// The configuration at the end of a straight path of lengths, with steps so small that Newton's corrections are a
/// twentieth of them; nothing where they shrink to nothing or the determinant changes its sign.
std::optional<Configuration> continued(const Geometry& g, Configuration c, const Vec9& to, double longest) {
  const Vec9 from = ninedof::leg_lengths(g, c);
  double t = 0.0, stride = 0.125;
  Eigen::PartialPivLU<Mat9> lu(rates(g, c));
  double sign = lu.determinant();
  while (t < 1.0) {
    if (stride < 1e-14) return {};
    const double next = std::min(1.0, t + stride);
    const Vec9 lengths = from + next * (to - from);
    const Vec9 tangent = lu.solve(Vec9(lengths - ninedof::leg_lengths(g, c)));
    bool good = tangent.norm() <= longest;
    Configuration at = good ? ninedof::plus(c, tangent) : c;
    Eigen::PartialPivLU<Mat9> there;
    double corrected = 0.0;
    for (int k = 0; good && k < 6; ++k) {
      there.compute(rates(g, at));
      const Vec9 correction = there.solve(Vec9(lengths - ninedof::leg_lengths(g, at)));
      corrected += correction.norm();
      good = corrected <= 0.05 * tangent.norm() + 1e-12;
      if (correction.norm() <= 1e-13) break;
      at = ninedof::plus(at, correction);
    }
    if (!good || !(there.determinant() * sign > 0.0)) {
      stride *= 0.5;
      continue;
    }
    c = at;
    lu = there;
    sign = there.determinant();
    t = next;
    stride *= 1.5;
  }
  return c;
}

double distance(const Configuration& a, const Configuration& b) {
  return std::max({(a.position - b.position).norm(), (a.internal_point - b.internal_point).norm(),
                   (a.rotation - b.rotation).norm()});
}

struct Tally {
  /// `through` a singularity: the determinant has changed its sign. `open`: the continuation itself gives up next to
  /// one.
  long tracked = 0, divided = 0, wrong = 0, through = 0, open = 0, given_up = 0;

  void add(const Tally& t) {
    tracked += t.tracked;
    divided += t.divided;
    wrong += t.wrong;
    through += t.through;
    open += t.open;
    given_up += t.given_up;
  }
};

/// Compares one answer; a disagreement is confirmed by a continuation ten times finer.
void compare(const Geometry& g, const Configuration& from, const Vec9& to, const Tracked& t, Tally& tally) {
  constexpr double near = 1e-5;  // modes that are nearer cannot be told apart by half the digits
  const bool tracked = t.status == TrackStatus::tracked;
  std::optional<Configuration> end = continued(g, from, to, 0.1);
  if (tracked && (!end || distance(*end, t.configuration) > near)) end = continued(g, from, to, 0.01);
  tally.tracked += tracked;
  tally.divided += tracked && t.steps > 1;
  tally.wrong += tracked && end && distance(*end, t.configuration) > near;
  if (tracked) {
    const auto determinant = [&](const Configuration& c) {
      return Eigen::PartialPivLU<Mat9>(rates(g, c)).determinant();
    };
    const bool same_side = determinant(from) * determinant(t.configuration) > 0.0;
    tally.through += !same_side;
    tally.open += same_side && !end;
  }
  tally.given_up += !tracked && end;
}

/// The published design, hexagonal robots, some with joints in one place, and robots without symmetry.
Geometry robot(bench::Random& random, int kind) {
  if (kind == 0) return Geometry::hexagonal(0.0, 5.8124, 2.9062, 0.0);
  if (kind == 1) return bench::random_geometry(random, true);
  if (kind == 2) return Geometry::hexagonal(random(0.5, 6.0), 0.0, 0.0, random(0.5, 3.0));
  return bench::random_geometry(random, false);
}

Configuration start(bench::Random& random) {
  return random(0.0, 1.0) < 0.5 ? bench::near_home(random) : bench::any_configuration(random);
}

Vec9 direction(bench::Random& random) {
  Vec9 out;
  for (double& x : out) x = random(-1.0, 1.0);
  return out;
}

/// Lengths changed at random, from a thousandth to the length of the robot, or those of a moved configuration.
void step(bench::Random& random, int kind, Tally& tally) {
  const Geometry g = robot(random, kind);
  const Configuration c = start(random);
  const double size = std::exp(random(std::log(1e-3), 0.5));
  const Vec9 to = random(0.0, 1.0) < 0.5 ? Vec9(ninedof::leg_lengths(g, c) + size * direction(random))
                                         : ninedof::leg_lengths(g, ninedof::plus(c, size * direction(random)));
  if (!(to.minCoeff() > 0.0)) return;
  compare(g, c, to, ninedof::track(g, to, c), tally);
}

/// Forty sets of lengths on the way to another configuration, most of them beyond a singularity.
void trajectory(bench::Random& random, int kind, Tally& tally) {
  const Geometry g = robot(random, kind);
  const Configuration c = start(random);
  const Vec9 move = 2.0 * direction(random);
  std::vector<Vec9> lengths;
  for (int k = 1; k <= 40; ++k) lengths.push_back(ninedof::leg_lengths(g, ninedof::plus(c, k / 40.0 * move)));
  Configuration at = c;
  Tally steps;
  const std::vector<Tracked> path = ninedof::track(g, lengths, c);
  for (std::size_t k = 0; k < lengths.size(); ++k) {
    compare(g, at, lengths[k], path[k], steps);
    if (path[k].status != TrackStatus::tracked) break;
    at = path[k].configuration;
  }
  tally.tracked += path.back().status == TrackStatus::tracked;
  tally.wrong += steps.wrong > 0;
  tally.through += steps.through > 0;
  tally.open += steps.open > 0;
  tally.divided += steps.divided > 0;
  tally.given_up += steps.given_up > 0;
}

template <class Case>
long check(const char* what, long cases, unsigned seed, const Case& one) {
  long bad = 0;
  const char* kinds[] = {"published", "hexagonal", "joints in one place", "no symmetry"};
  for (int kind = 0; kind < 4; ++kind) {
    Tally all;
    std::mutex guard;
    ninedof::parallel_for(cases, 1000, 0, [&](long first, long last) {
      Tally block;
      for (long k = first; k < last; ++k) {
        bench::Random random(seed + 4U * static_cast<unsigned>(k) + static_cast<unsigned>(kind));
        one(random, kind, block);
      }
      const std::lock_guard lock(guard);
      all.add(block);
    });
    std::printf(
        "%ld %s, %s: %ld tracked (%ld of them divided), %ld to another mode, %ld through a singularity; "
        "%ld too near one to compare, %ld not tracked that can be continued\n",
        cases, what, kinds[kind], all.tracked, all.divided, all.wrong, all.through, all.open, all.given_up);
    std::fflush(stdout);
    bad += all.wrong + all.through;
  }
  return bad;
}

}  // namespace

int main(int argc, char** argv) {
  const long steps = argc > 1 ? std::atol(argv[1]) : 2'500'000, trajectories = argc > 2 ? std::atol(argv[2]) : 25'000;
  const auto seed = static_cast<unsigned>(argc > 3 ? std::atol(argv[3]) : 1);
  const long bad = check("steps", steps, seed, step) + check("trajectories", trajectories, seed, trajectory);
  return bad == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
