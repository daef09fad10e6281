#pragma once
/// Is there a least value, is there a design at all? Statuses other than `optimal`, with the variables or constraints behind.

#include "rounds.hpp"

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

/// Sets `result` to unbounded, with causes and reason, if the leaders of all caps show that the index has no least value.
void judge_unbounded(const Problem& problem, const std::vector<Leader>& leaders, Result& result);

/// Sets `result` to infeasible if the bounds hold zp or zs at zero, where 0 < zs < zp (eq. 9b) leaves no design.
bool judge_flat(const Problem& problem, Result& result);

/// No start ended well: infeasible, with the limits in conflict; nothing but singular designs; or just not finished, with the
/// best allowed design.
void explain_failure(const Prepared& p, const Round& round, const Settings& s, const Control& control, Result& result);

}  // namespace ninedof
