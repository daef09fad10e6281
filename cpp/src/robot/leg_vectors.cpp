#include "robot/leg_vectors.hpp"

#include <cmath>

namespace ninedof {
namespace {

/// A sum with the rounding errors of its terms: as if in twice the precision (Ogita, Rump and Oishi, SIAM J. Sci.
/// Comput. 26, 2005).
struct SumWithErrors {
  double sum = 0.0, errors = 0.0;

  void add(double x) {
    const double next = sum + x, part = next - sum;
    errors += (sum - (next - part)) + (x - part);
    sum = next;
  }
  void add_product(double a, double b) {
    const double product = a * b;
    errors += std::fma(a, b, -product);
    add(product);
  }
};

}  // namespace

Vec3 exact_leg(const Vec3& to, const Vec3& from, const Mat3& rotation, const Vec3& joint) {
  Vec3 out;
  for (Eigen::Index row = 0; row < 3; ++row) {
    SumWithErrors x;
    x.add(to[row]);
    x.add(-from[row]);
    for (Eigen::Index k = 0; k < 3; ++k) x.add_product(-rotation(row, k), joint[k]);
    out[row] = x.sum + x.errors;
  }
  return out;
}

}  // namespace ninedof
