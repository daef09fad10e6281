#pragma once
/// Whether a least value exists, and whether a design exists: statuses other than `optimal`, with their causes.

#include "optimize/search_round.hpp"

namespace ninedof {

/// The largest sizes of variables without an effective upper bound, one round each; a single one where all have bounds.
std::vector<double> size_limits(const Problem& p);

/// The best design of a round, and whether it has reached the size limit.
struct RoundBest {
  double size_limit;
  Candidate best;
  bool at_size_limit;
};
RoundBest round_best(const PreparedProblem& p, double size_limit, const Candidate& best);

/// Sets `result` to unbounded, with causes and reason, if the best designs of all rounds show that the index has no
/// least value; to stopped if the last one has reached its size limit and they do not.
void detect_unbounded(const Problem& problem, std::vector<RoundBest> rounds, Result& result);

/// Sets `result` to infeasible, and returns true, if 0 < zs < zp (eq. 9b) excludes every design.
bool detect_impossible_heights(const Problem& problem, Result& result);

/// Where no start ended well: infeasible, with the limits in conflict; singular only; or not converged, with the best.
void explain_failure(const PreparedProblem& p, const SearchRound& round, const Settings& s, const Control& control,
                     Result& result);

}  // namespace ninedof
