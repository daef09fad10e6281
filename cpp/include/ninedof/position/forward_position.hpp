#pragma once
/// Direct position analysis: nine leg lengths -> every configuration that has them.
///
/// O is one of two points over the plane of the lower joints, and one of two over the plane of the upper joints; for each of these
/// four branches at most eight rotations fit the external legs, so there are at most 32 assembly modes.

#include "ninedof/position/assembly_modes.hpp"
#include "ninedof/robot/geometry.hpp"

namespace ninedof {

/// Every real assembly mode for lengths l1 l2 l3 q1 q2 q3 r1 r2 r3. Modes satisfy all nine lengths to rounding; a leg much
/// shorter than the robot to rounding over its share, since a length is the root of what a rotation can be solved for. Where base and platform are each planar, half the modes are mirror images of the other half.
///
/// Throws InvalidArgument unless all lengths are finite, none is negative and one is positive.
AssemblyModes forward_position(const Geometry& g, const Vec9& leg_lengths,
                               RotationMethod method = RotationMethod::automatic);

}  // namespace ninedof
