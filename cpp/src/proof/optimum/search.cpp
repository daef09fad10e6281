/// The search for designs below the target. Declared in ninedof/proof/optimum.hpp.

#include <algorithm>
#include <chrono>
#include <optional>

#include "domains/bound.hpp"
#include "limits/rows.hpp"
#include "math/numbers.hpp"
#include "math/time_limit.hpp"
#include "ninedof/math/error.hpp"
#include "ninedof/proof/bounds.hpp"
#include "ninedof/proof/optimum.hpp"
#include "proof/nonplanar/line_search.hpp"
#include "proof/optimum/axis_domain.hpp"
#include "proof/optimum/box_bound.hpp"
#include "proof/optimum/certificate.hpp"
#include "proof/optimum/proof_tree.hpp"

namespace ninedof {
namespace proof {
namespace {

/// A box for which the target is not proved, or not yet.
struct Open {
  Box box;
  double bound;
  std::uint32_t node;
};

/// Open boxes by what is proved of them, in steps from 1 to the target; within a step, the last one first.
class Heap {
 public:
  using value_type = Open;
  explicit Heap(double target) : target_(target), steps_(256) {}

  bool empty() const { return count_ == 0; }
  std::size_t size() const { return count_; }

  void push(const Open& box) {
    const double part = (box.bound - 1.0) / (target_ - 1.0) * static_cast<double>(steps_.size());
    const auto step = static_cast<std::size_t>(std::clamp(part, 0.0, static_cast<double>(steps_.size() - 1)));
    steps_[step].push_back(box);
    ++count_;
  }
  void take(std::size_t most, std::vector<Open>& round) {
    while (round.size() < most && !empty()) round.push_back(pop());
  }
  /// One of which least is known; one of which most is known where there are so many that memory runs out.
  Open pop() {
    constexpr std::size_t many = 2'000'000;
    const auto filled = [](const std::vector<Open>& step) { return !step.empty(); };
    std::vector<Open>& step = count_ < many ? *std::ranges::find_if(steps_, filled)
                                            : *std::ranges::find_if(steps_.rbegin(), steps_.rend(), filled);
    const Open out = step.back();
    step.pop_back();
    --count_;
    return out;
  }
  /// What is proved of all of them.
  double bound() const {
    for (const std::vector<Open>& step : steps_) {
      if (step.empty()) continue;
      return std::ranges::min_element(step, {}, &Open::bound)->bound;
    }
    return target_;
  }

 private:
  double target_;
  std::vector<std::vector<Open>> steps_;
  std::size_t count_ = 0;
};

/// Of the family "symmetric"; "symmetric_nonplanar" has four heights after them.
constexpr std::ptrdiff_t planar_variables = 9;

BoxBound excluded_by_domain() {
  BoxBound out;
  out.condition_number = infinity;
  out.reason = Reason::domain;
  return out;
}

// Below these, a byte is the coordinate of a cut.
constexpr std::uint8_t outside = 16, by_ranges = 17, by_combination = 18, by_limits = 19;

Bytes reason_of(const BoxBound& found) {
  if (found.reason == Reason::domain) return {outside};
  if (found.reason == Reason::ranges) return {by_ranges};
  const Combination& by = found.combination;
  Bytes out{by.limited() ? by_limits : by_combination};
  append(out, by.max);
  append(out, by.min);
  if (!by.limited()) return out;
  unsigned which = 0;
  for (std::size_t i = 0; i < by.limits.size(); ++i) which |= (by.limits[i] != 0.0F ? 1U : 0U) << i;
  out.push_back(static_cast<std::uint8_t>(which));
  for (const float weight : by.limits)
    if (weight != 0.0F) append(out, weight);
  return out;
}

class Search : public BoxSearch {
 public:
  Search(const AxisDomain& domain, const OptimumSettings& settings)
      : open(settings.target), domain_(domain), settings_(settings) {
    open.push({domain_.box, 1.0, 0});
    if (settings.keep_tree) tree_.emplace();
  }
  std::vector<std::uint8_t> tree() const { return tree_->bytes(); }

  Heap open;
  double better = infinity;
  std::size_t together() const { return 1024; }
  bool enough() const { return better < infinity || looked >= settings_.box_limit; }
  std::optional<BoxBound> look(const Open& one, const std::stop_token&) const {
    if (domain_.excludes(one.box)) return excluded_by_domain();
    return bound_box(one.box, domain_.chart, settings_.target, domain_.limits);
  }
  /// Cuts a box that remains.
  void merge(const Open& one, const BoxBound& seen) {
    ++looked;
    if (seen.condition_number >= settings_.target) {
      if (tree_) tree_->close(one.node, reason_of(seen));
      return;
    }
    if (seen.at_middle < std::min(better, settings_.target) && domain_.contains(middle_of(one.box, domain_.chart)))
      better = seen.at_middle;
    const double bound = std::max(one.bound, seen.condition_number);
    const double m = middle_of(one.box, seen.cut);
    const std::uint32_t first = tree_ ? tree_->cut(one.node, {static_cast<std::uint8_t>(seen.cut)}) : 0;
    for (std::uint32_t side : {0U, 1U}) {
      Open half{one.box, bound, first + side};
      (side == 0 ? half.box[seen.cut].hi : half.box[seen.cut].lo) = m;
      settle(half.box, domain_.chart);
      open.push(half);
    }
  }
  double value() const { return open.bound(); }

 private:
  const AxisDomain& domain_;
  const OptimumSettings& settings_;
  std::optional<ProofTree> tree_;
};

}  // namespace
}  // namespace proof

OptimumProof prove_optimum(const Problem& study, const OptimumSettings& settings, const Control& control) {
  using namespace proof;
  require_sound_arithmetic();
  if (!(settings.target > 1.0) || !std::isfinite(settings.target))
    throw InvalidArgument("target", format_number(settings.target), "a finite number above 1");
  study.validate();
  if (study.family == "symmetric_nonplanar") {
    const auto flat = [](const Bounds& height) { return height.low == 0.0 && height.high == 0.0; };
    if (!std::all_of(study.variables.begin() + planar_variables, study.variables.end(), flat))
      return prove_nonplanar(study, settings, control);
    Problem planar = study;
    planar.family = "symmetric";
    planar.variables.resize(planar_variables);
    std::erase_if(planar.limits, [](const Limit& limit) { return limit_row(limit.name).design == &joint_height_row; });
    return prove_optimum(planar, settings, control);
  }
  OptimumProof out;
  const AxisDomain domain = axis_domain(study, settings.target, out.left_out);
  if (domain.empty) {  // nothing to be searched
    out.lower_bound = settings.target;
    out.complete = true;
    ProofTree nothing;
    nothing.close(0, {outside});
    if (settings.keep_tree) out.certificate = certificate(study, settings.target, out.left_out, nothing.bytes());
    return out;
  }
  const auto start = std::chrono::steady_clock::now();
  const TimeLimit limit(settings.time_limit > 0.0 ? settings.time_limit : infinity, control.stop);
  Search search(domain, settings);
  bound(search, {limit.stop(), control.progress}, settings.threads, 64);
  out.boxes = search.looked;
  out.better = search.better;
  out.complete = search.open.empty();
  out.lower_bound = std::min(search.open.bound(), settings.target);
  out.open = static_cast<long>(search.open.size());
  out.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  if (out.complete && settings.keep_tree)
    out.certificate = certificate(study, settings.target, out.left_out, search.tree());
  return out;
}

}  // namespace ninedof
