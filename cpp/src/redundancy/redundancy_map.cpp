#include "ninedof/redundancy/redundancy_map.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "math/numbers.hpp"
#include "math/splitmix.hpp"
#include "ninedof/math/error.hpp"
#include "ninedof/math/parallel.hpp"
#include "redundancy/map/continuation.hpp"
#include "redundancy/map/lattice.hpp"

namespace ninedof {
namespace {

// Poses between two progress reports; a stop is noticed sooner.
constexpr std::size_t slice = 512, search_slice = 32;
constexpr std::size_t least_audit = 32;  // fewer poses give no estimate

using Indices = std::vector<std::size_t>;

class WavefrontMap {
 public:
  WavefrontMap(const Geometry& g, const PoseGrid& grid, const InternalPointProblem& problem,
               const MapSettings& settings, const Control& control)
      : geometry_(g),
        grid_(grid),
        problem_(problem),
        settings_(settings),
        control_(control),
        lattice_(grid.shape, settings.seed_every),
        results_(grid.poses.size()),
        allowed_(results_.size(), 0),
        changed_(results_.size(), 0),
        searched_(results_.size(), 0) {}

  InternalPointMap run() {
    if (check_poses() && place_all() && scan_all()) audit();
    for (const PoseResult& result : results_) out_.points.push_back(result.point);
    return std::move(out_);
  }

 private:
  std::optional<Vec3> start(std::size_t k) const {
    if (grid_.starts.empty()) return {};
    return grid_.starts[grid_.starts.size() == 1 ? 0 : k];
  }
  bool placed(std::size_t k) const { return !results_[k].signs.isZero(); }

  /// Calls work(n) for n below `count`, in slices; false if stopped.
  template <class Work>
  bool each(std::size_t count, std::size_t length, Work work) {
    for (std::size_t first = 0; first < count; first += length) {
      const auto last = static_cast<long>(std::min(count, first + length));
      parallel_for(last - static_cast<long>(first), 8, settings_.threads, [&](long from, long to) {
        if (control_.stop.stop_requested()) return;
        for (long n = from; n < to; ++n) work(first + at_index(n));
      });
      if (control_.stop.stop_requested()) return out_.complete = false;
      if (control_.progress)
        control_.progress(static_cast<long>(done_), static_cast<long>(results_.size()), not_a_number);
    }
    return true;
  }

  /// Finds the poses that allow a point; the others get their results here.
  bool check_poses() {
    const bool whole = each(results_.size(), 64 * slice, [&](std::size_t k) {
      const PlatformPose& pose = grid_.poses[k];
      const std::optional<Vec3> from = start(k);
      if (from && from->hasNaN()) return;
      results_[k] = checked_pose(geometry_, pose.position, pose.rotation, problem_);
      if (results_[k].point.status != InternalPointStatus::singular) return;
      const ScaledPose scaled(geometry_, pose.position, pose.rotation, problem_);
      if (chamber_starts(scaled, problem_, from).empty()) return;
      allowed_[k] = 1;
      results_[k] = {};
    });
    const auto first = at_index(std::ranges::find(allowed_, 1) - allowed_.begin());
    if (first < allowed_.size()) {
      const PlatformPose& pose = grid_.poses[first];
      unit_ = ScaledPose(geometry_, pose.position, pose.rotation, problem_).unit();
    }
    done_ = at_index(std::ranges::count(allowed_, 0));
    return whole;
  }

  /// Searches the poses of a lattice and propagates their results; then those of finer lattices that were not reached.
  bool place_all() {
    do {
      Indices seeds;
      for (std::size_t k = 0; k < results_.size(); ++k)
        if (allowed_[k] && !placed(k) && lattice_.has(k)) seeds.push_back(k);
      std::vector<PoseResult> found;
      if (!search(seeds, found)) return false;
      for (std::size_t n = 0; n < seeds.size(); ++n) enter(seeds[n], found[n]);
      if (!spread(seeds)) return false;
    } while (done_ < results_.size() && lattice_.refine());
    return true;
  }

  /// Scans every pose that was not searched for a better branch, and propagates what is found.
  bool scan_all() {
    Indices some;
    for (std::size_t k = 0; k < results_.size(); ++k)
      if (allowed_[k] && !searched_[k]) some.push_back(k);
    std::vector<Continuation> next(some.size());
    const bool whole = each(some.size(), slice, [&](std::size_t n) {
      const std::size_t k = some[n];
      next[n] = scanned_from(geometry_, grid_.poses[k], problem_, start(k), results_[k]);
    });
    if (!whole) return false;
    Indices improved, unclear;
    for (std::size_t n = 0; n < some.size(); ++n) {
      out_.followed += at_index(next[n].count);
      if (!next[n].examined) unclear.push_back(some[n]);
      if (!replaces(problem_.criterion, next[n].best, results_[some[n]])) continue;
      enter(some[n], next[n].best);
      improved.push_back(some[n]);
    }
    return spread(improved) && search_again(unclear);
  }

  /// Searches poses with more valleys than the scan could examine, and propagates what is better.
  bool search_again(const Indices& poses) {
    std::vector<PoseResult> found;
    if (!search(poses, found)) return false;
    Indices improved;
    for (std::size_t n = 0; n < poses.size(); ++n) {
      PoseResult& known = results_[poses[n]];
      if (replaces(problem_.criterion, found[n], known)) {
        enter(poses[n], found[n]);
        improved.push_back(poses[n]);
      } else if (found[n].point.status == InternalPointStatus::local && has_point(known.point)) {
        known.point.status = InternalPointStatus::local;
      }
    }
    return spread(improved);
  }

  bool search(const Indices& indices, std::vector<PoseResult>& found) {
    found.assign(indices.size(), {});
    const bool whole = each(indices.size(), search_slice, [&](std::size_t n) {
      const std::size_t k = indices[n];
      found[n] = search_pose(geometry_, grid_.poses[k].position, grid_.poses[k].rotation, problem_, start(k));
    });
    out_.searched += indices.size();
    for (const std::size_t k : indices) searched_[k] = 1;
    return whole;
  }

  void enter(std::size_t k, const PoseResult& pose_result) {
    if (!placed(k)) ++done_;
    results_[k] = pose_result;
  }

  /// Propagates from the poses given until nothing changes.
  bool spread(Indices from) {
    std::vector<Continuation> next;
    while (!from.empty()) {
      for (const std::size_t k : from) changed_[k] = 1;
      const Indices ahead = neighbours_of(from);
      next.assign(ahead.size(), {});
      const bool whole = each(ahead.size(), slice, [&](std::size_t n) { next[n] = continued(ahead[n]); });
      for (const std::size_t k : from) changed_[k] = 0;
      if (!whole) return false;
      from.clear();
      for (std::size_t n = 0; n < ahead.size(); ++n) {
        out_.followed += at_index(next[n].count);
        if (next[n].count == 0 || !replaces(problem_.criterion, next[n].best, results_[ahead[n]])) continue;
        enter(ahead[n], next[n].best);
        from.push_back(ahead[n]);
      }
    }
    return true;
  }

  /// The neighbours of the poses given that allow a point, in order.
  Indices neighbours_of(const Indices& from) const {
    Indices out;
    for (const std::size_t k : from)
      lattice_.neighbours(k, [&](std::size_t j, std::size_t) {
        if (allowed_[j]) out.push_back(j);
      });
    std::ranges::sort(out);
    out.erase(std::ranges::unique(out).begin(), out.end());
    return out;
  }

  /// Pose k continued from its neighbours: from all of them if it has no result, else from those that changed.
  Continuation continued(std::size_t k) const {
    std::vector<Guess> guesses;
    lattice_.neighbours(k, [&](std::size_t j, std::size_t beyond) {
      if (!placed(j) || (placed(k) && !changed_[j])) return;
      const Guess guess = guess_from(k, j, beyond);
      // Most poses already have the branch of their neighbours.
      if (!placed(k) || (guess.s - results_[k].s).norm() > guess.reach) guesses.push_back(guess);
    });
    if (guesses.empty()) return {results_[k]};
    return continued_from(geometry_, grid_.poses[k], problem_, start(k), guesses, results_[k]);
  }

  /// The point of neighbour j, extrapolated with the point beyond it if that is near.
  Guess guess_from(std::size_t k, std::size_t j, std::size_t beyond) const {
    const PlatformPose &here = grid_.poses[k], &there = grid_.poses[j];
    const double moved = (here.position - there.position).norm() + unit_ * (here.rotation - there.rotation).norm();
    Guess guess{results_[j].s, branch_reach(unit_, moved)};
    if (beyond == Lattice::none || !placed(beyond)) return guess;
    const Vec3 step = guess.s - results_[beyond].s;
    if (step.norm() < 2.0 * guess.reach) guess.s += step;
    return guess;
  }

  /// Searches poses drawn at random; enters and propagates improvements.
  void audit() {
    const Indices drawn = sample();
    std::vector<PoseResult> found;
    if (!search(drawn, found)) return;
    Indices improved;
    for (std::size_t n = 0; n < drawn.size(); ++n) {
      const double lost = shortfall(results_[drawn[n]], found[n]);
      ++out_.audit.poses;
      if (lost > MapAudit::deficit) ++out_.audit.missed;
      out_.audit.largest = std::max(out_.audit.largest, lost);
      if (!replaces(problem_.criterion, found[n], results_[drawn[n]])) continue;
      enter(drawn[n], found[n]);
      improved.push_back(drawn[n]);
    }
    spread(improved);
  }

  /// A random sample of the poses not yet searched.
  Indices sample() const {
    std::vector<std::pair<double, std::size_t>> drawn;
    for (std::size_t k = 0; k < results_.size(); ++k)
      if (allowed_[k] && !searched_[k])
        drawn.emplace_back(uniform_from((settings_.audit_seed * results_.size() + k + 1) * 0x9E3779B97F4A7C15ULL), k);
    const std::size_t share = (drawn.size() + settings_.audit_every - 1) / settings_.audit_every;
    const std::size_t count = std::min(drawn.size(), std::max(least_audit, share));
    std::ranges::partial_sort(drawn, drawn.begin() + static_cast<std::ptrdiff_t>(count));
    Indices out;
    for (std::size_t n = 0; n < count; ++n) out.push_back(drawn[n].second);
    return out;
  }

  /// How much better `other` is, 0 if it is not.
  double shortfall(const PoseResult& mine, const PoseResult& other) const {
    if (!replaces(problem_.criterion, other, mine)) return 0.0;
    const double by = mine.value - other.value;
    return problem_.criterion == Criterion::leg_centring ? by : std::expm1(by);
  }

  const Geometry& geometry_;
  const PoseGrid& grid_;
  const InternalPointProblem& problem_;
  const MapSettings& settings_;
  const Control& control_;
  Lattice lattice_;
  std::vector<PoseResult> results_;
  std::vector<char> allowed_, changed_, searched_;
  std::size_t done_ = 0;
  double unit_ = 1.0;  // size of the robot at the first pose
  InternalPointMap out_;
};

void validate(const PoseGrid& grid) {
  const std::size_t n = grid.poses.size();
  std::size_t product = 1;
  for (const std::size_t length : grid.shape) product *= length;
  if (product != n) throw InvalidArgument("shape", std::to_string(product) + " poses", std::to_string(n));
  if (grid.starts.size() > 1 && grid.starts.size() != n)
    throw InvalidArgument("starts", std::to_string(grid.starts.size()), "none, one or " + std::to_string(n));
}

}  // namespace

InternalPointMap best_internal_map(const Geometry& g, const PoseGrid& grid, const InternalPointProblem& problem,
                                   const MapSettings& settings, const Control& control) {
  validate(problem);
  validate(grid);
  if (settings.seed_every == 0) throw InvalidArgument("seed_every", "0", "one or more");
  if (settings.audit_every == 0) throw InvalidArgument("audit_every", "0", "one or more");
  return WavefrontMap(g, grid, problem, settings, control).run();
}

}  // namespace ninedof
