#pragma once
/// A study over a region of poses: a semi-infinite program.
///
///     minimize the worst of the index over the region  subject to  all limits at every pose of it
///
/// Limits and index are imposed at some poses, first at the corners of the region. The design found is searched over
/// all of the region; all its local worsts join, and it is solved again from there. At the end the poses that hold the
/// design are kept.

#include <functional>
#include <optional>

#include "ninedof/domains/region.hpp"
#include "ninedof/optimize/leg_range.hpp"
#include "ninedof/optimize/optimize.hpp"

namespace ninedof {

/// The harmonic mean of an index over a region.
struct RegionMean {
  int nodes = 0;              ///< poses of the quadrature that the optimizer used
  double quadrature = 0.0;    ///< the mean over them
  double value = 0.0;         ///< over other poses, on which the optimizer had no influence
  double error = 0.0;         ///< of the quadrature: its distance from `value`, and two standard errors of that
  double standard_error = 0.0;
};

/// What is known of the best design over the region.
struct RegionReport {
  /// Where limits and index were imposed, behind the poses of the problem; those of a quadrature first, of weight 1.
  std::vector<Pose> poses;
  int rounds = 0;      ///< designs that were searched over the region
  long looked_at = 0;  ///< poses of the last search; 0: a stop came before it
  double objective = 0.0;  ///< the largest value of the index found
  Pose objective_at;
  double margin = std::numeric_limits<double>::infinity();  ///< the least of a limit found, relative
  std::string limit;                                        ///< its name; empty without limits
  /// By how much the objective could still fall, relative, near this design: it cannot be lower than at the poses
  /// imposed, and what passes a limit between them is paid for at its price.
  double gain = std::numeric_limits<double>::infinity();
  std::optional<RegionMean> mean;  ///< where the objective is a mean
  /// Where O is placed at every pose and limits compare poses: the lengths of each leg that O keeps in all of the
  /// region.
  std::optional<LegLimits> leg_ranges;
};

struct RegionResult {
  Result result;  ///< its one candidate has the variables of the problem with the report's poses
  RegionReport region;
};

struct RegionStudySettings : Settings {
  /// Called with words where a round begins, on the thread of the caller.
  std::function<void(const std::string&)> phase = {};
};

/// `problem` may have poses of its own. Where the region places O (Region::placed), that is done anew at every pose, by
/// the worst of index and limits; the optimum with O shifted is found first. Status `optimal`: the design is stationary
/// at its poses, no limit is passed and the index is nowhere larger by more than 1e-7, relative, in a dense search.
/// Ctrl-C and the time limit return the best so far. Throws InvalidArgument for a region or settings that do not fit.
RegionResult optimize_region(const Problem& problem, const Region& region, const RegionStudySettings& settings = {},
                             const Control& control = {});

}  // namespace ninedof
