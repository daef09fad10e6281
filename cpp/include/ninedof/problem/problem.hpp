#pragma once
/// A design problem: a family, bounds of its variables, limits, and an objective to be minimized.

#include <array>
#include <string>
#include <vector>

#include "ninedof/conditioning/characteristic_length.hpp"
#include "ninedof/families/design_family.hpp"
#include "ninedof/limits/limits.hpp"
#include "ninedof/problem/objective.hpp"
#include "ninedof/robot/tool.hpp"

namespace ninedof {

/// Bounds of one variable; low == high fixes it. Either side may be infinite.
struct Bounds {
  double low = 0.0;
  double high = 0.0;
};

/// The characteristic length of a study: a number, a kind (taken at each design's neutral configuration), or free.
struct StudyLength {
  enum class Choice { number, kind, free };
  Choice choice = Choice::number;
  double value = 1.0;                      ///< if a number
  LengthKind kind = LengthKind::mean_leg;  ///< if a kind; `optimal` is a variable that minimizes the objective
  Bounds bounds = {};                      ///< if free
};

struct Problem {
  std::string family = "hexagonal";
  std::vector<Bounds> variables;  ///< in the family's order; lengths in the study's unit, angles in radians
  std::vector<Limit> limits;  ///< axes of cones of the platform in the frame of `geometry`
  StudyLength characteristic_length;
  Objective objective;
  /// What poses, index and limits at poses are about; limits of the design alone, zp, and s at home are of the plates.
  Tool tool;

  /// Throws InvalidArgument naming what is wrong.
  void validate() const;

  /// Reference length for scaling: the characteristic length if it is a number, the geometric mean of its bounds if it
  /// is free, a tenth of the smallest upper bound of a length otherwise.
  double unit() const;

  /// Names of the full set of variables: the family's, "characteristic_length" if it is free or "optimal", and, for
  /// poses whose internal point the optimizer chooses, its offset in fractions of zp ("pose3.s_x", ...).
  std::vector<std::string> names() const;
};

/// The pairs of legs (order of leg_clearance) that may meet, as their joints coincide in every design of a problem.
/// Joints that coincide in one design alone collide.
std::array<bool, 21> exempt_pairs(const Problem& problem);

/// The characteristic length of one design; `variables` is a full set, bounds are not enforced.
double characteristic_length(const Problem& problem, const Eigen::VectorXd& variables);

/// The robot of a design, its platform joints in the tool's frame. Throws InvalidArgument where the variables describe
/// none. Numbers behind the family's are not looked at.
Geometry geometry(const Problem& problem, const Eigen::VectorXd& variables);

/// The neutral configuration and the poses of the objective, for one design, in the tool's frame.
std::vector<Configuration> configurations(const Problem& problem, const Eigen::VectorXd& variables);

}  // namespace ninedof
