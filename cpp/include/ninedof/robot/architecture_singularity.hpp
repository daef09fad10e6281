#pragma once
/// Designs that are singular at every pose, and at every position of one orientation (docs/theory/singularity.md).
///
/// A design is singular at every pose exactly if its lower joints lie on one line (det B), its upper joints do (det C),
/// its external joints on the base or those on the platform are in one point, or two external legs coincide at both
/// ends (det N). Geometry refuses these, so that a robot that exists has a distance from each of them.

#include <array>

#include "ninedof/robot/geometry.hpp"

namespace ninedof {

enum class ArchitectureClass { lower_on_line, upper_on_line, base_in_point, platform_in_point, legs_coincide };

/// A class, and how far the design is from its nearest member.
struct ArchitectureSingularity {
  ArchitectureClass kind;
  int leg, other;   ///< of legs_coincide, 0 to 2; else 0
  double distance;  ///< length: the least by which joints must move to get there, the largest move of a joint
  double relative;  ///< over the longest side of the four triangles
};

/// The nearest class; of equal ones the first. Triangles: half the least height to a line, the radius of the least
/// circle about them to a point. Legs: half the larger distance of their ends.
ArchitectureSingularity nearest_architecture_singularity(const Geometry& g);

/// How far the external triangles are from similar and parallel at an orientation, 0 to 1: the least |r - c - l Q u|
/// over centres c and factors l, root mean square over that of r about its centre. At 0 all positions are singular
/// (det N = 0), wherever O is.
double homothety_residual(const Geometry& g, const Mat3& rotation);

/// The orientations with the least such residual: with a factor l > 0 and with l < 0, half a turn from each other. Not
/// the only ones if both triples lie on lines.
struct SimilarTriangles {
  double dissimilarity;  ///< the residual there, 0 for similar triangles
  std::array<Mat3, 2> rotations;
};
SimilarTriangles similar_triangles(const Geometry& g);

}  // namespace ninedof
