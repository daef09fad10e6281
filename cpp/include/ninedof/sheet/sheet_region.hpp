#pragma once
/// The sheet of a machine over a region: the poses at which its numbers are worst.

#include <functional>
#include <vector>

#include "ninedof/domains/region_extremes.hpp"
#include "ninedof/sheet/sheet_numbers.hpp"

namespace ninedof {

/// The configuration at coordinates of a region, O placed anew at each.
using PlacedAt = std::function<Configuration(const Vec6&)>;

struct SheetRegion {
  std::vector<Vec6> worst;  ///< poses, each once
  long poses = 0;           ///< looked at
  /// Of the condition number over half as many even poses; the standard error is that of eight parts of them.
  double mean = 0.0, mean_error = 0.0;
};

/// region_extremes of every number, and the corners of the region from which a singularity is nearest.
///
/// `placing`: none, or what gives every thread its own way to place O. Then descents follow the lengths of the legs
/// alone, those of the external legs without placing O, and the other numbers are the worst of the sample: placing
/// takes a thousand times as long as the rest. Throws as region_extremes does.
SheetRegion sheet_over_region(const SheetQuestion& question, const Region& region, const RegionSettings& settings,
                              const std::function<PlacedAt()>& placing = {}, const Control& control = {});

/// The shortest and the longest lengths of the legs over a region that says where O is.
std::array<Vec9, 2> leg_lengths_over(const Geometry& g, const Configuration& neutral, const Region& region,
                                     const RegionSettings& settings, const Control& control = {});

}  // namespace ninedof
