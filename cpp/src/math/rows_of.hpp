#pragma once
/// Three vectors as the rows of a matrix.

#include "ninedof/math/types.hpp"

namespace ninedof {

inline Mat3 rows_of(const Triple& t) {
  Mat3 m;
  m << t[0].transpose(), t[1].transpose(), t[2].transpose();
  return m;
}

}  // namespace ninedof
