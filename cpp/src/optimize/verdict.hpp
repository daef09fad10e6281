#pragma once
/// Is there a least value, is there a design at all? Statuses other than `optimal`, with the variables or constraints behind.

#include "optimize/rounds.hpp"

namespace ninedof {

/// The sizes to which variables without a serious upper bound are let run, one round each; a single one, which does not
/// matter, where every variable has one.
std::vector<double> caps(const Problem& p);

/// The best design of a round, and whether it has run to a cap of ours.
struct Leader {
  double cap;
  Candidate best;
  bool at_cap;
};
Leader leader(const Prepared& p, double cap, const Candidate& best);

/// Sets `result` to unbounded, with causes and reason, if the leaders of all caps show that the index has no least value; to
/// stopped if the last one stands on its cap and they do not.
void judge_unbounded(const Problem& problem, std::vector<Leader> leaders, Result& result);

/// Sets `result` to infeasible if 0 < zs < zp (eq. 9b) plainly leaves no design: a height held at zero, zs_fraction at 1 or more.
bool judge_order(const Problem& problem, Result& result);

/// No start ended well: infeasible, with the limits in conflict; nothing but singular designs; or just not finished, with the
/// best allowed design.
void explain_failure(const Prepared& p, const Round& round, const Settings& s, const Control& control, Result& result);

}  // namespace ninedof
