#pragma once
/// Nine linear equations over a box of poses, and of designs.

#include <array>

#include "math/form.hpp"
#include "ninedof/math/types.hpp"

namespace ninedof {

template <class T>
using Nine = std::array<T, 9>;

/// Equations A x = b with A = h^T, where h is given by rows. It is inverted in the middle of the box, in doubles:
/// errors of that inverse count as those of any other approximate one.
template <class T>
class BoxSystem {
 public:
  explicit BoxSystem(const Nine<Nine<T>>& h);
  /// Component k of x. With approximate x and y of A x = b and A^T y = e_k, constant over the box,
  ///     x_k = x~_k + y~.(b - A x~) + z.(b - A x~),  z = h^-1 (e_k - A^T y~) = C (e_k - A^T y~) + E z,
  /// of which E z is bounded alone: that is of third order. Unknown where h may be singular.
  T component(int k, const Nine<T>& b) const;
  /// h^-1 by rows: with C = inverse_ it is C + E C + E E C + E E E h^-1. Unknown where h may be singular.
  Nine<Nine<T>> inverse() const;
  /// How much of E each coordinate of the box moves, in the norm in which E shrinks; 0 where E is not known.
  std::array<double, T::size> moves() const;

 private:
  Mat9 slopes(std::size_t coordinate) const;

  Nine<Nine<T>> h_;
  Mat9 inverse_;  ///< C, of h in the middle
  Nine<Nine<T>> e_;  ///< E = 1 - C h
  Mat9 error_;    ///< |E| is at most this, entry by entry
  // h^-1 = (1 - E)^-1 inverse_ with |E| weight_ <= moved_ <= shrinks_ weight_, entry by entry, for a positive weight_.
  Vec9 weight_, moved_;
  double shrinks_;
};

}  // namespace ninedof
