#pragma once
/// The parts of the program ninedof_floor.

#include "batch/floor/file.hpp"

namespace bench {

struct Count {
  int lanes;  ///< poses that are calculated together: the one that takes longest decides
  long poses;
  double multiplies, additions, divisions, roots, others;  ///< a pose
  double worst;  ///< relative difference from the accurate path, over max(1, kappa / 1e3)
};

/// The arithmetic of a condition number, averaged over the file's first poses.
Count count_operations(const File& file, int lanes, long most);

struct Accuracy {
  double error = 0.0;  ///< the largest relative error over max(1, kappa / 1e3)
  double most_condition = 0.0;  ///< the largest finite condition number
  long handed_over = 0;  ///< poses the kernel was not sure of
};

/// Compares the vector call with the scalar one. `near_singular`: every pose is first moved to 1 ... 1e-9 from a
/// singularity.
Accuracy accuracy(const File& file, bool near_singular);

}  // namespace bench
