#pragma once
/// Optimum design: an index minimized over a design family, as a smooth minimax problem.
///
/// kappa = sigma_max / sigma_min has a kink wherever two singular values meet, and its minimizers lie on such kinks.
/// The form
///     minimize t  subject to  log sigma_i - log sigma_j <= t  for every pair that may be extreme, and the constraints
/// is smooth, and sequential quadratic programming solves it from almost any start (NLopt's SLSQP). Its return code is
/// not used: every end point is checked here.

#include <cstdint>
#include <string>
#include <vector>

#include "ninedof/math/control.hpp"
#include "ninedof/optimize/result.hpp"
#include "ninedof/problem/problem.hpp"

namespace ninedof {

/// How thorough the search is.
struct Settings {
  /// Low-discrepancy starts of one batch. If fewer than 16, and at most half, of those run to their end reach the best
  /// objective, or a feasible design is better than all ends, or fewer than 16 were tried and none led to a design,
  /// further batches follow: `most_batches` in all for each cap of open variables. One start alone is never followed by
  /// others. 0: the warm starts alone, near an optimum.
  int starts = 64;
  static constexpr int most_batches = 4;
  std::uint64_t seed = 0;                  ///< shifts their sequence
  int threads = 0;                         ///< 0: one per processor; the result does not depend on it
  int max_evaluations = 500;               ///< of one SLSQP call; a start makes several where it does not converge
  std::vector<Eigen::VectorXd> warm = {};  ///< additional starts, full sets of variables
  double time_limit = std::numeric_limits<double>::infinity();  ///< seconds; the best so far is returned after it
  bool explain = true;  ///< whether an infeasible result says which limits exclude each other

  /// Throws InvalidArgument naming what is wrong.
  void validate() const;
};

/// Multi-start minimax optimization; `control.progress` gets runs done, runs in all, and the best objective so far. A
/// start is one run, or two where it is run to its end after a short run; runs in all grow where another batch follows.
/// Same problem and settings give the same bits for any number of threads.
Result optimize(const Problem& problem, const Settings& settings = {}, const Control& control = {});

/// The starts that `optimize` would use, one per column.
Eigen::MatrixXd starts(const Problem& problem, const Settings& settings, const std::stop_token& stop = {});

/// Version of the NLopt library in use, "2.7.1".
std::string solver_version();

}  // namespace ninedof
