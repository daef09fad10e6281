#pragma once
/// Where in a region of poses a design is worst.

#include <array>
#include <string>
#include <vector>

#include "ninedof/domains/region_extremes.hpp"
#include "ninedof/problem/problem.hpp"

namespace ninedof {

/// The numbers of a design that a region is searched for, the worse the lower: minus the logarithm of the index, the
/// length of every leg and its negative, the margins of all limits.
struct RegionNumber {
  static constexpr int index = 0, shortest = 1, longest = 10, first_margin = 19;
};

/// The worst values of one design over a region, each with the coordinates of the pose where it was met (see Region).
struct RegionWorst {
  struct Limit {
    std::string name;
    int row;  ///< of the legs or pairs of legs that the limits have
    double margin;
    Vec6 at;
  };
  struct Index {
    double logarithm;
    Vec6 at;
  };
  /// The ends of several descents for each: of the index, and of every margin, one for each leg or pair of legs.
  std::vector<Index> index;
  std::vector<Limit> limits;
  /// Limits on the spread of lengths compare poses: their margins follow from these.
  std::array<Vec6, 9> longest_at, shortest_at;
  long poses = 0;  ///< looked at
};

/// region_extremes of every margin (descents from those that are small), of the index and of the length of every leg.
/// `problem` has no poses of its own.
///
/// Throws InvalidArgument for a region or variables that do not fit, Stopped on a stop.
RegionWorst search_region(const Problem& problem, const Region& region, const Eigen::VectorXd& variables,
                          const RegionSettings& settings, const Control& control = {});

}  // namespace ninedof
