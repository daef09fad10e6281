#pragma once
/// Where in a region of poses a design is worst.

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "ninedof/math/control.hpp"
#include "ninedof/problem/problem.hpp"
#include "ninedof/problem/region.hpp"

namespace ninedof {

struct RegionSettings {
  long samples = 100'000;
  std::uint64_t seed = 0;
  int threads = 0;  ///< 0: one per processor
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

/// Evaluates a low-discrepancy sample of the region, a good part of it on the boundary, and descends from the worst
/// samples of every margin that is small, of the index and of every leg. `problem` has no poses of its own.
///
/// Throws InvalidArgument for a region or variables that do not fit, Stopped on a stop.
RegionWorst search_region(const Problem& problem, const Region& region, const Eigen::VectorXd& variables,
                          const RegionSettings& settings, const Control& control = {});

}  // namespace ninedof
