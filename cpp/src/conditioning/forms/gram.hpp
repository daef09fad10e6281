#pragma once
/// M^T M of the conditioning matrix as forms over a box of poses. Its eigenvalues are the squares of the singular
/// values of M, so that the condition number is at most K where K^2 M^T M - t and t - M^T M are positive definite for
/// some t.

#include "math/box_share.hpp"
#include "robot/pose_of.hpp"

namespace ninedof::forms {

/// A symmetric matrix: its entries (i, j) with i >= j, row after row.
template <class T>
using Symmetric6Of = std::array<T, 21>;
using Symmetric6 = Symmetric6Of<PoseForm>;

constexpr std::size_t entry(std::size_t i, std::size_t j) {
  return i >= j ? i * (i + 1) / 2 + j : entry(j, i);
}

/// A symmetric 3 x 3 matrix: its entries as above.
template <class T>
using Symmetric3Of = std::array<T, 6>;
using Symmetric3 = Symmetric3Of<PoseForm>;

/// What both forms of M^T M begin with: A^T A of the external legs, H = C^T C of the upper, F = B^T B of the lower
/// ones.
template <class T>
struct LegProducts {
  Symmetric6Of<T> external;
  Symmetric3Of<T> upper, lower;
};
template <class T, class Robot>
LegProducts<T> leg_products(const Robot& g, double characteristic_length, const PoseOf<T>& pose, Moves& moves);

/// M^T M = A^T A + K^T ((C^T C)^-1 + (B^T B)^-1)^-1 K, with K = [-y x / l_c, 1], y = s - p. The middle matrix is
/// H - H (H + F)^-1 H with H = C^T C and F = B^T B: neither needs to be regular. `moves` is of the directions of the
/// legs.
Symmetric6 gram(const Geometry& g, double characteristic_length, const FormPose& pose, Moves& moves);

/// The matrix at the middle of the box.
template <class T>
Mat6 middle_of(const Symmetric6Of<T>& g) {
  Mat6 out;
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 6; ++j) out(i, j) = g[entry(static_cast<std::size_t>(i), static_cast<std::size_t>(j))].c;
  return out;
}

/// M^T M between bounds without an inverse: for a number w of three components,
///     x^T M^T M x = min over w of x^T above x + 2 w^T across x + w^T sum w,
/// so that `above` is not below M^T M. `across` vanishes in the middle of the box. With an internal leg locked (3 to 8)
/// M is that of conditioning/locked_legs.hpp: w is across the leg, and `above` of a velocity of O that keeps its
/// length. With `across` and `sum` free of the direction of the leg, the least over all w is that over those.
template <class T>
struct SplitGramOf {
  Symmetric6Of<T> above;
  Symmetric6Of<T> external;  ///< A^T A, which is not above M^T M
  std::array<std::array<T, 6>, 3> across;
  Symmetric3Of<T> sum;  ///< H + F
  /// Of curved forms: at least what H and F are taken of, for |x| = 1 and w = 0.
  double upper_reach = 0.0, lower_reach = 0.0;
  bool known = false;
};
using SplitGram = SplitGramOf<PoseForm>;
template <class T, class Robot>
SplitGramOf<T> split_gram(const Robot& g, double characteristic_length, const PoseOf<T>& pose, Moves& moves,
                          int locked = -1);

/// What joints in balls change in the rows of the nine legs: by a vector of at most fixed |x| + moved |w|.
struct Looseness {
  double fixed = 0.0, moved = 0.0;
};
Looseness looseness(const AsBuilt& g, double characteristic_length, const PoseOf<CurvedForm>& pose,
                    const SplitGramOf<CurvedForm>& drawn);

/// Whether the condition number is proved to be at most K in all of the box.
bool bounded(const SplitGramOf<CurvedForm>& g, double condition, const Looseness& loose = {});

/// Where in a box the condition number is at most K, and where it is not: by `cuts` coordinates from `first_cut` on,
/// the first three of a box of poses, which then are all that move, or those of the designs.
template <class T>
struct ConditionSplitOf {
  static constexpr std::size_t first_cut = T::size == PoseForm::size ? 0 : PoseForm::size;
  static constexpr std::size_t cuts = T::size == PoseForm::size ? 3 : T::size - PoseForm::size;
  bool everywhere = false;  ///< at most K in all of the box
  Slope<cuts> slope{};
  double level = 0.0;  ///< at most K where slope . t >= level; infinite where that is nowhere known
  T excess;            ///< above K where it is positive
};
using ConditionSplit = ConditionSplitOf<PoseForm>;
/// The excess alone.
template <class T>
T condition_excess(const SplitGramOf<T>& g, double condition);
template <class T>
ConditionSplitOf<T> split_by_condition(const SplitGramOf<T>& g, double condition);

/// The directions of a vector: its change from the middle, with an error that falls with the square of the box, or
/// with its third power.
template <class T>
Xyz<T> direction_of(const Xyz<T>& v);

/// A number that the condition number of some matrix of the form, taken at one pose, is not below.
double condition_attained(const Symmetric6& g);

}  // namespace ninedof::forms
