#pragma once
/// The three 3x3 matrices that can be singular: det H = -det B det C det M / l_c^3.

#include <array>

#include "ninedof/math/types.hpp"
#include "ninedof/robot/configuration.hpp"
#include "ninedof/robot/geometry.hpp"

namespace ninedof {

/// One after the other they give sdot, then the velocity of the platform point at O, then omega.
struct ThreeBlocks {
  Mat3 b;  ///< rows e^_i (31)
  Mat3 c;  ///< rows e~_i (32)
  Mat3 m;  ///< rows w_i x e_i, w_i from O to the platform joint: what turns once O and the platform point at O are held
};
ThreeBlocks three_blocks(const Geometry& g, const Configuration& c);

/// Whether the singular values of a block are apart from 0 by more than rounding; false where it has NaN.
bool regular(const Mat3& block);

/// Signs of det B, det C and det M, 0 where singular: constant along every motion that crosses no singularity.
std::array<int, 3> sides(const ThreeBlocks& blocks);

}  // namespace ninedof
