#pragma once
/// The last digits of an assembly mode near a singularity, where rounding in the equations of O and of the rotation
/// costs as many as the mode is close to it.

#include "ninedof/robot/configuration.hpp"
#include "ninedof/robot/geometry.hpp"

namespace ninedof {

/// Moves a mode to where it has the lengths, these and the joints taken for exact: by Newton's method on the squared
/// lengths, which are compared in twice the precision. `separation` is that of AssemblyMode and follows. Nothing
/// changes where the mode's error is small anyway: `error`, a bound of that of O relative to the longest leg, and
/// rounding, over the separation; and where the first step is far longer than that, or the steps do not shrink at once,
/// as at a double mode.
void sharpen(const Geometry& g, const Vec9& leg_lengths, double error, Configuration& mode, double& separation);

}  // namespace ninedof
