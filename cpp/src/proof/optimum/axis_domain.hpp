#pragma once
/// The designs that a study allows, as a domain in the reduced coordinates.

#include <vector>

#include "ninedof/problem/problem.hpp"
#include "ninedof/proof/optimum.hpp"
#include "proof/optimum/axis_rows.hpp"

namespace ninedof::proof {

/// Contains every design that the study allows and whose condition number is below `target`, and more.
struct AxisDomain {
  std::size_t dimension = hexagonal_coordinates;
  Box box;
  bool empty = false;  ///< no design that the study allows has a condition number below `target`, by lemma 9 alone
  // In characteristic lengths: distances of the joints from the axis, and heights.
  Interval base_external, base_internal, platform_external, platform_internal, zp, zs;
  Interval share;  ///< zs / zp
  Interval cosine;  ///< of the angle between the first external joints
  Interval radius_ratio;  ///< greatest distance of a base joint over that of a platform joint
  double log_leg_ratio;   ///< at least the logarithm of the limit; infinite without one

  /// Whether the box holds no design of the domain.
  bool excludes(const Box& designs) const;
  /// Whether it holds the design of a box that is a point.
  bool contains(const Box& design) const;
};

AxisDomain axis_domain(const Problem& study, double target, std::vector<std::string>& left_out);

}  // namespace ninedof::proof
