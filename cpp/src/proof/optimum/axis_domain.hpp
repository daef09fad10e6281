#pragma once
/// The designs that a study allows, as a domain in the reduced coordinates.

#include <vector>

#include "ninedof/problem/problem.hpp"
#include "ninedof/proof/optimum.hpp"
#include "proof/optimum/combination.hpp"

namespace ninedof::proof {

/// Contains every design that the study allows and whose condition number is below `target`, and more.
struct AxisDomain {
  Chart chart;
  Box box;
  bool empty = false;  ///< no design that the study allows has a condition number below `target`, by lemma 9 alone
  // In characteristic lengths, or else in the unit of `scale`: distances of the joints from the axis, and heights.
  Interval base_external, base_internal, platform_external, platform_internal, zp, zs;
  Interval scale{1.0};  ///< l_c; begins at 1, or at 0 where nothing is known of it
  Interval share;  ///< zs / zp
  Interval cosine;  ///< of the angle between the first external joints
  Interval radius_ratio;  ///< greatest distance of a base joint over that of a platform joint
  RowLimits limits;  ///< of the legs and, where U / l_c is a coordinate, of the sizes

  /// Whether the box holds no design of the domain.
  bool excludes(const Box& designs) const;
  /// Whether it holds the design of a box that is a point.
  bool contains(const Box& design) const;

  /// In the order of the rows.
  Sizes size_bounds() const { return {base_external, zp, zs, base_internal, platform_internal}; }
  /// Whether l_c is no number.
  bool scaled() const { return scale.hi > 1.0; }
};

AxisDomain axis_domain(const Problem& study, double target, std::vector<std::string>& left_out);

}  // namespace ninedof::proof
