#pragma once
/// All common points of three quadrics in projective space, each enclosed and proved to be alone, by bisection.

#include <vector>

#include "position/certified/rotation_quadrics.hpp"

namespace ninedof {

/// Quaternions whose component `chart` is 1 and whose others lie in intervals.
struct ChartBox {
  std::size_t chart;
  QuaternionBounds z;
};

/// A proved solution: the only one in `alone`, and it lies in `enclosure`.
struct ProvedRotation {
  ChartBox alone, enclosure;
  std::size_t guess;  ///< the one that led to it; as many as there are guesses if none did
};

/// Every solution lies in a box of `undecided`, or is one of `proved`, which are distinct.
struct ProvedRotations {
  std::vector<ProvedRotation> proved;
  std::vector<ChartBox> undecided;
  long boxes = 0;
};

/// Whether all points of a box lie in another one, whatever their charts.
bool inside(const ChartBox& box, const ChartBox& outer);

/// `guesses` are approximate solutions, unit quaternions. They are tried first, to know which of them a solution is;
/// what is proved does not depend on them.
ProvedRotations proved_rotations(const RotationQuadrics& quadrics, const std::vector<Eigen::Vector4d>& guesses);

}  // namespace ninedof
