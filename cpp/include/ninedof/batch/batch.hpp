#pragma once
/// Indices over many configurations of a robot (docs/theory/kernels.md).
///
/// The results agree with those of the functions of one configuration to rounding; singular, NaN and badly conditioned
/// configurations get exactly the results of those functions. A result depends only on its own configuration: not on
/// its neighbours in memory, on the instruction set of the processor or on how the caller divides the data among
/// threads.
///
/// No function here starts threads; see parallel.hpp for that.

#include "ninedof/conditioning/conditioning.hpp"
#include "ninedof/robot/geometry.hpp"

namespace ninedof::batch {

/// Configurations in the caller's memory. The position of the k-th (3 numbers) is at position + k * position_step;
/// rotation (9, row-major) and internal point (3) likewise. With a step of 0 all configurations share the same value.
struct Configurations {
  const double* position = nullptr;
  const double* rotation = nullptr;
  const double* internal_point = nullptr;
  long count = 0;
  long position_step = 3, rotation_step = 9, internal_point_step = 3;
};

/// Characteristic lengths: one for all (step 0) or one per configuration (step 1).
struct Lengths {
  const double* value = nullptr;
  long step = 0;
};

/// l1 l2 l3 q1 q2 q3 r1 r2 r3: 9 numbers per configuration.
void leg_lengths(const Geometry& g, const Configurations& c, double* out);

/// Condition number of J': 1 number per configuration. Throws InvalidArgument unless every length is finite and
/// positive.
void condition_numbers(const Geometry& g, const Configurations& c, const Lengths& lc, Norm norm, double* out);

/// Singular values of J', descending: 6 numbers per configuration. Throws as condition_numbers does.
void singular_values(const Geometry& g, const Configurations& c, const Lengths& lc, double* out);

/// Determinants n, b, c of singularity.hpp: 3 numbers per configuration.
void singularity_margins(const Geometry& g, const Configurations& c, double* out);

/// Condition numbers of hexagonal designs at theta_z = 0, by the closed form: 1 number for each row a1 a2 b1 b2 zp zs,
/// in units of the characteristic length. Infinite for a singular design, NaN for a row with NaN.
void hexagonal_condition_numbers(const double* designs, long count, double* out);

/// The instruction set in use: "base", "v3" (AVX2) or "v4" (AVX-512). The environment variable NINEDOF_SIMD, read once,
/// selects one; throws InvalidArgument if this build or this processor does not have it.
const char* simd_level();

}  // namespace ninedof::batch
