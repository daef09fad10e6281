#pragma once
/// What is made least, and where it is looked at.

#include <limits>
#include <string>
#include <vector>

#include "ninedof/design/pose.hpp"

namespace ninedof {

/// A number of one pose; all are taken as logarithms.
enum class Index {
  condition_number,  ///< sigma_max / sigma_min of J', eq. (2)
  frobenius,         ///< the condition number in the Frobenius norm, eq. (4): smooth, 6 at best
  speed,             ///< 1 / sigma_min of J': leg speed a twist of size one asks for at worst
  six_legged,        ///< condition number of the six-legged platform on the same plates; neutral pose, C3 families
};

/// How poses make one number.
enum class Aggregate {
  worst,         ///< the largest
  mean_inverse,  ///< 1 / mean(1 / index): the global conditioning index, as a number to be made least
  weighted,      ///< worst^weight * (that)^(1 - weight)
};

/// Words as in study files. Throw InvalidArgument for another word.
Index index_from(const std::string& word);
Aggregate aggregate_from(const std::string& word);

struct Objective {
  Index index = Index::condition_number;
  Aggregate aggregate = Aggregate::worst;
  double weight = 0.5;  ///< of the worst, where weighted
  /// Bound on the 2-norm condition number at every pose looked at.
  double condition_limit = std::numeric_limits<double>::infinity();
  std::vector<Pose> poses;  ///< none: the neutral configuration alone

  /// Throws InvalidArgument naming what is wrong.
  void validate() const;
};

}  // namespace ninedof
