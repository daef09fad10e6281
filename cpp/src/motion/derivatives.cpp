#include "ninedof/motion/derivatives.hpp"

#include <algorithm>
#include <cmath>

#include "ninedof/math/control.hpp"
#include "ninedof/math/error.hpp"

namespace ninedof {
namespace {

constexpr std::size_t most_samples = 5;  // of a polynomial

struct Weights {
  double first, second;  ///< of the first and of the second derivative
};

/// The weights of sample j in the derivatives at 0: those of its Lagrange polynomial c0 + c1 t + c2 t^2 + ...
Weights weights(std::span<const double> at, std::size_t j) {
  double c0 = 1.0, c1 = 0.0, c2 = 0.0;
  for (std::size_t m = 0; m < at.size(); ++m) {
    if (m == j) continue;
    const double apart = at[j] - at[m];  // times (t - at[m]) / apart
    c2 = (c1 - at[m] * c2) / apart;
    c1 = (c0 - at[m] * c1) / apart;
    c0 *= -at[m] / apart;
  }
  return {c1, 2.0 * c2};
}

}  // namespace

PathDerivatives path_derivatives(std::span<const double> time, std::span<const Configuration> path,
                                 const std::stop_token& stop) {
  const std::size_t n = time.size(), size = std::min(most_samples, n);
  if (n < 3) throw InvalidArgument("time", std::to_string(n) + " numbers", "three or more");
  if (path.size() != n)
    throw InvalidArgument("path", std::to_string(path.size()) + " configurations", std::to_string(n));
  PathDerivatives out;
  std::vector<double> at(size);
  for (std::size_t k = 0; k < n; ++k) {
    if (stop.stop_requested()) throw Stopped{};
    const std::size_t begin = std::min(k - std::min(k, size / 2), n - size);
    const double unit = std::max(time[k] - time[begin], time[begin + size - 1] - time[k]);
    for (std::size_t j = 0; j < size; ++j) at[j] = (time[begin + j] - time[k]) / unit;
    Vec9 first = Vec9::Zero(), second = Vec9::Zero();
    for (std::size_t j = 0; j < size; ++j) {
      const Vec9 step = minus(path[begin + j], path[k]);  // differences first: no digits are lost to a large offset
      const Weights w = weights(at, j);
      first += w.first / unit * step;
      second += w.second / unit / unit * step;
    }
    out.velocity.push_back({first.head<3>(), first.segment<3>(3), first.tail<3>()});
    out.acceleration.push_back({second.head<3>(), second.segment<3>(3), second.tail<3>()});
  }
  return out;
}

}  // namespace ninedof
