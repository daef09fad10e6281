#include "ninedof/dynamics/drives.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "ninedof/math/error.hpp"

namespace ninedof {
namespace {

/// Integral of the positive part of what goes from a to b linearly, over a step of 1.
double positive_part(double a, double b) {
  if (a <= 0.0 && b <= 0.0) return 0.0;
  if (a >= 0.0 && b >= 0.0) return 0.5 * (a + b);
  const double top = std::max(a, b);
  return 0.5 * top * top / std::abs(a - b);
}

}  // namespace

DriveFigures drive_figures(std::span<const double> time, std::span<const Vec9> forces, std::span<const Vec9> rates) {
  const std::size_t n = time.size();
  if (forces.size() != n || rates.size() != n)
    throw InvalidArgument("forces, rates", std::to_string(forces.size()) + ", " + std::to_string(rates.size()),
                          std::to_string(n) + " each, one for each time");
  DriveFigures out;
  Vec9 before = Vec9::Zero();
  for (std::size_t k = 0; k < n; ++k) {
    const Vec9& f = forces[k];
    const Vec9 power = f.cwiseProduct(rates[k]);
    out.push = out.push.cwiseMax(f);
    out.pull = out.pull.cwiseMax(-f);
    out.power = out.power.cwiseMax(power);
    out.braking = out.braking.cwiseMax(-power);
    if (k > 0) {
      const double step = time[k] - time[k - 1];
      const Vec9& last = forces[k - 1];
      out.rms += step / 3.0 * (f.cwiseProduct(f) + f.cwiseProduct(last) + last.cwiseProduct(last));
      for (Eigen::Index leg = 0; leg < 9; ++leg) {
        out.work[leg] += step * positive_part(before[leg], power[leg]);
        out.returned[leg] += step * positive_part(-before[leg], -power[leg]);
      }
    }
    before = power;
  }
  if (n > 1) out.rms = (out.rms / (time[n - 1] - time[0])).cwiseSqrt();
  return out;
}

}  // namespace ninedof
