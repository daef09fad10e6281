/// Declared in ninedof/singularity/singularity.hpp.

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "math/numbers.hpp"
#include "math/stop_at_times.hpp"
#include "ninedof/math/error.hpp"
#include "ninedof/math/parallel.hpp"
#include "ninedof/robot/legs.hpp"
#include "ninedof/singularity/singularity.hpp"

namespace ninedof {
namespace {

const double golden = std::numbers::pi * (3.0 - std::sqrt(5.0));  // angle between neighbours of a spiral
constexpr int refined = 24;
constexpr double farther = 1.3;  // of the least distance: what is looked at in detail

/// A direction from a pose, and how far along it the first singularity is.
using Way = NearestSingularity;

bool nearer(const Way& a, const Way& b) {
  return a.distance < b.distance;
}

struct Search {
  const Geometry& g;
  const std::vector<Configuration>& poses;
  const Motions& motions;
  double most;
  const std::stop_token& stop;

  Way along(long pose, const Vec3& direction, double up_to) const {
    const Vec9 tangent = motions * direction;
    const SingularityDistance d = distance_to_singularity(g, poses[at_index(pose)], tangent, std::min(most, up_to));
    return {std::isnan(d.distance) ? infinity : d.distance, d.mechanism, direction, pose, d.resolved};
  }

  /// Turns a direction to where the distance is least: to the best of some around, or closer to it where none is
  /// nearer.
  Way refine(Way best, double angle) const {
    if (!std::isfinite(best.distance)) return best;
    constexpr int around = 8, most_turns = 400;
    constexpr double last_angle = 1e-7;  // the distance is flat there: its error is the square of this
    for (int turn = 0; turn < most_turns && angle > last_angle; ++turn) {
      if (stop.stop_requested()) throw Stopped{};
      const Vec3 across = best.direction.unitOrthogonal(), third = best.direction.cross(across);
      Way next = best;
      for (int k = 0; k < around; ++k) {
        const double at = 2.0 * std::numbers::pi * (k + 0.5 * (turn % 2)) / around;
        const Vec3 aside = std::cos(at) * across + std::sin(at) * third;
        const Vec3 way = (std::cos(angle) * best.direction + std::sin(angle) * aside).normalized();
        const Way trial = along(best.pose, way, best.distance * (1.0 + 1e-9));
        if (nearer(trial, next)) next = trial;
      }
      constexpr double worthwhile = 1.0 - 1e-13;
      if (next.distance < worthwhile * best.distance) best = next;
      else angle *= 0.5;
    }
    return best;
  }
};

/// The axes, both ways, and a spiral of golden angles.
std::vector<Vec3> spread(int count) {
  std::vector<Vec3> out;
  for (int k = 0; k < 3; ++k)
    for (const double sign : {-1.0, 1.0}) out.push_back(sign * Vec3::Unit(k));
  for (int k = 0; k < count; ++k) {
    const double z = 1.0 - (2.0 * k + 1.0) / count, ring = std::sqrt(1.0 - z * z);
    out.emplace_back(ring * std::cos(golden * k), ring * std::sin(golden * k), z);
  }
  return out;
}

/// Those of one pose that are nearer than all their neighbours, the nearest first, not more than are refined.
std::vector<Way> local_least(std::vector<Way> ways, double neighbours, const std::stop_token& stop) {
  const double cosine = std::cos(neighbours);
  std::erase_if(ways, [](const Way& one) { return !std::isfinite(one.distance); });
  std::stable_sort(ways.begin(), ways.end(), nearer);
  std::vector<Way> out;
  for (auto one = ways.begin(); one != ways.end() && std::ssize(out) < refined; ++one) {
    stop_at_times(one - ways.begin(), stop);
    // Backwards: a neighbour is hardly nearer, so that it stands not far before.
    if (std::none_of(std::make_reverse_iterator(one), ways.rend(), [&](const Way& other) {
          return other.direction.dot(one->direction) > cosine && nearer(other, *one);
        }))
      out.push_back(*one);
  }
  return out;
}

}  // namespace

NearestSingularity nearest_singularity(const Geometry& g, const std::vector<Configuration>& poses,
                                       const Motions& motions, double most, int directions, int threads,
                                       const std::stop_token& stop) {
  if (poses.empty()) throw InvalidArgument("poses", "none", "at least one");
  require_positive("most", most);
  for (const Configuration& c : poses)
    if (c.position.hasNaN() || c.rotation.hasNaN() || c.internal_point.hasNaN())
      throw InvalidArgument("poses", "NaN", "finite numbers");
  const Search search{g, poses, motions, most, stop};
  const auto each_pose = [&](const auto& work) {
    parallel_for(static_cast<long>(poses.size()), 1, threads, [&](long first, long last) {
      for (long k = first; k < last; ++k) work(k);
    });
  };

  // A few directions first: what is far beyond the nearest of them is not followed to its end.
  constexpr int few = 60;
  const Way none{infinity, Mechanism::none, Vec3::UnitZ(), 0, true};
  std::vector<Way> best(poses.size(), none);
  const std::vector<Vec3> coarse = spread(std::min(few, directions));
  each_pose([&](long k) {
    stop_at_times(0, stop);
    for (const Vec3& way : coarse) best[at_index(k)] = std::min(best[at_index(k)], search.along(k, way, most), nearer);
  });
  Way nearest = *std::min_element(best.begin(), best.end(), nearer);
  if (nearest.distance == 0.0) return nearest;
  const double spacing = std::sqrt(4.0 * std::numbers::pi / (directions + 6.0));
  nearest = search.refine(nearest, 2.0 * spacing);

  const std::vector<Vec3> all = spread(directions);
  std::vector<std::vector<Way>> starts(poses.size());
  each_pose([&](long k) {
    std::vector<Way> ways;
    for (const Vec3& way : all) {
      stop_at_times(std::ssize(ways), stop);
      ways.push_back(search.along(k, way, farther * nearest.distance));
    }
    starts[at_index(k)] = local_least(std::move(ways), 1.6 * spacing, stop);
  });
  std::vector<Way> listed;
  for (const auto& some : starts) listed.insert(listed.end(), some.begin(), some.end());
  std::stable_sort(listed.begin(), listed.end(), nearer);
  if (listed.size() > refined) listed.resize(refined);
  parallel_for(static_cast<long>(listed.size()), 1, threads, [&](long first, long last) {
    for (long k = first; k < last; ++k) listed[at_index(k)] = search.refine(listed[at_index(k)], spacing);
  });
  for (const Way& one : listed) nearest = std::min(nearest, one, nearer);
  return nearest;
}

SingularMotions singular_motions(bool internal_held) {
  SingularMotions out{Motions::Zero(), Motions::Zero(), Motions::Zero()};
  out.turn.topRows<3>().setIdentity();
  out.shift.middleRows<3>(3).setIdentity();
  out.internal.bottomRows<3>().setIdentity();
  if (!internal_held) out.shift += out.internal;
  return out;
}

NearestSingularities nearest_singularities(const Geometry& g, const std::vector<Configuration>& poses,
                                           bool internal_held, int threads, const std::stop_token& stop) {
  constexpr double farthest = 4.0;  // in the longest leg
  double longest = 0.0;
  for (const Configuration& c : poses) longest = std::max(longest, leg_lengths(g, c).maxCoeff());
  const auto nearest = [&](const Motions& motions, double most) {
    return nearest_singularity(g, poses, motions, most, 1000, threads, stop);
  };
  const SingularMotions motions = singular_motions(internal_held);
  return {nearest(motions.shift, farthest * longest), nearest(motions.turn, std::numbers::pi),
          nearest(motions.internal, farthest * longest)};
}

}  // namespace ninedof
