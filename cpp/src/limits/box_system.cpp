#include "limits/box_system.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace ninedof {
namespace {

constexpr double upward = 1.0 + 0x1p-40;  // more than the roundings of a few hundred positive terms

double most_of(const PoseForm& f) {
  return std::max(upper(f), -lower(f));
}

}  // namespace

BoxSystem::BoxSystem(const std::array<NineForms, 9>& h) : h_(h) {
  Mat9 middle, away;
  for (Eigen::Index i = 0; i < 9; ++i)
    for (Eigen::Index j = 0; j < 9; ++j) {
      const PoseForm& f = h_[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)];
      middle(i, j) = f.c;
      away(i, j) = radius(f) + forms::grain * std::abs(f.c);
    }
  inverse_ = middle.inverse();
  const Mat9 size = inverse_.cwiseAbs();
  const Mat9 error = (Mat9::Identity() - inverse_.lazyProduct(middle)).cwiseAbs() + size.lazyProduct(away) +
                     forms::grain * (Mat9::Identity() + size.lazyProduct(middle.cwiseAbs()));
  sums_ = upward * error.rowwise().sum();
  norm_ = sums_.allFinite() ? sums_.maxCoeff() : 1.0;
}

PoseForm BoxSystem::component(int k, const NineForms& b) const {
  if (!(norm_ < 1.0)) return PoseForm::unknown();
  Vec9 middle;
  for (std::size_t i = 0; i < 9; ++i) middle[static_cast<Eigen::Index>(i)] = b[i].c;
  const Vec9 x = inverse_.transpose().lazyProduct(middle), y = inverse_.col(k);
  PoseForm out(x[k]);
  Vec9 left_of_b, left_of_unit;
  for (std::size_t i = 0; i < 9; ++i) {
    const auto n = static_cast<Eigen::Index>(i);
    PoseForm of_b = b[i], of_unit(n == k ? 1.0 : 0.0);
    for (std::size_t j = 0; j < 9; ++j) {
      of_b = of_b - x[static_cast<Eigen::Index>(j)] * h_[j][i];
      of_unit = of_unit - y[static_cast<Eigen::Index>(j)] * h_[i][j];
    }
    out = out + y[n] * of_b;
    left_of_b[n] = most_of(of_b);
    left_of_unit[n] = most_of(of_unit);
  }
  // z = h^-1 (e_k - A^T y) has |z| <= |inverse left| + |E| |z|, and no entry above `most`.
  const Vec9 first = inverse_.cwiseAbs().lazyProduct(left_of_unit);
  const double most = first.maxCoeff() / (1.0 - norm_);
  out.r += upward * upward * left_of_b.dot(first + most * sums_) + forms::tiny;
  return out;
}

}  // namespace ninedof
