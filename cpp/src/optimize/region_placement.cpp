#include "ninedof/optimize/region_placement.hpp"

#include <algorithm>
#include <memory>

#include "math/numbers.hpp"
#include "ninedof/domains/region_sample.hpp"
#include "ninedof/math/error.hpp"
#include "ninedof/math/parallel.hpp"
#include "optimize/minimax/placed_pose.hpp"
#include "problem/full_variables.hpp"

namespace ninedof {
namespace {

constexpr long samples_a_task = 256;        // of samples
constexpr long poses_a_task = 16;
constexpr long rows_a_task = 64;
constexpr double spare = 0.02;     // a sample with so much to spare is not looked at further
constexpr double no_longer_held = 1e-7;    // excess from which O is placed from other starts too
constexpr double apart = 0.2;      // of the region: samples nearer than that to a worse one begin no ascent
constexpr std::size_t ascents = 32;  // from samples
constexpr double first_move = 0.1, last_move = 1e-4;  // of an ascent, in parts of the region
constexpr double least_rise = 1e-9;  // increase of an ascent's step
constexpr long most_poses = 1500;    // of an ascent

struct Hot {
  Placed placed;
  double excess;
};

/// Places O from known places and from the shifted and held ones.
class Placing {
 public:
  Placing(const Problem& problem, const Region& region, const Eigen::VectorXd& variables, const PlacementGoal& goal,
          const std::vector<Placed>& known)
      : region_(region), known_(known), pose_(problem, variables, goal) {}

  double near(Placed& placed, double enough) {
    pose_.set_pose(region_.pose(placed.at));
    return pose_.place(placed.shift, enough);
  }

  /// The least excess from every start; the first that reaches `enough` ends the search.
  double anew(Placed& placed, double excess, double enough) {
    const Pose pose = region_.pose(placed.at);
    pose_.set_pose(pose);
    std::vector<Vec3> starts{Vec3(Vec3::Zero()), Vec3(pose.position / (pose.in_zp ? 1.0 : pose_.zp()))};
    for (const Placed& other : known_) starts.push_back(other.shift);
    for (Vec3& start : starts) {
      if (excess <= enough) break;
      const double found = pose_.place(start, enough);
      if (!(found < excess)) continue;
      excess = found;
      placed.shift = start;
    }
    return excess;
  }

  PlacedEnd end(const Placed& placed) {
    pose_.set_pose(region_.pose(placed.at));
    return pose_.end(placed);
  }

  double distance(const Vec6& a, const Vec6& b) const {
    const Vec6 reach = region_.reach();
    double out = 0.0;
    for (Eigen::Index k = 0; k < 6; ++k)
      if (reach[k] > 0.0) out = std::max(out, std::abs(a[k] - b[k]) / reach[k]);
    return out;
  }

  /// The shift of the nearest known place.
  Vec3 guess(const Vec6& at) const {
    const auto nearest =
        std::ranges::min_element(known_, {}, [&](const Placed& other) { return distance(at, other.at); });
    return nearest == known_.end() ? Vec3(Vec3::Zero()) : nearest->shift;
  }

  /// Raises the excess by moves of the pose both ways; a step is doubled where it helps and halved where none does.
  double ascend(Placed& placed, double excess, double last, long& count) {
    const long most = count + most_poses;
    for (double step = first_move; step >= last && count < most; step *= 0.5) {
      bool higher = true;
      while (higher && count < most) {
        higher = false;
        for (int move = 0; move < region_moves; ++move)
          for (const double side : {1.0, -1.0})
            for (double length = step; length < 2.0; length *= 2.0) {
              Placed next{region_.nearest(region_moved(region_, placed.at, move, side * length)), placed.shift};
              if ((next.at - placed.at).isZero(0.0)) break;
              const double threshold = excess + least_rise * (1.0 + std::abs(excess));
              const double found = near(next, threshold);
              ++count;
              if (!(found > threshold)) break;
              excess = found;
              placed = next;
              higher = true;
            }
      }
    }
    return excess;
  }

 private:
  const Region& region_;
  const std::vector<Placed>& known_;
  PlacedPose pose_;
};

}  // namespace

PlacedWorst search_region_placed(const Problem& problem, const Region& region, const Eigen::VectorXd& variables,
                                 const PlacementGoal& goal, const std::vector<Placed>& known,
                                 const RegionSettings& settings, const Control& control) {
  problem.validate();
  region.validate();
  require_full("variables", problem, variables);
  if (settings.samples < 1) throw InvalidArgument("samples", std::to_string(settings.samples), "one or more");
  const auto stop_here = [&] {
    if (control.stop.stop_requested()) throw Stopped{};
  };

  const long blocks = (settings.samples + samples_a_task - 1) / samples_a_task;
  std::vector<std::vector<Hot>> of_block(at_index(blocks));
  parallel_for(blocks, 1, settings.threads, [&](long first, long) {
    if (control.stop.stop_requested()) return;
    Placing placing(problem, region, variables, goal, known);
    for (long n = first * samples_a_task; n < std::min(settings.samples, (first + 1) * samples_a_task); ++n) {
      Placed placed{region_sample(region, n, settings.seed), Vec3::Zero()};
      placed.shift = placing.guess(placed.at);
      double excess = placing.near(placed, -spare);
      if (excess > no_longer_held) excess = placing.anew(placed, excess, -spare);
      if (excess > -spare) of_block[at_index(first)].push_back({placed, excess});
    }
  });
  stop_here();
  std::vector<Hot> hot;
  for (const std::vector<Hot>& some : of_block) hot.insert(hot.end(), some.begin(), some.end());
  std::ranges::stable_sort(hot, std::ranges::greater(), &Hot::excess);

  const Placing distances(problem, region, variables, goal, known);
  std::vector<Hot> starts;
  for (const Placed& placed : known) starts.push_back({placed, 0.0});
  for (const Hot& sample : hot) {
    if (starts.size() >= known.size() + ascents) break;
    const bool near = std::ranges::any_of(starts, [&](const Hot& other) {
      return &other >= &starts.front() + known.size() && distances.distance(sample.placed.at, other.placed.at) < apart;
    });
    if (!near) starts.push_back(sample);
  }

  PlacedWorst out;
  out.ends.resize(starts.size());
  out.at_known.resize(known.size());
  std::vector<long> counts(starts.size(), 0);
  parallel_for(static_cast<long>(starts.size()), 1, settings.threads, [&](long k, long) {
    if (control.stop.stop_requested()) return;
    Placing placing(problem, region, variables, goal, known);
    Hot start = starts[at_index(k)];
    if (at_index(k) < known.size()) start.excess = out.at_known[at_index(k)] = placing.near(start.placed, -infinity);
    Hot end = start;
    end.excess = placing.ascend(end.placed, end.excess, last_move, counts[at_index(k)]);
    if (end.excess > no_longer_held) end.excess = placing.anew(end.placed, end.excess, -infinity);
    out.ends[at_index(k)] = placing.end(end.excess > start.excess ? end.placed : start.placed);
  });
  stop_here();
  out.poses = settings.samples;
  for (const long count : counts) out.poses += count;
  return out;
}

std::function<PlacedEnd(const Vec6& at)> placer(const Problem& problem, const Region& region,
                                                const Eigen::VectorXd& variables, const PlacementGoal& goal,
                                                const std::vector<Vec3>& known) {
  problem.validate();
  region.validate();
  require_full("variables", problem, variables);
  struct Placer {
    Region region;
    PlacementGoal goal;
    std::vector<Placed> none, others;
    Placing plain, placing;
    Placer(const Problem& problem, const Region& in, const Eigen::VectorXd& variables, const PlacementGoal& to,
           const std::vector<Vec3>& known)
        : region(in),
          goal(to),
          others(known.size()),
          plain(problem, region, variables, goal, none),
          placing(problem, region, variables, goal, others) {
      for (std::size_t k = 0; k < known.size(); ++k) others[k].shift = known[k];
    }
  };
  return [all = std::make_shared<Placer>(problem, region, variables, goal, known)](const Vec6& at) {
    Placed placed{all->region.nearest(at), Vec3::Zero()};
    const double excess = all->plain.anew(placed, infinity, -infinity);
    if (excess > no_longer_held) all->placing.anew(placed, excess, no_longer_held);
    return all->placing.end(placed);
  };
}

std::vector<PlacedEnd> place_in_region(const Problem& problem, const Region& region, const Eigen::VectorXd& variables,
                                       const PlacementGoal& goal, const std::vector<Vec3>& known,
                                       const std::vector<Vec6>& at, int threads, const Control& control) {
  problem.validate();
  region.validate();
  require_full("variables", problem, variables);
  std::vector<PlacedEnd> out(at.size());
  parallel_for(static_cast<long>(at.size()), poses_a_task, threads, [&](long first, long last) {
    if (control.stop.stop_requested()) return;
    const auto place = placer(problem, region, variables, goal, known);
    for (long k = first; k < last; ++k) out[at_index(k)] = place(at[at_index(k)]);
  });
  if (control.stop.stop_requested()) throw Stopped{};
  return out;
}

std::vector<PlacedRows> placed_rows(const Problem& problem, const Region& region, const Eigen::VectorXd& variables,
                                    const PlacementGoal& goal, const std::vector<Placed>& places, int threads,
                                    const Control& control) {
  problem.validate();
  region.validate();
  require_full("variables", problem, variables);
  const auto count = static_cast<long>(places.size());
  std::vector<PlacedRows> out(places.size());
  parallel_for((count + rows_a_task - 1) / rows_a_task, 1, threads, [&](long task, long) {
    if (control.stop.stop_requested()) return;
    PlacedPose pose(problem, variables, goal);
    for (long k = task * rows_a_task; k < std::min(count, (task + 1) * rows_a_task); ++k) {
      const Placed& placed = places[at_index(k)];
      pose.set_pose(region.pose(placed.at));
      out[at_index(k)] = pose.rows(placed.shift);
    }
  });
  if (control.stop.stop_requested()) throw Stopped{};
  return out;
}

}  // namespace ninedof
