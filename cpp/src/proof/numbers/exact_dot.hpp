#pragma once
/// Sums of products of doubles, enclosed to the last bit whatever cancels.
///
/// Each product and each partial sum is split into its rounded value and the exact remainder (TwoProduct of Dekker,
/// TwoSum of Knuth). The sum of all remainders is small, and an ordinary bound of its rounding error
/// suffices (docs/theory/proof.md, lemma 3).

#include <cmath>

#include "math/elementary.hpp"
#include "ninedof/math/xyz.hpp"

namespace ninedof {

class DotSum {
 public:
  DotSum& product(double x, double y) {
    const elementary::Product both = elementary::product(x, y);
    rest(both.low);
    return number(both.high);
  }
  DotSum& number(double x) {
    const double sum = sum_ + x;
    const double part = sum - sum_;
    rest((sum_ - (sum - part)) + (x - part));
    sum_ = sum;
    return *this;
  }

  Interval value() const {
    // Adding n remainders costs at most 1.01 n u times the sum of their moduli, and each lost at most 4 eta below the
    // normal numbers; u = 2^-53, so there is a factor of nearly two to spare.
    const double error = remainders_ * (0x1p-52 * moduli_ + 4.0 * detail::least_double);
    return {detail::below(sum_ + detail::below(rest_ - error)), detail::above(sum_ + detail::above(rest_ + error))};
  }

 private:
  void rest(double remainder) {
    rest_ += remainder;
    moduli_ += std::abs(remainder);
    remainders_ += 1.0;
  }

  double sum_ = 0.0, rest_ = 0.0, moduli_ = 0.0, remainders_ = 0.0;
};

}  // namespace ninedof
