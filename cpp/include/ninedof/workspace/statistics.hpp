#pragma once
/// Indices over a workspace: the poses and weights of its cells, and the statistics of values at them.

#include <span>

#include "ninedof/workspace/workspace.hpp"

namespace ninedof {

/// The poses at the centres of cells of which a part is allowed, or of the allowed points of a sample.
struct WorkspacePoses {
  std::vector<Vec3> coordinates;  ///< of the map
  std::vector<Configuration> configurations;
  std::vector<double> weights;  ///< allowed volume; of equal points of a sample its density
  std::vector<std::uint8_t> inner;  ///< 1 where at least half of the cell is allowed
  std::size_t size() const { return coordinates.size(); }
};

/// The poses of a map of `domain`, with O by a rule that is a formula; of piece 0, or of all.
/// Throws InvalidArgument for sets of rotations and for the best O: a cell of theirs has no single pose.
WorkspacePoses poses_of(const Geometry& g, const WorkspaceDomain& domain, const InternalPointRule& rule,
                        const WorkspaceMap& map, bool first_piece_alone);

/// NaN without a pose where the value is known.
struct IndexStatistics {
  double mean = std::numeric_limits<double>::quiet_NaN();
  double least = mean, greatest = mean;
  Vec3 least_at = Vec3::Constant(mean), greatest_at = least_at;  ///< coordinates of the map
};

/// The mean of an index by volume, its least and its greatest value over inner poses, the first where several have it.
/// `values` has one number for each pose; NaN does not count. With `by_modulus` the extremes are those of |value|.
/// Throws InvalidArgument for another number of values.
IndexStatistics statistics_of(const WorkspacePoses& poses, std::span<const double> values, bool by_modulus);

}  // namespace ninedof
