#pragma once
/// A proved lower bound of the condition number of all designs that a study allows, at the neutral pose.

#include <limits>
#include <string>
#include <vector>

#include "ninedof/math/control.hpp"
#include "ninedof/problem/problem.hpp"

namespace ninedof {

struct OptimumSettings {
  double target = 0.0;      ///< what is to be proved: no condition number below; more than 1
  int threads = 0;          ///< 0: one for each processor
  long box_limit = 50'000'000;
  double time_limit = 0.0;  ///< seconds; 0 for none
  bool keep_tree = false;   ///< for a certificate: ten bytes for each box
};

struct OptimumProof {
  double lower_bound = 1.0;  ///< proved; the target if `complete`
  bool complete = false;     ///< else the search was stopped by a limit or by the caller
  long boxes = 0;            ///< examined
  long open = 0;             ///< boxes for which less than the target is proved
  /// Where a design below the target was found in the domain of the search, which then ended: its condition number is
  /// no greater. The study need not allow it: the proof takes the radii and the twist of hexagons as independent within
  /// their ranges, and leaves limits out. Else infinite.
  double better = std::numeric_limits<double>::infinity();
  double seconds = 0.0;
  /// Limits of the study that the proof leaves out. The bound holds all the same: for more designs than are allowed.
  std::vector<std::string> left_out;
  std::string certificate;  ///< bytes of a file that ninedof_check reads; empty unless asked for and proved
};

/// Best first: the box of which least is known is cut next, so that the bound rises until the search ends. The result
/// does not depend on the number of threads, unless time ends it.
///
/// Of the family "symmetric_nonplanar" one target after another is proved, depth first; the certificate is of the last.
///
/// Throws InvalidArgument for a study that the theory does not reach: the family "general"; an objective other than the
/// condition number at the neutral pose; of non-planar designs a characteristic length that is no number; sizes without
/// a finite upper bound; a zp that begins at 0 where an internal radius does too or the length is of a kind; a platform
/// that may shrink to a point where nothing bounds the length. Throws std::runtime_error as require_sound_arithmetic
/// does.
OptimumProof prove_optimum(const Problem& study, const OptimumSettings& settings, const Control& control = {});

}  // namespace ninedof
