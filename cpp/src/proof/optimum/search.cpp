/// The search for designs below the target. Declared in ninedof/proof/optimum.hpp.

#include <algorithm>
#include <chrono>
#include <optional>

#include "limits/rows.hpp"
#include "math/numbers.hpp"
#include "ninedof/math/error.hpp"
#include "ninedof/math/parallel.hpp"
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
  explicit Heap(double target) : target_(target), steps_(256) {}

  bool empty() const { return count_ == 0; }
  std::size_t size() const { return count_; }

  void push(const Open& box) {
    const double part = (box.bound - 1.0) / (target_ - 1.0) * static_cast<double>(steps_.size());
    const auto step = static_cast<std::size_t>(std::clamp(part, 0.0, static_cast<double>(steps_.size() - 1)));
    steps_[step].push_back(box);
    ++count_;
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

class Search {
 public:
  Search(const AxisDomain& domain, const OptimumSettings& settings)
      : domain_(domain), settings_(settings), open_(settings.target) {
    open_.push({domain.box, 1.0, 0});
    if (settings.keep_tree) tree_.emplace();
  }

  void run(const Control& control, OptimumProof& out) {
    using Clock = std::chrono::steady_clock;
    const auto start = Clock::now();
    const auto seconds = [&] { return std::chrono::duration<double>(Clock::now() - start).count(); };
    while (!open_.empty() && better_ == infinity && out.boxes < settings_.box_limit && !control.stop.stop_requested() &&
           !(settings_.time_limit > 0.0 && seconds() > settings_.time_limit)) {
      round();
      out.boxes += static_cast<long>(batch_.size());
      if (control.progress) control.progress(out.boxes, 0, open_.bound());
    }
    out.complete = open_.empty();
    out.lower_bound = std::min(open_.bound(), settings_.target);
    out.open = static_cast<long>(open_.size());
    out.better = better_;
    out.seconds = seconds();
  }

  std::vector<std::uint8_t> tree() const { return tree_->bytes(); }

 private:
  /// Bounds the boxes of which least is known, and cuts those that remain. A fixed number at a time: the tree does not
  /// depend on the number of threads.
  void round() {
    constexpr std::size_t at_a_time = 1024;
    batch_.clear();
    while (batch_.size() < at_a_time && !open_.empty()) batch_.push_back(open_.pop());
    found_.resize(batch_.size());
    parallel_for(static_cast<long>(batch_.size()), 64, settings_.threads, [&](long first, long last) {
      for (auto i = static_cast<std::size_t>(first); i < static_cast<std::size_t>(last); ++i) {
        if (domain_.excludes(batch_[i].box)) found_[i] = excluded_by_domain();
        else found_[i] = bound_box(batch_[i].box, domain_.dimension, settings_.target, domain_.log_leg_ratio);
      }
    });
    for (std::size_t i = 0; i < batch_.size(); ++i) {
      if (found_[i].condition_number >= settings_.target) {
        if (tree_) tree_->close(batch_[i].node, found_[i]);
        continue;
      }
      if (found_[i].at_middle < std::min(better_, settings_.target) && domain_.contains(middle_of(batch_[i].box)))
        better_ = found_[i].at_middle;
      const double bound = std::max(batch_[i].bound, found_[i].condition_number);
      const std::size_t k = found_[i].cut;
      const double m = middle_of(batch_[i].box, k);
      const std::uint32_t first = tree_ ? tree_->cut(batch_[i].node, k) : 0;
      for (std::uint32_t side : {0U, 1U}) {
        Open half{batch_[i].box, bound, first + side};
        (side == 0 ? half.box[k].hi : half.box[k].lo) = m;
        if (domain_.dimension == hexagonal_coordinates) half.box[at_lower] = half.box[at_ratio];
        open_.push(half);
      }
    }
  }

  const AxisDomain& domain_;
  const OptimumSettings& settings_;
  Heap open_;
  std::optional<ProofTree> tree_;
  double better_ = infinity;
  std::vector<Open> batch_;
  std::vector<BoxBound> found_;
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
    nothing.close(0, excluded_by_domain());
    if (settings.keep_tree) out.certificate = certificate(study, settings.target, out.left_out, nothing.bytes());
    return out;
  }
  Search search(domain, settings);
  search.run(control, out);
  if (out.complete && settings.keep_tree)
    out.certificate = certificate(study, settings.target, out.left_out, search.tree());
  return out;
}

}  // namespace ninedof
