#pragma once
/// A design over a region of poses with O placed anew at every pose.

#include <functional>
#include <string>
#include <vector>

#include "ninedof/optimize/leg_range.hpp"
#include "ninedof/optimize/region_search.hpp"

namespace ninedof {

/// What the placing of O has to reach at every pose.
struct PlacementGoal {
  double log_index = 0.0;
  std::vector<LegRange> ranges;
};

/// A pose of a region that holds O (`shifted` is false), by its coordinates, with O: the shift of s from its neutral
/// position in zp.
struct Placed {
  Vec6 at = Vec6::Zero();
  Vec3 shift = Vec3::Zero();
};

/// Where a design is worst although O is placed.
struct PlacedEnd {
  Placed placed;
  double excess;  ///< the largest of the logarithm of the index less the goal and of the negative margins
  double log_index;
  double margin;      ///< the least of a limit or range
  std::string limit;  ///< its name; empty without any
};

struct PlacedWorst {
  /// The ends of an ascent from each of the given poses, in their order, then of ascents from the worst samples.
  std::vector<PlacedEnd> ends;
  std::vector<double> at_known;  ///< the excess at each of the given poses
  long poses = 0;  ///< looked at
};

/// At each of many poses of a region, O is placed where the worst of the index and of all limits is least, and left
/// there as soon as nothing is near its limit; from the poses that come out worst an ascent leads to a local worst.
///
/// `problem` has no poses of its own. `known`: poses with an O that is good there; searches begin from the nearest.
/// O stays between the plates and within zp of its neutral position along each axis, as in listed poses.
/// Throws InvalidArgument for a region or variables that do not fit, Stopped on a stop.
PlacedWorst search_region_placed(const Problem& problem, const Region& region, const Eigen::VectorXd& variables,
                                 const PlacementGoal& goal, const std::vector<Placed>& known,
                                 const RegionSettings& settings, const Control& control = {});

/// Places O at one pose of a region after another, by their coordinates: where the worst of the index and of all limits
/// is least. From O shifted and held, and from the shifts `known` where both leave something passed. For one thread.
std::function<PlacedEnd(const Vec6& at)> placer(const Problem& problem, const Region& region,
                                                const Eigen::VectorXd& variables, const PlacementGoal& goal,
                                                const std::vector<Vec3>& known);

/// The same at given poses.
std::vector<PlacedEnd> place_in_region(const Problem& problem, const Region& region, const Eigen::VectorXd& variables,
                                       const PlacementGoal& goal, const std::vector<Vec3>& known,
                                       const std::vector<Vec6>& at, int threads = 0, const Control& control = {});

/// The index less the goal's (a row for each ratio it is the largest of, in logarithms), all limits of single poses (as
/// negative margins), what passes the goal's ranges (of each leg first above, then below), and bounds of O, with O at
/// given places; and their derivatives with respect to the shift of O in zp.
struct PlacedRows {
  Eigen::VectorXd value;
  Eigen::Matrix<double, Eigen::Dynamic, 3> by_shift;
  int of_index = 0;        ///< how many of the first rows are of the index
  int first_of_range = 0;  ///< where the 18 rows of each range begin
};
std::vector<PlacedRows> placed_rows(const Problem& problem, const Region& region, const Eigen::VectorXd& variables,
                                    const PlacementGoal& goal, const std::vector<Placed>& places, int threads = 0,
                                    const Control& control = {});

/// A design with O at each of some poses.
struct PlacedDesign {
  Eigen::VectorXd variables;  ///< a full set of the problem without poses
  std::vector<Vec3> shifts;
  double log_objective = 0.0;
  double violation = 0.0;  ///< the largest of a limit; below zero: to spare
};

struct PlacedSettings {
  int starts = 64;  ///< low-discrepancy designs, after the given ones
  std::uint64_t seed = 0;
  int threads = 0;  ///< 0: one per processor
};

/// Minimizes the worst index over the poses of a problem, with its limits, from given designs and others. Where O is to
/// be placed, that is done for every design anew, and its shift is no variable: the time grows with the number of poses
/// only linearly. Ends are optima up to about 1e-6, and not checked.
std::vector<PlacedDesign> optimize_placed(const Problem& problem, const std::vector<PlacedDesign>& given,
                                          const PlacedSettings& settings, const Control& control = {});

}  // namespace ninedof
