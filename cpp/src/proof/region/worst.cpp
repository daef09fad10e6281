#include "proof/region/worst.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "domains/bound.hpp"
#include "math/numbers.hpp"
#include "math/time_limit.hpp"
#include "ninedof/domains/region_extremes.hpp"
#include "ninedof/math/error.hpp"
#include "ninedof/math/parallel.hpp"
#include "proof/region/worst_machine.hpp"

namespace ninedof::over_region {
namespace {

constexpr std::size_t most_boxes = 8'000'000;  // open at a time: a gigabyte
constexpr long samples = 2000;  // of the region, for the first look

const Geometry& drawn_machine(const IndexOverPoses& index) {
  return index.domain().machine().geometry;
}

/// Less the index of the drawing's machine, at a pose of its region.
class LessIndex : public PoseNumbers {
 public:
  explicit LessIndex(const IndexOverPoses& index) : index_(index) {}
  std::vector<int> groups() const override { return {1}; }
  void go(const Vec6& at) override { at_ = index_.domain().point(at); }
  void evaluate(int, double* out) override { *out = -index_.at(drawn_machine(index_), at_); }

 private:
  const IndexOverPoses& index_;
  Box at_;
};

}  // namespace

Met searched(const IndexOverPoses& index, int threads, const std::stop_token& stop, bool roughly) {
  const Domain& domain = index.domain();
  const PosedRobot& machine = domain.machine();
  std::vector<Met> met;
  for (const Box& root : domain.roots()) met.push_back({0.0, domain.nearest(middle_of(root))});
  parallel_for(std::ssize(met), 16, threads, [&](long first, long last) {
    for (auto n = at_index(first); n < at_index(last); ++n) met[n].value = index.at(machine.geometry, met[n].at);
  });
  if (!machine.region.empty() && !stop.stop_requested()) {
    RegionSettings settings{.samples = samples, .threads = threads, .last_step = roughly ? 1e-4 : 1e-9};
    const auto make = [&] { return std::make_unique<LessIndex>(index); };
    try {
      const RegionExtremes ends = region_extremes(machine.region.front(), make, settings, {stop, {}});
      if (!ends.ends[0].empty()) met.push_back({-ends.least(0).value, domain.point(ends.least(0).at)});
    } catch (const Stopped&) {  // what is met at the middles is an answer too
    }
  }
  Met best = *std::ranges::max_element(met, {}, &Met::value);
  const auto here = [&](const Geometry& g) { return index.at(g, best.at); };
  best.value = std::max(best.value, here(worst_machine(domain.machine(), here)));
  return best;
}

namespace {

struct Looked {
  bool proved;
  double met = 0.0;
  int divide = -1;
};

/// Throws unless the box is a part of the domain: boxes may come from a file.
void require_part(const Domain& domain, const Box& box) {
  const bool part = std::ranges::any_of(domain.roots(), [&](const Box& root) {
    if (root.piece != box.piece) return false;
    for (std::size_t k = 0; k < PoseForm::size; ++k)
      if (!(root.low[k] <= box.low[k] && box.low[k] <= box.high[k] && box.high[k] <= root.high[k])) return false;
    return true;
  });
  if (!part) throw InvalidArgument("boxes", "a box of other poses", "boxes that a run of the same machine has left");
}

PoseBoxes rows_of_boxes(const std::vector<Box>& boxes) {
  PoseBoxes out;
  for (const Box& box : boxes) {
    std::array<double, 13> row{static_cast<double>(box.piece)};
    std::copy(box.low.begin(), box.low.end(), row.begin() + 1);
    std::copy(box.high.begin(), box.high.end(), row.begin() + 7);
    out.push_back(row);
  }
  return out;
}

std::vector<Box> boxes_of_rows(const PoseBoxes& rows, const Domain& domain) {
  std::vector<Box> out;
  for (const auto& row : rows) {
    Box box;
    box.piece = std::abs(row[0]) < 1e9 ? static_cast<int>(row[0]) : std::numeric_limits<int>::max();
    std::copy_n(row.begin() + 1, PoseForm::size, box.low.begin());
    std::copy_n(row.begin() + 7, PoseForm::size, box.high.begin());
    require_part(domain, box);
    out.push_back(box);
  }
  return out;
}

/// Boxes of poses against one bound: all that are open in every round.
class WorstSearch : public BoxSearch {
 public:
  WorstSearch(const IndexOverPoses& index, Met from) : met(std::move(from)), index_(index), domain_(index.domain()) {}

  /// The bound is `condition` where that is above what is met, else as far above as `gap`.
  void begin(std::vector<Box> boxes, double gap, double condition) {
    open = {std::move(boxes)};
    leaves.clear();
    stuck.clear();
    given = condition > met.value;
    gap_ = gap;
    target = given ? condition : met.value * (1.0 + gap);
    top_ = met.at;
  }
  Met met;
  double target = 0.0;
  bool given = false;
  double least_there = 0.0;
  std::vector<Box> leaves, stuck;  ///< where the bound is proved, and that cannot be divided

  OpenStack<Box> open;
  std::size_t together() const { return open.size(); }
  bool enough() {
    if (open.size() >= most_boxes) return true;
    if (hopeless(top_, target)) least_there = least_bound(top_, target);
    return least_there > 0.0;
  }
  std::optional<Looked> look(const Box& box, const std::stop_token&) const {
    Moves moves;
    if (domain_.outside(box) || index_.bounded(box, target, moves)) return Looked{true};
    return Looked{false, index_.at(drawn_machine(index_), domain_.nearest(middle_of(box))),
                  divided_coordinate(box, moves.along)};
  }
  void merge(const Box& box, const Looked& seen) {
    ++looked;
    if (seen.met > best_.value) best_ = {seen.met, domain_.nearest(middle_of(box))};
    if (seen.proved) leaves.push_back(box);
    else if (seen.divide < 0) stuck.push_back(box);
    else
      for (const Box& half : halves(box, seen.divide)) open.push(half);
  }
  void end_round() {
    top_ = best_.value > 0.0 ? best_.at : met.at;
    if (best_.value > met.value) {
      met = best_;
      given = given && met.value < target;
      if (!given) target = std::max(target, met.value * (1.0 + gap_));
    }
    best_ = {};
  }
  double value() const { return met.value; }

 private:
  /// No division of poses makes a bound of all machines at one pose less.
  bool hopeless(const Box& point, double bound) const {
    Moves unused;
    return !domain_.built().exact() && !index_.bounded(point, bound, unused);
  }
  double least_bound(const Box& point, double below) const {
    double above = 2.0 * below;
    for (const double most = 1e6 * below; hopeless(point, above); below = std::exchange(above, 2.0 * above))
      if (!(above < most)) return infinity;
    while (above > 1.001 * below) {
      const double between = std::sqrt(above * below);
      (hopeless(point, between) ? below : above) = between;
    }
    return above;
  }

  const IndexOverPoses& index_;
  const Domain& domain_;
  double gap_ = 0.0;
  Box top_;  ///< where a round met most
  Met best_;  ///< of the round
};

}  // namespace

PoseBoxes all_boxes(const Domain& domain) {
  return rows_of_boxes(domain.roots());
}

WorstOverPoses worst(const IndexOverPoses& index, Met met, const ProofSettings& settings, const PoseBoxes& from,
                     const Control& control) {
  const Domain& domain = index.domain();
  std::vector<Box> boxes = from.empty() ? domain.roots() : boxes_of_rows(from, domain);
  const TimeLimit limit(settings.seconds, control.stop);  // the time is for boxes: every run goes on
  WorstOverPoses out;
  double proved = infinity;
  // One bound after another: what is proved for one begins the next, and there always is a bound to return.
  std::vector<double> gaps{1.0, 0.3, 0.1};
  std::erase_if(gaps, [&](double gap) { return gap <= settings.gap; });
  if (!from.empty()) gaps.clear();
  gaps.push_back(settings.gap);
  if (domain.machine().region.empty() && !(settings.condition > 0.0))  // points need no division
    for (const double narrow : {1e-6, 1e-9})
      if (narrow < settings.gap) gaps.push_back(narrow);
  WorstSearch search(index, std::move(met));
  for (const double gap : gaps) {
    search.begin(std::exchange(boxes, {}), gap, gap == gaps.back() ? settings.condition : 0.0);
    bound(search, {limit.stop(), control.progress}, settings.threads, 16);
    if (search.least_there > 0.0) {
      out.tried = search.target;
      break;
    }
    std::vector<Box> left = std::move(search.open);
    left.insert(left.end(), search.stuck.begin(), search.stuck.end());
    if (!left.empty() && gap < settings.gap && !search.given) break;  // narrower than was asked for
    out.tried = search.target;
    if (!left.empty()) {
      boxes = std::move(left);
      break;
    }
    proved = search.target;
    if (gap != gaps.back()) boxes = std::move(search.leaves);
  }
  out.least_there = search.least_there;
  out.extreme = {search.met.value, proved, domain.met(search.met.at), search.looked};
  out.interrupted = control.stop.stop_requested();
  out.left = rows_of_boxes(boxes);
  return out;
}

}  // namespace ninedof::over_region
