#pragma once
/// The kernels as a table of plain functions, one for each instruction set. Includes nothing, as the kernels require.

namespace ninedof::kernels {

/// The joints of a robot: x, y, z of each joint of a triple.
struct Joints {
  double base_external[3][3], base_internal[3][3], platform_external[3][3], platform_internal[3][3];
};

/// Configurations of one robot in the caller's memory; a step of 0 repeats the same value. `length` is the
/// characteristic length, where a kernel needs it.
struct Block {
  Joints robot;
  const double *position, *rotation, *internal_point, *length;
  long position_step, rotation_step, internal_point_step, length_step;
  long count;
};

/// A kernel writes this in place of the first number of a row whose accuracy is uncertain; the caller then recomputes
/// the row with the functions of one configuration. No result has this value: condition numbers and lengths are
/// positive, determinants of unit rows at least -1.
constexpr double unsure = -2.0;

/// Numbers of a singular value in a row of `spectra`: its square, the twist, the velocity of O, the rates of the legs,
/// and the slopes of its logarithm by fourteen points and by the characteristic length; and of all six.
constexpr int sigma_numbers = 1 + 6 + 3 + 9 + 42 + 1, spectrum_numbers = 6 * sigma_numbers;

struct Table {
  const char* level;
  int lanes;
  void (*leg_lengths)(const Block& block, double* out);                    ///< 9 per row
  void (*condition_numbers)(const Block& block, double* out);              ///< 1 per row
  void (*frobenius_condition_numbers)(const Block& block, double* out);    ///< 1 per row
  void (*singular_values)(const Block& block, double* out);                ///< of J', descending, 6 per row
  void (*singularity_margins)(const Block& block, double* out);            ///< n, b, c, 3 per row
  /// Rows a1 a2 b1 b2 zp zs of hexagonal designs at theta_z = 0, in characteristic lengths: 1 per row.
  void (*hexagonal_condition_numbers)(const double* designs, long count, double* out);
  /// Of robots given by the 42 coordinates of their points: spectrum_numbers per row.
  void (*spectra)(const double* const* points, long count, double length, double* out);
};

}  // namespace ninedof::kernels
