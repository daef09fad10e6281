#pragma once
/// Many starts at once, and which of their ends count.

#include <memory>
#include <mutex>
#include <optional>

#include "math/numbers.hpp"
#include "optimize/minimax/minimax.hpp"

namespace ninedof {

/// Runs of one round, empty where one was not begun, and what they cost.
struct Round {
  std::vector<std::unique_ptr<Run>> runs;
  std::size_t from_starts = 0;  ///< how many of them are starts; the others try again from ends
  long evaluations = 0;
  int done = 0;           ///< starts tried
  int stopped_early = 0;  ///< of those, given up as hopeless
};

/// Counts finished starts over all rounds and passes on what is new, one caller at a time.
class Progress {
 public:
  Progress(const Control& control, int total) : control_(control), total_(total) {}
  void finished(const Candidate& c) {
    const std::lock_guard lock(guard_);
    ++done_;
    if (c.feasible()) best_ = std::min(best_, c.objective);
    if (control_.progress) control_.progress(done_, total_, best_);
  }

 private:
  const Control& control_;
  std::mutex guard_;
  int total_, done_ = 0;
  double best_ = infinity;
};

/// Starts of one round: a design without free variables is looked at once.
int start_count(const Prepared& p, const Settings& s);

/// Start `index` in solver coordinates: the warm ones first.
Eigen::VectorXd start_at(const Prepared& p, const Settings& s, int index);

/// All starts; where they do not agree, some more from recombined ends. The same bits for any number of threads.
/// `further` starts, in full variables, are tried as well and not counted.
Round run_round(const Prepared& p, double cap, const std::vector<Eigen::VectorXd>& further, const Settings& s,
                const Control& control, Progress& progress);

/// Distinct acceptable ends, best first: within the limits, stationary, regular, and on no cut of ours.
std::vector<Candidate> distinct(const Prepared& p, const Round& round);

/// The best end that is within the limits and regular, checked for nothing more: what there is when none is acceptable.
std::optional<Candidate> best_allowed(const Round& round);

}  // namespace ninedof
