#pragma once
/// Direct position analysis: nine leg lengths -> every configuration that has them.
///
/// The lower internal legs leave two points for O in the base frame, the upper ones two in the platform frame. For each
/// of these four branches at most eight rotations fit the external legs, so there are at most 32 assembly modes
/// (docs/theory/position.md).

#include "ninedof/position/assembly_modes.hpp"
#include "ninedof/robot/geometry.hpp"

namespace ninedof {

/// Every real assembly mode for lengths l1 l2 l3 q1 q2 q3 r1 r2 r3. Modes satisfy all nine lengths to rounding, with
/// the status tangent to half the digits. The error of a leg much shorter than the robot is larger in proportion,
/// because the equations contain squared lengths.
/// If base and platform are both planar, half the modes are mirror images of the other half.
///
/// The length unit does not matter: in one that is larger or smaller by a power of two the bits are the same, unless a
/// leg is 1e-40 times as long as the robot.
///
/// Throws InvalidArgument unless all lengths are finite, none is negative and one is positive.
AssemblyModes forward_position(const Geometry& g, const Vec9& leg_lengths,
                               RotationMethod method = RotationMethod::automatic);

}  // namespace ninedof
