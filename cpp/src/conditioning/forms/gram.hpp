#pragma once
/// M^T M of the conditioning matrix as forms over a box of poses. Its eigenvalues are the squares of the singular
/// values of M, so that the condition number is at most K where K^2 M^T M - t and t - M^T M are positive definite for
/// some t.

#include "math/box_share.hpp"
#include "robot/pose_of.hpp"

namespace ninedof::forms {

/// A symmetric matrix: its entries (i, j) with i >= j, row after row.
using Symmetric6 = std::array<PoseForm, 21>;

constexpr std::size_t entry(std::size_t i, std::size_t j) {
  return i >= j ? i * (i + 1) / 2 + j : entry(j, i);
}

/// A symmetric 3 x 3 matrix: its entries as above.
using Symmetric3 = std::array<PoseForm, 6>;

/// What both forms of M^T M begin with: A^T A of the external legs, H = C^T C of the upper, F = B^T B of the lower
/// ones.
struct LegProducts {
  Symmetric6 external;
  Symmetric3 upper, lower;
};
LegProducts leg_products(const Geometry& g, double characteristic_length, const FormPose& pose, Moves& moves);

/// M^T M = A^T A + K^T ((C^T C)^-1 + (B^T B)^-1)^-1 K, with K = [-y x / l_c, 1], y = s - p. The middle matrix is
/// H - H (H + F)^-1 H with H = C^T C and F = B^T B: neither needs to be regular. `moves` is of the directions of the
/// legs.
Symmetric6 gram(const Geometry& g, double characteristic_length, const FormPose& pose, Moves& moves);

/// The matrix at the middle of the box.
Mat6 middle_of(const Symmetric6& g);

/// M^T M between bounds without an inverse: for a number w of three components,
///     x^T M^T M x = min over w of x^T above x + 2 w^T across x + w^T sum w,
/// so that `above` is not below M^T M. `across` vanishes in the middle of the box.
struct SplitGram {
  Symmetric6 above;
  Symmetric6 external;  ///< A^T A, which is not above M^T M
  std::array<std::array<PoseForm, 6>, 3> across;
  Symmetric3 sum;  ///< H + F
  bool known = false;
};
SplitGram split_gram(const Geometry& g, double characteristic_length, const FormPose& pose, Moves& moves);

/// Whether the condition number is proved to be at most K in all of the box.
bool bounded(const SplitGram& g, double condition);

/// Where in a box the condition number is at most K, and where it is not; the box has three coordinates, the first.
struct ConditionSplit {
  bool everywhere = false;  ///< at most K in all of the box
  Slope3 slope{};
  double level = 0.0;  ///< at most K where slope . t >= level; infinite where that is nowhere known
  PoseForm excess;         ///< above K where it is positive
};
ConditionSplit split_by_condition(const SplitGram& g, double condition);

/// The directions of a vector: its change from the middle, with an error that falls with the square of the box.
FormVector direction_of(const FormVector& v);

/// A number that the condition number of some matrix of the form, taken at one pose, is not below.
double condition_attained(const Symmetric6& g);

}  // namespace ninedof::forms
