#include "ninedof/proof/condition_search.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <utility>

#include "math/numbers.hpp"

namespace ninedof {
namespace {

constexpr std::array wide_steps{0.3, 0.1};  // bounds on the way to the gap, relative to what was met
constexpr double rounding = 1e-9;           // of the gap

class ConditionSearch {
 public:
  ConditionSearch(const PosedRobot& machine, const ConditionSettings& settings, ConditionState&& earlier,
                  const std::function<void(const ConditionState&)>& keep, const Control& control)
      : machine_(machine), settings_(settings), keep_(keep), control_(control), state_(std::move(earlier)) {}

  ConditionState run() {
    const PoseBoxes from = std::exchange(state_.left, {});
    const double target = std::exchange(state_.target, infinity);
    state_.left_count = 0;
    state_.interrupted = false;
    if (from.empty() && !(state_.high < infinity)) search_in_time({}, 0.0);
    else if (!from.empty() && state_.low < target) search_in_time(from, target);
    narrow();
    prove();
    if (least_there_ > 0.0 && state_.left_count == 0 && !within_gap()) state_.target = least_there_;
    return std::move(state_);
  }

 private:
  /// Proves lower bounds up to the gap: slices and earlier states end with the bound that they began with.
  void narrow() {
    while (!within_gap()) {
      const PoseBoxes poses = all_poses();
      if (poses.empty() || within_gap()) return;
      double step = settings_.gap;
      for (const double wide : wide_steps)
        if (step == settings_.gap && settings_.gap < wide && wide < 0.9 * (state_.high / state_.low - 1.0)) step = wide;
      // Other poses than the one that was in the way need a little more.
      const double target = std::max(state_.low * (1.0 + step), 1.005 * least_there_);
      if (least_there_ > 0.0 && (!(target < 0.999 * state_.high) || elapsed() > settings_.seconds)) return;
      search_in_time(poses, std::min(target, state_.high));
    }
  }

  /// Proves the bounds that lie inside, or what still counts as keeping them.
  void prove() {
    std::vector<double> wanted = settings_.wanted;
    std::ranges::sort(wanted, std::greater());
    for (const double bound : wanted) {
      const double goal = state_.low < bound ? bound : bound * (1.0 + settings_.tolerance);
      if (!(state_.low < goal && goal < state_.high)) continue;
      if (const PoseBoxes poses = all_poses(); !poses.empty()) search_in_time(poses, goal);
    }
  }

  bool within_gap() const { return state_.high <= state_.low * (1.0 + settings_.gap) * (1.0 + rounding); }

  /// All poses as boxes, after a look at what is met at once; none where a search was interrupted or left boxes.
  PoseBoxes all_poses() {
    if (state_.left_count > 0 || state_.interrupted) return {};
    const double target = state_.target;
    search({}, 0.0, 0.0);  // looks at no box
    PoseBoxes poses = std::exchange(state_.left, {});
    state_.left_count = 0;
    state_.target = target;
    return state_.interrupted ? PoseBoxes{} : poses;
  }

  /// Searches until the time is over, in slices where their states are to be kept.
  void search_in_time(PoseBoxes from, double target) {
    double longest = keep_ ? settings_.slice_seconds : infinity;
    for (;;) {
      const double begin = elapsed();
      const long before = state_.boxes;
      const double seconds = std::max(std::min(settings_.seconds - begin, longest), settings_.least_seconds);
      search(from, target, seconds);
      const double now = elapsed();
      if (state_.left_count == 0 || state_.interrupted || now - begin < seconds || now >= settings_.seconds) {
        if (state_.left_count == 0 || !state_.left.empty() || from.empty()) return;
        state_.left_count = from.size();  // more than a state holds: those that the slice began with
        state_.left = std::move(from);
        state_.target = target;
        return;
      }
      if (keep_ && !state_.left.empty()) {
        keep_(state_);
        // A slice in which nothing was done is too short.
        longest = std::max(longest * (state_.boxes == before ? 2.0 : 1.0), settings_.keep_share * (elapsed() - now));
        from = state_.left;
        target = state_.target;
      } else {
        longest = infinity;  // more boxes than a state holds: once more from where the slice began, and to the end
      }
    }
  }

  void search(const PoseBoxes& from, double target, double seconds) {
    ProofSettings how{.threads = settings_.threads, .seconds = seconds, .gap = settings_.gap, .condition = target};
    // A bound within the gap is tried at once, another after wider ones.
    if (target > 0.0 && state_.low > 0.0) how.gap = std::min(how.gap, target / state_.low - 1.0);
    Control control{control_.stop, {}};
    if (control_.progress)
      control.progress = [&, before = state_.boxes](long done, long total, double value) {
        control_.progress(before + done, total, value);
      };
    WorstOverPoses found = worst_condition(machine_, how, from, control);
    if (state_.low == 0.0 || found.extreme.low > state_.low) {
      state_.low = found.extreme.low;
      state_.at = found.extreme.at;
    }
    state_.high = std::min(state_.high, found.extreme.high);
    state_.boxes += found.extreme.boxes;
    state_.left_count = found.left.size();
    state_.left = state_.left_count <= settings_.most_left ? std::move(found.left) : PoseBoxes{};
    state_.target = found.tried;
    state_.interrupted = found.interrupted;
    least_there_ = std::max(least_there_, found.least_there);
  }

  double elapsed() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }

  using Clock = std::chrono::steady_clock;
  const Clock::time_point start_ = Clock::now();
  const PosedRobot& machine_;
  const ConditionSettings& settings_;
  const std::function<void(const ConditionState&)>& keep_;
  const Control& control_;
  ConditionState state_;
  double least_there_ = 0.0;  ///< no bound below is proved of machines within tolerances; 0 where none was in the way
};

}  // namespace

ConditionState search_condition(const PosedRobot& machine, const ConditionSettings& settings, ConditionState earlier,
                                const std::function<void(const ConditionState&)>& keep, const Control& control) {
  return ConditionSearch(machine, settings, std::move(earlier), keep, control).run();
}

}  // namespace ninedof
