#pragma once
/// One index over many configurations of a robot.
///
/// The numbers agree with those of the functions of one configuration to rounding, and singular, NaN and badly conditioned
/// configurations get exactly those functions' answers. A number depends on its own configuration alone: not on its
/// neighbours, on the processor's instruction set or on how a caller cuts his data for threads.
///
/// Nothing here starts a thread; parallel.hpp does.

#include "ninedof/conditioning/conditioning.hpp"
#include "ninedof/robot/geometry.hpp"

namespace ninedof::batch {

/// Configurations in the caller's memory. The k-th has its position (3 numbers) at position + k * position_step, its rotation
/// (9, row-major) and its internal point (3) likewise; a step of 0 gives all of them the same.
struct Configurations {
  const double* position = nullptr;
  const double* rotation = nullptr;
  const double* internal_point = nullptr;
  long count = 0;
  long position_step = 3, rotation_step = 9, internal_point_step = 3;
};

/// Characteristic lengths, likewise: one for all (step 0) or one each (step 1).
struct Lengths {
  const double* value = nullptr;
  long step = 0;
};

/// l1 l2 l3 q1 q2 q3 r1 r2 r3 of each: 9 numbers a configuration.
void leg_lengths(const Geometry& g, const Configurations& c, double* out);

/// Condition number of J': 1 number a configuration. Throws InvalidArgument unless every length is finite and positive.
void condition_numbers(const Geometry& g, const Configurations& c, const Lengths& lc, Norm norm, double* out);

/// Singular values of J', descending: 6 numbers a configuration. Throws as condition_numbers does.
void singular_values(const Geometry& g, const Configurations& c, const Lengths& lc, double* out);

/// Determinants m, b, c of singularity.hpp: 3 numbers a configuration.
void singularity_margins(const Geometry& g, const Configurations& c, double* out);

/// Condition numbers of hexagonal designs at theta_z = 0, by the closed form: 1 number for each row a1 a2 b1 b2 zp zs, in
/// characteristic lengths. Infinite where singular, NaN where there is NaN.
void hexagonal_condition_numbers(const double* designs, long count, double* out);

/// The instruction set in use: "base", "v3" (AVX2) or "v4" (AVX-512). The environment variable NINEDOF_SIMD forces one; throws
/// InvalidArgument where it names none that this build and this processor have. Read once.
const char* simd_level();

}  // namespace ninedof::batch
