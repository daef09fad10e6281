#include "batch/spectrum_stack.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "batch/kernels/dispatch.hpp"
#include "math/numbers.hpp"
#include "ninedof/math/error.hpp"

namespace ninedof {

static_assert(sizeof(Points) == 42 * sizeof(double));

SpectrumStack::SpectrumStack(std::span<const PosedPoints* const> poses, double characteristic_length)
    : poses_(poses), length_(characteristic_length) {
  require_positive("characteristic_length", length_);
  assert(poses.size() <= most);
  rows_[0] = kernels::unsure;
  if (poses.size() < 2) return;  // quicker alone
  std::array<const double*, most> at;
  std::ranges::transform(poses, at.begin(), [](const PosedPoints* pose) { return pose->at.front().data(); });
  kernels::table().spectra(at.data(), static_cast<long>(poses.size()), length_, rows_.data());
  for (std::size_t n = 0; n < poses.size(); ++n) {
    order_[n] = {0, 1, 2, 3, 4, 5};
    const auto squared = [&](int k) { return row(n)[k * kernels::sigma_numbers]; };
    std::ranges::sort(order_[n],
                      [&](int a, int b) { return squared(a) > squared(b) || (squared(a) == squared(b) && a < b); });
  }
}

Spectrum SpectrumStack::spectrum(std::size_t pose) const {
  if (alone(pose)) return ninedof::spectrum(poses_[pose]->at, poses_[pose]->legs, length_);
  Spectrum out;
  out.characteristic_length = length_;
  for (int k = 0; k < 6; ++k) {
    const double* from = row(pose) + order_[pose][at_index(k)] * kernels::sigma_numbers;
    out.sigma[k] = std::sqrt(from[0]);
    out.twist.col(k) = Eigen::Map<const Vec6>(from + 1);
    out.sdot.col(k) = Eigen::Map<const Vec3>(from + 7);
    out.rates.col(k) = Eigen::Map<const Vec9>(from + 10);
  }
  return out;
}

PointGradient SpectrumStack::slopes(std::size_t pose, const Spectrum& s, int k) const {
  PointGradient out = zero_gradient();
  if (alone(pose)) {
    add_spectrum_gradient(poses_[pose]->at, poses_[pose]->legs, s, k, k, 0.5 / (s.sigma[k] * s.sigma[k]), out);
    return out;
  }
  const double* from = row(pose) + order_[pose][at_index(k)] * kernels::sigma_numbers + 19;
  for (std::size_t n = 0; n < point_count; ++n) out.point[n] = Eigen::Map<const Vec3>(from + 3 * n);
  out.length = from[42];
  return out;
}

}  // namespace ninedof
