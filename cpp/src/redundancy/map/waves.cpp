#include "redundancy/map/waves.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "math/numbers.hpp"
#include "math/splitmix.hpp"
#include "ninedof/math/parallel.hpp"
#include "redundancy/map/follow.hpp"
#include "redundancy/map/lattice.hpp"

namespace ninedof {
namespace {

// Poses between two progress reports.
constexpr std::size_t slice = 512, search_slice = 32;
constexpr std::size_t least_audit = 32;  // fewer poses say little
constexpr double deficit = 1e-6;   // counts as missed

using Places = std::vector<std::size_t>;

class Map {
 public:
  Map(const Geometry& g, const PoseGrid& grid, const InternalPointProblem& problem, const MapSettings& settings,
      const Control& control)
      : geometry_(g),
        grid_(grid),
        problem_(problem),
        settings_(settings),
        control_(control),
        lattice_(grid.shape, settings.seed_every),
        cells_(grid.poses.size()),
        open_(cells_.size(), 0),
        fresh_(cells_.size(), 0),
        searched_(cells_.size(), 0) {}

  InternalPointMap run() {
    if (close() && place_all()) audit();
    for (const Finding& cell : cells_) out_.points.push_back(cell.point);
    return std::move(out_);
  }

 private:
  std::optional<Vec3> start(std::size_t k) const {
    if (grid_.starts.empty()) return {};
    return grid_.starts[grid_.starts.size() == 1 ? 0 : k];
  }
  bool placed(std::size_t k) const { return !cells_[k].sides.isZero(); }

  /// Calls work(n) for n below `count`, in slices; false if stopped.
  template <class Work>
  bool each(std::size_t count, std::size_t length, Work work) {
    for (std::size_t first = 0; first < count; first += length) {
      const auto last = static_cast<long>(std::min(count, first + length));
      parallel_for(last - static_cast<long>(first), 8, settings_.threads, [&](long from, long to) {
        if (control_.stop.stop_requested()) return;
        for (long n = from; n < to; ++n) work(first + static_cast<std::size_t>(n));
      });
      if (control_.stop.stop_requested()) return out_.complete = false;
      if (control_.progress)
        control_.progress(static_cast<long>(done_), static_cast<long>(cells_.size()), not_a_number);
    }
    return true;
  }

  /// Settles the poses that allow no point whatever is done.
  bool close() {
    const bool whole = each(cells_.size(), 64 * slice, [&](std::size_t k) {
      const PlatformPose& pose = grid_.poses[k];
      const std::optional<Vec3> from = start(k);
      if (from && from->hasNaN()) return;
      cells_[k] = before_search(geometry_, pose.position, pose.rotation, problem_);
      if (cells_[k].point.status != InternalPointStatus::singular) return;
      const Scene scene(geometry_, pose.position, pose.rotation, problem_);
      if (chamber_starts(scene, problem_, from).empty()) return;
      open_[k] = 1;
      cells_[k] = {};
    });
    const auto first = static_cast<std::size_t>(std::ranges::find(open_, 1) - open_.begin());
    if (first < open_.size()) {
      const PlatformPose& pose = grid_.poses[first];
      unit_ = Scene(geometry_, pose.position, pose.rotation, problem_).unit();
    }
    done_ = static_cast<std::size_t>(std::ranges::count(open_, 0));
    return whole;
  }

  /// Searches from a lattice and spreads what it finds, then from finer lattices what is left.
  bool place_all() {
    do {
      Places some;
      for (std::size_t k = 0; k < cells_.size(); ++k)
        if (open_[k] && !placed(k) && lattice_.has(k)) some.push_back(k);
      std::vector<Finding> found;
      if (!search(some, found)) return false;
      for (std::size_t n = 0; n < some.size(); ++n) put(some[n], found[n]);
      if (!spread(some)) return false;
    } while (done_ < cells_.size() && lattice_.refine());
    return true;
  }

  bool search(const Places& places, std::vector<Finding>& found) {
    found.assign(places.size(), {});
    const bool whole = each(places.size(), search_slice, [&](std::size_t n) {
      const std::size_t k = places[n];
      found[n] = search_pose(geometry_, grid_.poses[k].position, grid_.poses[k].rotation, problem_, start(k));
    });
    out_.searched += places.size();
    for (const std::size_t k : places) searched_[k] = 1;
    return whole;
  }

  void put(std::size_t k, const Finding& finding) {
    if (!placed(k)) ++done_;
    cells_[k] = finding;
  }

  /// Waves from the poses given until nothing changes.
  bool spread(Places from) {
    std::vector<Followed> next;
    while (!from.empty()) {
      for (const std::size_t k : from) fresh_[k] = 1;
      const Places ahead = beside(from);
      next.assign(ahead.size(), {});
      const bool whole = each(ahead.size(), slice, [&](std::size_t n) { next[n] = continued(ahead[n]); });
      for (const std::size_t k : from) fresh_[k] = 0;
      if (!whole) return false;
      from.clear();
      for (std::size_t n = 0; n < ahead.size(); ++n) {
        out_.followed += static_cast<std::size_t>(next[n].count);
        if (next[n].count == 0 || !takes_over(problem_.criterion, next[n].best, cells_[ahead[n]])) continue;
        put(ahead[n], next[n].best);
        from.push_back(ahead[n]);
      }
    }
    return true;
  }

  /// The open neighbours of the poses given, in order.
  Places beside(const Places& from) const {
    Places out;
    for (const std::size_t k : from)
      lattice_.neighbours(k, [&](std::size_t j, std::size_t) {
        if (open_[j]) out.push_back(j);
      });
    std::ranges::sort(out);
    out.erase(std::ranges::unique(out).begin(), out.end());
    return out;
  }

  /// Pose k continued from its neighbours: all of them if it has nothing, else those with news.
  Followed continued(std::size_t k) const {
    std::vector<Lead> leads;
    lattice_.neighbours(k, [&](std::size_t j, std::size_t beyond) {
      if (!placed(j) || (placed(k) && !fresh_[j])) return;
      const Lead lead = lead_from(k, j, beyond);
      // Most have what their neighbours have.
      if (!placed(k) || (lead.s - cells_[k].s).norm() > lead.reach) leads.push_back(lead);
    });
    if (leads.empty()) return {cells_[k]};
    return follow(geometry_, grid_.poses[k], problem_, start(k), leads, cells_[k]);
  }

  /// Where the line through the points of two neighbours leads, or the point of one.
  Lead lead_from(std::size_t k, std::size_t j, std::size_t beyond) const {
    const PlatformPose &here = grid_.poses[k], &there = grid_.poses[j];
    const double moved = (here.position - there.position).norm() + unit_ * (here.rotation - there.rotation).norm();
    Lead lead{cells_[j].s, branch_reach(unit_, moved)};
    if (beyond == Lattice::none || !placed(beyond)) return lead;
    const Vec3 step = lead.s - cells_[beyond].s;
    if (step.norm() < 2.0 * lead.reach) lead.s += step;
    return lead;
  }

  /// Searches poses drawn at random, keeps what is better and spreads it.
  void audit() {
    const Places drawn = sample();
    std::vector<Finding> found;
    if (!search(drawn, found)) return;
    Places news;
    for (std::size_t n = 0; n < drawn.size(); ++n) {
      const double lost = shortfall(cells_[drawn[n]], found[n]);
      ++out_.audit.poses;
      if (lost > deficit) ++out_.audit.missed;
      out_.audit.largest = std::max(out_.audit.largest, lost);
      if (!takes_over(problem_.criterion, found[n], cells_[drawn[n]])) continue;
      put(drawn[n], found[n]);
      news.push_back(drawn[n]);
    }
    spread(news);
  }

  /// Open poses that no search has seen yet, the first few in a random order.
  Places sample() const {
    std::vector<std::pair<double, std::size_t>> lots;
    for (std::size_t k = 0; k < cells_.size(); ++k)
      if (open_[k] && !searched_[k])
        lots.emplace_back(uniform_from((settings_.audit_seed * cells_.size() + k + 1) * 0x9E3779B97F4A7C15ULL), k);
    const std::size_t share = (lots.size() + settings_.audit_every - 1) / settings_.audit_every;
    const std::size_t count = std::min(lots.size(), std::max(least_audit, share));
    std::ranges::partial_sort(lots, lots.begin() + static_cast<std::ptrdiff_t>(count));
    Places out;
    for (std::size_t n = 0; n < count; ++n) out.push_back(lots[n].second);
    return out;
  }

  /// How much better the second is, 0 where it is not.
  double shortfall(const Finding& ours, const Finding& other) const {
    if (!takes_over(problem_.criterion, other, ours)) return 0.0;
    const double by = ours.value - other.value;
    return problem_.criterion == Criterion::leg_centring ? by : std::expm1(by);
  }

  const Geometry& geometry_;
  const PoseGrid& grid_;
  const InternalPointProblem& problem_;
  const MapSettings& settings_;
  const Control& control_;
  Lattice lattice_;
  std::vector<Finding> cells_;
  std::vector<char> open_, fresh_, searched_;
  std::size_t done_ = 0;
  double unit_ = 1.0;  // size of the robot at the first pose
  InternalPointMap out_;
};

}  // namespace

InternalPointMap map_in_waves(const Geometry& g, const PoseGrid& grid, const InternalPointProblem& problem,
                              const MapSettings& settings, const Control& control) {
  return Map(g, grid, problem, settings, control).run();
}

}  // namespace ninedof
