#pragma once
/// Many starts under one size limit, in batches, and which of their end points count.

#include <algorithm>
#include <memory>
#include <mutex>
#include <optional>

#include "math/numbers.hpp"
#include "ninedof/optimize/optimize.hpp"
#include "optimize/minimax/local_run.hpp"

namespace ninedof {

/// The runs of one round, empty where one did not begin, and their cost.
struct SearchRound {
  std::vector<std::unique_ptr<LocalRun>> runs;
  std::vector<bool> from_start;  ///< of each run: whether it began at a start, or continues from end points
  int batches = 0;
  int recombined = 0;  ///< runs from recombined end points
  long evaluations = 0;
  int done = 0;            ///< starts tried
  int warm = 0;            ///< of those, warm ones: the first runs
  int runs_abandoned = 0;  ///< of those, given up after a short run
};

/// Counts finished starts over all rounds and reports them, one caller at a time.
class Progress {
 public:
  Progress(const Control& control, int total) : control_(control), total_(total) {}
  /// Counts starts that were not foreseen.
  void expect(int more) {
    const std::lock_guard lock(guard_);
    total_ += more;
  }
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

/// Starts of the first batch, warm ones included; a design without free variables is evaluated once.
int start_count(const PreparedProblem& p, const Settings& s);

/// Runs the next batch of starts and, where they do not agree, some more from recombined end points. The same bits for
/// any number of threads. `further` starts, in full variables, are run with the first batch and not counted.
void run_batch(const PreparedProblem& p, double size_limit, const std::vector<Eigen::VectorXd>& further,
               const Settings& s, const Control& control, Progress& progress, SearchRound& round);

/// Whether more starts are worth it: fewer than 16, and at most half, of those run to their end reached the best of
/// `candidates`, or a feasible design is better than all of them; or fewer than 16 were tried and
/// none led to a design.
bool starts_disagree(const SearchRound& round, const std::vector<Candidate>& candidates);

/// Whether a variable accepted by `counts` is within `near` of an internal bound, in solver coordinates.
template <class Counts>
bool near_internal_bound(const Coordinates& c, const Eigen::VectorXd& x, double near, const Counts& counts) {
  const Eigen::VectorXd y = c.coordinates(x);
  for (int k = 0; k < c.size(); ++k) {
    if (!counts(c.info(k))) continue;
    if (c.internal_low(k) && y[k] - c.low()[k] < near) return true;
    if (c.internal_high(k) && c.high()[k] - y[k] < near) return true;
  }
  return false;
}

/// Relative gain by which a feasible design that is not stationary puts the best optimum in doubt.
constexpr double noticeable_gain = 1e-6;

/// Distinct acceptable end points, best first: feasible, stationary, regular, and on no internal bound.
std::vector<Candidate> distinct_candidates(const PreparedProblem& p, const SearchRound& round);

/// Takes the warm starts from Candidate::reached: one that ends where it began is no evidence.
void discount_warm(const PreparedProblem& p, const SearchRound& round, std::vector<Candidate>& candidates);

/// The best end point that is feasible and regular, stationary or not.
std::optional<Candidate> best_feasible(const SearchRound& round);

}  // namespace ninedof
