#pragma once
/// Optimum design: an index made least over a design family, as a smooth minimax problem.
///
/// kappa = sigma_max / sigma_min has a kink wherever two singular values meet, and its minimisers sit on such kinks. Posed as
///     minimise t  subject to  log sigma_i - log sigma_j <= t  for every pair that may rule, and the design's own constraints
/// the problem is smooth, and sequential quadratic programming solves it from almost anywhere (NLopt's SLSQP; its return
/// code is never believed, every answer is checked here).

#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "ninedof/conditioning/characteristic_length.hpp"
#include "ninedof/design/constraints.hpp"
#include "ninedof/design/design.hpp"
#include "ninedof/design/objective.hpp"
#include "ninedof/math/control.hpp"
#include "ninedof/math/error.hpp"

namespace ninedof {

/// Bounds of one variable; low == high fixes it. Either side may be infinite.
struct Bounds {
  double low = 0.0;
  double high = 0.0;
};

/// The characteristic length of a study: a number, a kind (taken at each design's neutral configuration), or free.
struct StudyLength {
  enum class Choice { number, kind, free };
  Choice choice = Choice::number;
  double value = 1.0;                          ///< if a number
  LengthKind kind = LengthKind::mean_leg;  ///< if a kind; `optimal` makes the objective least: see Problem::validate
  Bounds bounds = {};  ///< if free
};

/// A design problem.
struct Problem {
  std::string family = "hexagonal";
  std::vector<Bounds> variables;  ///< in the family's order; lengths in the study's unit, angles in radians
  std::vector<Limit> limits;
  StudyLength characteristic_length;
  Objective objective;

  /// Throws InvalidArgument naming what is wrong.
  void validate() const;

  /// The length variables are measured by where a size matters: the characteristic length if it is a number, the middle of its
  /// bounds if it is free, a tenth of the smallest upper bound of a length otherwise.
  double unit() const;

  /// Names of everything the optimizer may move: the family's variables, "characteristic_length" if it is free or "optimal",
  /// and the place of s, in fractions of zp from its stated place, for poses that leave it to the optimizer
  /// ("pose3.s_x", ...). A full set of variables has one value for each.
  std::vector<std::string> names() const;
};

/// How hard to look.
struct Settings {
  int starts = 64;  ///< low-discrepancy starts
  std::uint64_t seed = 0;  ///< shifts the sequence
  int threads = 0;  ///< 0: one a processor; the answer does not depend on it
  int max_evaluations = 500;  ///< of one SLSQP call; a start that does not settle makes up to four
  std::vector<Eigen::VectorXd> warm = {};  ///< full sets of variables to start from as well

  /// Throws InvalidArgument naming what is wrong.
  void validate() const;
};

/// A local optimum as checked here.
struct Candidate {
  Eigen::VectorXd variables;  ///< a full set
  double objective = std::numeric_limits<double>::infinity();  ///< the number made least
  double condition_number = std::numeric_limits<double>::infinity();  ///< at the neutral configuration, 2-norm
  std::vector<double> conditions;  ///< at each pose looked at, 2-norm
  double characteristic_length = 1.0;
  double optimality_residual = std::numeric_limits<double>::infinity();  ///< see active_set.hpp in src
  double constraint_violation = std::numeric_limits<double>::infinity();  ///< largest negative margin; 0 if none
  std::vector<std::string> active;  ///< variables on a bound and constraints on their limit
  /// Lagrange multipliers in words: per cent by which the objective falls, to first order, when a limit or bound is relaxed
  /// by one per cent. Only of what binds; a bound at zero has no per cent.
  std::map<std::string, double> prices;
  bool singular = true;  ///< at a pose looked at: no machine, whatever the objective
  int reached = 0;  ///< starts that ended at this objective, at this design or one as good

  bool feasible() const { return constraint_violation <= 1e-8; }
  bool regular() const { return !singular; }
  bool stationary() const { return optimality_residual <= 1e-6; }
};

/// What an optimization found.
struct Result {
  Status status = Status::stopped;
  std::string reason;  ///< one sentence for a person
  std::vector<std::string> causes;  ///< variables or constraints behind `unbounded` or `infeasible`
  std::vector<Candidate> candidates;  ///< distinct local optima, best first; empty if nothing acceptable was found
  long evaluations = 0;  ///< designs SLSQP looked at, over all starts and rounds
  int starts_done = 0;
  int stopped_early = 0;  ///< starts given up as hopeless
  int followed = 0;  ///< starts followed to their end in the round that found the best
  bool interrupted = false;  ///< by Control::stop
};

/// Multi-start minimax optimization. Same problem, settings: same bits, whatever the thread count.
Result optimize(const Problem& problem, const Settings& settings = {}, const Control& control = {});

/// Version of the NLopt library in use, "2.7.1".
std::string solver_version();

/// Which objective a single run follows.
enum class Formulation {
  minimax,  ///< the smooth problem above
  plain,  ///< the logarithm of the index itself, as the paper's SQP run did: it jams on the kinks
};

/// One run from one start: the best allowed objective after each evaluation (infinite before the first), and where it ended.
struct Trace {
  std::vector<double> best;
  Candidate end;
};
Trace trace(const Problem& problem, const Eigen::VectorXd& start, Formulation formulation = Formulation::minimax,
            const Settings& settings = {});

/// The starts that `optimize` would use, one a column.
Eigen::MatrixXd starts(const Problem& problem, const Settings& settings);

/// One design looked at closely: `variables` a full set, bounds not enforced.
struct Evaluation {
  double log_objective;
  Eigen::VectorXd gradient;  ///< of log_objective; where singular values tie, that of one of them
  double condition_number;  ///< at the neutral configuration
  std::vector<double> conditions;
  double characteristic_length;
  struct Margin {
    std::string name;
    double value;
    Eigen::VectorXd gradient;
  };
  std::vector<Margin> margins;  ///< the smallest of each constraint
};
Evaluation evaluate(const Problem& problem, const Eigen::VectorXd& variables);

/// The characteristic length of one design.
double characteristic_length(const Problem& problem, const Eigen::VectorXd& variables);

/// The neutral configuration and the poses of the objective, for one design.
std::vector<Configuration> configurations(const Problem& problem, const Eigen::VectorXd& variables);

}  // namespace ninedof
