/// M^T M between bounds, and directions of vectors. Declared in conditioning/forms/gram.hpp.

#include <Eigen/LU>
#include <cmath>

#include "conditioning/forms/gram.hpp"

namespace ninedof::forms {
namespace {

using Columns = std::array<FormVector, 6>;

const PoseForm& of(const Symmetric3& s, std::size_t i, std::size_t j) {
  return s[entry(i, j)];
}
FormVector applied(const Symmetric3& s, const FormVector& v) {
  const auto row = [&](std::size_t i) { return of(s, i, 0) * v.x + of(s, i, 1) * v.y + of(s, i, 2) * v.z; };
  return {row(0), row(1), row(2)};
}
FormVector applied(const Mat3& m, const FormVector& v) {
  const auto row = [&](Eigen::Index i) { return m(i, 0) * v.x + m(i, 1) * v.y + m(i, 2) * v.z; };
  return {row(0), row(1), row(2)};
}
Mat3 middle_of(const Symmetric3& s) {
  Mat3 out;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) out(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) = of(s, i, j).c;
  return out;
}
/// At most the length of what the vector may be away from its middle.
double wandering(const FormVector& v) {
  double sum = 0.0;
  for (const PoseForm* x : {&v.x, &v.y, &v.z}) sum += radius(*x) * radius(*x);
  return std::sqrt(sum) * (1.0 + 0x1p-48);
}

}  // namespace

FormVector direction_of(const FormVector& v) {
  const double x = v.x.c, y = v.y.c, z = v.z.c, length = std::sqrt(x * x + y * y + z * z);
  const double away = wandering(v), nearest = length * (1.0 - 0x1p-48) - away;
  // Squares of numbers outside this range may be no doubles.
  if (!(length > 1e-140 && length < 1e140 && nearest > 0.0 && std::isfinite(away)))
    return {PoseForm::unknown(), PoseForm::unknown(), PoseForm::unknown()};
  const std::array<double, 3> e{x / length, y / length, z / length};
  const std::array<const PoseForm*, 3> part{&v.x, &v.y, &v.z};
  // e(v) = e + (1 - e e^T)(v - middle) / length + a rest below |v - middle|^2 / (sqrt(3) nearest^2).
  const double rest = 0.5774 * away * away / (nearest * nearest) * (1.0 + forms::grain);
  std::array<PoseForm, 3> out;
  for (std::size_t i = 0; i < 3; ++i) {
    PoseForm& f = out[i];
    f.c = e[i];
    double error = part[i]->r;
    for (std::size_t j = 0; j < 3; ++j) error += std::abs(e[i] * e[j]) * part[j]->r;
    for (std::size_t k = 0; k < PoseForm::size; ++k) {
      double along = 0.0;
      for (std::size_t j = 0; j < 3; ++j) along += e[j] * part[j]->a[k];
      f.a[k] = (part[i]->a[k] - e[i] * along) / length;
    }
    f.r = (rest + error / length) * (1.0 + forms::grain) + forms::grain * (1.0 + away / length) + forms::tiny;
  }
  return {out[0], out[1], out[2]};
}

SplitGram split_gram(const Geometry& g, double characteristic_length, const FormPose& pose, Moves& moves) {
  const double inverse_lc = 1.0 / characteristic_length;
  const LegProducts legs = leg_products(g, characteristic_length, pose, moves);
  const Symmetric3 &h = legs.upper, &f = legs.lower;
  SplitGram out;
  out.external = legs.external;
  for (std::size_t n = 0; n < out.sum.size(); ++n) out.sum[n] = h[n] + f[n];
  // Any share gives bounds. A little on the diagonal: where H + F is nearly singular the best one is of no use.
  const Mat3 middle = middle_of(out.sum);
  const Mat3 share = (middle + 1e-7 * middle.trace() * Mat3::Identity()).inverse() * middle_of(h);
  if (!share.allFinite()) return out;
  out.known = true;
  const FormVector y = inverse_lc * (pose.s - pose.p);
  const PoseForm zero = 0.0, one = 1.0;
  // Columns of K: e_k x y for turns, e_k for shifts.
  const Columns k{FormVector{zero, -y.z, y.y}, FormVector{y.z, zero, -y.x}, FormVector{-y.y, y.x, zero},
                  FormVector{one, zero, zero}, FormVector{zero, one, zero}, FormVector{zero, zero, one}};
  Columns upper, lower, upper_pull, lower_pull;
  for (std::size_t j = 0; j < 6; ++j) {
    lower[j] = applied(share, k[j]);
    upper[j] = k[j] - lower[j];
    upper_pull[j] = applied(h, upper[j]);
    lower_pull[j] = applied(f, lower[j]);
    const FormVector across = lower_pull[j] - upper_pull[j];
    out.across[0][j] = across.x;
    out.across[1][j] = across.y;
    out.across[2][j] = across.z;
  }
  for (std::size_t j = 0; j < 6; ++j)
    for (std::size_t i = 0; i <= j; ++i)
      out.above[entry(j, i)] = out.external[entry(j, i)] + dot(upper[i], upper_pull[j]) + dot(lower[i], lower_pull[j]);
  return out;
}

}  // namespace ninedof::forms
