#pragma once
/// What the kernels offer: one table of plain functions for each instruction set. Includes nothing, as kernels must.

namespace ninedof::kernels {

/// The joints of a robot: x, y, z of each of three.
struct Joints {
  double base_external[3][3], base_internal[3][3], platform_external[3][3], platform_internal[3][3];
};

/// Configurations of one robot in the caller's memory; a step of 0 repeats the same one. `length` is used by the conditioning.
struct Block {
  Joints robot;
  const double *position, *rotation, *internal_point, *length;
  long position_step, rotation_step, internal_point_step, length_step;
  long count;
};

/// What a kernel writes, in place of the first number of a row, where it is not sure of it. Callers ask the accurate path then.
/// No result can be that: condition numbers and lengths are positive, determinants of unit rows at least -1.
constexpr double unsure = -2.0;

struct Table {
  const char* level;
  int lanes;
  void (*leg_lengths)(const Block& block, double* out);                    ///< 9 a row; never unsure
  void (*condition_numbers)(const Block& block, double* out);              ///< 1 a row
  void (*frobenius_condition_numbers)(const Block& block, double* out);    ///< 1 a row
  void (*singular_values)(const Block& block, double* out);                ///< of J', descending, 6 a row
  void (*singularity_margins)(const Block& block, double* out);            ///< m, b, c, 3 a row
  /// Rows a1 a2 b1 b2 zp zs of hexagonal designs at theta_z = 0, in characteristic lengths: 1 a row.
  void (*hexagonal_condition_numbers)(const double* designs, long count, double* out);
};

}  // namespace ninedof::kernels
