#pragma once
/// Optimum design: the condition number made least over a design family, as a smooth minimax problem.
///
/// kappa = sigma_max / sigma_min has a kink wherever two singular values meet, and its minimisers sit on such kinks. Posed as
///     minimise alpha - beta  subject to  log sigma_k <= alpha,  log sigma_k >= beta,  and the design's own constraints
/// the problem is smooth, and sequential quadratic programming solves it from almost anywhere (NLopt's SLSQP; its return
/// code is never believed, every answer is checked here).

#include <cstdint>
#include <functional>
#include <limits>
#include <stop_token>
#include <string>
#include <vector>

#include "ninedof/constraints.hpp"
#include "ninedof/design.hpp"
#include "ninedof/error.hpp"

namespace ninedof {

/// Bounds of one variable; low == high fixes it. Either side may be infinite.
struct Bounds {
  double low = 0.0;
  double high = 0.0;
};

/// A design problem.
struct Problem {
  std::string family = "hexagonal";
  std::vector<Bounds> variables;  ///< in the family's order; lengths in the study's unit, angles in radians
  std::vector<Limit> limits;
  double characteristic_length = 1.0;

  /// Throws InvalidArgument naming what is wrong.
  void validate() const;
};

/// How hard to look.
struct Settings {
  int starts = 64;         ///< low-discrepancy starts
  std::uint64_t seed = 0;  ///< shifts the sequence
  int threads = 0;         ///< 0: one a processor; the answer does not depend on it
  int max_evaluations = 500;  ///< of one SLSQP call; a start that does not settle makes up to four

  /// Throws InvalidArgument naming what is wrong.
  void validate() const;
};

/// What a long run listens to and reports.
struct Control {
  std::stop_token stop;
  /// (starts done, starts in all, best condition number so far); called from one thread at a time.
  std::function<void(int, int, double)> progress;
};

/// A local optimum as checked here.
struct Candidate {
  Eigen::VectorXd variables;
  double condition_number = std::numeric_limits<double>::infinity();
  double optimality_residual = std::numeric_limits<double>::infinity();  ///< see active_set.hpp in src
  double constraint_violation = std::numeric_limits<double>::infinity();  ///< largest negative margin; 0 if none
  std::vector<std::string> active;  ///< variables on a bound and constraints on their limit
  int reached = 0;                  ///< starts that ended here

  bool feasible() const { return constraint_violation <= 1e-8; }
  /// Beyond 1e14 a condition number is rounding away from a singular design.
  bool regular() const { return condition_number < 1e14; }
  bool stationary() const { return optimality_residual <= 1e-6; }
};

/// What an optimization found.
struct Result {
  Status status = Status::stopped;
  std::string reason;                ///< one sentence for a person
  std::vector<std::string> causes;   ///< variables or constraints behind `unbounded` or `infeasible`
  std::vector<Candidate> candidates; ///< distinct local optima, best first; empty if nothing acceptable was found
  long evaluations = 0;              ///< designs SLSQP looked at, over all starts and rounds
  int starts_done = 0;
  bool interrupted = false;          ///< by Control::stop
};

/// Multi-start minimax optimization. Same problem, settings: same bits, whatever the thread count.
Result optimize(const Problem& problem, const Settings& settings = {}, const Control& control = {});

/// Version of the NLopt library in use, "2.7.1".
std::string solver_version();

/// Which objective a single run follows.
enum class Formulation {
  minimax,  ///< the smooth problem above
  plain,    ///< log kappa itself, as the paper's SQP run did: it jams on the kinks
};

/// One run from one start: the best feasible condition number after each evaluation (infinite before the first), and where
/// it ended.
struct Trace {
  std::vector<double> best;
  Candidate end;
};
Trace trace(const Problem& problem, const Eigen::VectorXd& start, Formulation formulation = Formulation::minimax,
            const Settings& settings = {});

/// The starts that `optimize` would use, one a column.
Eigen::MatrixXd starts(const Problem& problem, const Settings& settings);

}  // namespace ninedof
