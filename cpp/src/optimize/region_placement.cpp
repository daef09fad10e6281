#include "ninedof/optimize/region_placement.hpp"

#include <algorithm>
#include <memory>
#include <span>

#include "domains/region_descent.hpp"
#include "math/linear/least_squares.hpp"
#include "math/numbers.hpp"
#include "math/sort_by.hpp"
#include "ninedof/domains/region_sample.hpp"
#include "ninedof/math/error.hpp"
#include "ninedof/math/parallel.hpp"
#include "optimize/minimax/placed_pose.hpp"
#include "optimize/region/posed.hpp"
#include "problem/full_variables.hpp"

namespace ninedof {
namespace {

constexpr long samples_a_task = 256;        // of samples
constexpr long poses_a_task = 16;
constexpr long rows_a_task = 64;
constexpr double spare = 0.005;     // a sample with so much to spare is not looked at further
constexpr double no_longer_held = 1e-7;    // excess from which O is placed from other starts too
constexpr double apart = 0.2;      // of the region: samples nearer than that to a worse one begin no ascent
constexpr std::size_t ascents = 32;  // from samples
constexpr std::size_t placed_at_once = 128;  // samples
constexpr std::size_t most_tried = 6;        // known places from which O is placed anew
constexpr double little = 1e-3;     // weight of the slopes of a fit: few places are known at first

struct Hot {
  Placed placed;
  double excess;
};
double less_excess(const Hot& hot) {
  return -hot.excess;
}

/// Minus the excess of a pose with O placed, which follows from pose to pose; its slopes by the envelope theorem.
class PlacedNumber : public PoseNumbers {
 public:
  PlacedNumber(const Region& region, PlacedPose& pose, const Vec3& shift)
      : region_(region), pose_(pose), shift_(shift), at_least_(shift) {}
  std::vector<int> groups() const override { return {1}; }
  bool smooth(int, int) const override { return true; }
  void go(const Vec6& at) override { at_ = at; }
  void evaluate(int, double* out) override {
    Vec6 unused;
    *out = slopes(0, 0, at_, unused);
  }
  double slopes(int, int, const Vec6& at, Vec6& by_at) override {
    pose_.set_pose(region_.pose(at), region_.slopes(at));
    const double value = -pose_.place(shift_, -infinity);
    const PlacedPose::Outer found = pose_.least(shift_);
    by_at = -found.by_at.row(0).transpose();
    if (value < least_) {
      least_ = value;
      at_least_ = shift_;
    }
    return value;
  }
  /// O where the number was least.
  const Vec3& at_least() const { return at_least_; }

 private:
  const Region& region_;
  PlacedPose& pose_;
  Vec6 at_ = Vec6::Zero();
  Vec3 shift_, at_least_;
  double least_ = infinity;
};

/// Places O from known places and from the shifted and held ones.
class Placing {
 public:
  Placing(const Problem& problem, const Region& region, const Eigen::VectorXd& variables, const PlacementGoal& goal,
          const std::vector<Placed>& known, bool located = true)
      : region_(region), known_(known), located_(located), pose_(problem, variables, goal) {
    Eigen::Matrix<double, 7, 7> normal =
        Eigen::Matrix<double, 7, 7>::Identity() * (little * static_cast<double>(known.size()));
    Eigen::Matrix<double, 7, 3> right = Eigen::Matrix<double, 7, 3>::Zero();
    for (const Placed& placed : known) {
      Eigen::Matrix<double, 7, 1> row;
      row << 1.0, parts(placed.at);
      normal += row * row.transpose();
      right += row * placed.shift.transpose();
    }
    if (!known.empty()) fit_ = solve_definite(normal, right);
  }

  double near(Placed& placed, double enough) {
    pose_.set_pose(region_.pose(placed.at));
    return pose_.place(placed.shift, enough);
  }

  /// The least excess from every start; the first that reaches `enough` ends the search.
  double anew(Placed& placed, double excess, double enough) {
    const Pose pose = region_.pose(placed.at);
    pose_.set_pose(pose);
    std::vector<Vec3> starts{Vec3(Vec3::Zero()), shifted_with(pose, pose_.zp())};
    for (const Placed* other : nearest(placed.at)) starts.push_back(other->shift);
    for (Vec3& start : starts) {
      if (excess <= enough) break;
      const double found = pose_.place(start, enough);
      if (!(found < excess)) continue;
      excess = found;
      placed.shift = start;
    }
    return excess;
  }

  /// The known places nearest to a pose; there may be many, and O is much the same at most of them.
  std::vector<const Placed*> nearest(const Vec6& at) const {
    std::vector<const Placed*> out;
    for (const Placed& other : known_) out.push_back(&other);
    if (!located_) return out;
    sort_by(out, [&](const Placed* other) { return distance_in(region_, at, other->at); });
    out.resize(std::min(out.size(), most_tried));
    return out;
  }

  PlacedEnd end(const Placed& placed) {
    pose_.set_pose(region_.pose(placed.at));
    return pose_.end(placed);
  }

  /// Where O may be expected: the known places, fitted by a function that is linear in the pose.
  Vec3 guess(const Vec6& at) const {
    if (known_.empty()) return Vec3::Zero();
    return fit_.topRows<1>().transpose() + fit_.bottomRows<6>().transpose() * parts(at);
  }

  /// Goes to where the excess is larger, from a pose with O to the next one with O a little farther.
  double ascend(Placed& placed, double excess, const std::stop_token& stop, long& count) {
    PlacedNumber number(region_, pose_, placed.shift);
    MetNumber met{-excess, placed.at};
    count += descend_a_little(number, region_, {0, 0, 1}, stop, met);
    placed = {met.at, number.at_least()};
    return near(placed, -infinity);
  }

 private:
  Vec6 parts(const Vec6& at) const { return at.cwiseQuotient(region_.reach().cwiseMax(1e-300)); }

  const Region& region_;
  const std::vector<Placed>& known_;
  bool located_;  // whether the poses of the known places are known too
  Eigen::Matrix<double, 7, 3> fit_ = Eigen::Matrix<double, 7, 3>::Zero();
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
      const double excess = placing.near(placed, -spare);
      if (excess > -spare) of_block[at_index(first)].push_back({placed, excess});
    }
  });
  stop_here();
  std::vector<Hot> hot;
  for (const std::vector<Hot>& some : of_block) hot.insert(hot.end(), some.begin(), some.end());
  sort_by(hot, less_excess);
  // What passes from the nearest start may not from others. Of a poor design most samples pass: some are enough.
  std::size_t done = 0;
  while (done < hot.size() && hot[done].excess > no_longer_held) {
    const auto count = static_cast<long>(std::min(hot.size() - done, placed_at_once));
    parallel_for(count, 1, settings.threads, [&](long k, long) {
      if (control.stop.stop_requested()) return;
      Placing placing(problem, region, variables, goal, known);
      Hot& sample = hot[done + at_index(k)];
      sample.excess = placing.anew(sample.placed, sample.excess, -spare);
    });
    stop_here();
    done += at_index(count);
    const auto pass = std::count_if(hot.begin(), hot.begin() + static_cast<std::ptrdiff_t>(done),
                                    [](const Hot& sample) { return sample.excess > no_longer_held; });
    if (at_index(pass) >= ascents) hot.resize(done);
  }
  sort_by(hot, less_excess);

  std::vector<Hot> starts;
  for (const Placed& placed : known) starts.push_back({placed, 0.0});
  for (const Hot& sample : hot) {
    if (starts.size() >= known.size() + ascents) break;
    const bool near = std::ranges::any_of(std::span(starts).subspan(known.size()), [&](const Hot& other) {
      return distance_in(region, sample.placed.at, other.placed.at) < apart;
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
    end.excess = placing.ascend(end.placed, end.excess, control.stop, counts[at_index(k)]);
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
          placing(problem, region, variables, goal, others, false) {
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
