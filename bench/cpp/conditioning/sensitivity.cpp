#include "ninedof/conditioning/sensitivity.hpp"

#include <algorithm>

#include "ninedof/conditioning/conditioning.hpp"
#include "support/baseline.hpp"
#include "support/over_poses.hpp"

namespace bench {
namespace {

constexpr std::size_t coordinates = 3 * ninedof::point_count + 1;

/// The fourteen points and the characteristic length as numbers.
using Flat = std::array<double, coordinates>;

Flat flat(const ninedof::Points& at, double lc) {
  Flat x;
  for (std::size_t k = 0; k + 1 < coordinates; ++k) x[k] = at[k / 3][static_cast<Eigen::Index>(k % 3)];
  x.back() = lc;
  return x;
}

/// What the optimizer needs at a pose: the singular values of M and the gradient of each logarithm.
struct SpectrumAndGradients {
  ninedof::Vec6 sigma;
  std::array<ninedof::PointGradient, 6> gradient;
};
SpectrumAndGradients with_gradients(const Pose& p) {
  const ninedof::Points at = ninedof::points(p.geometry, p.configuration);
  const ninedof::NineLegs legs = ninedof::nine_legs(at);
  const ninedof::Spectrum s = ninedof::spectrum(at, legs, length);
  SpectrumAndGradients out;
  out.sigma = s.sigma;
  for (int k = 0; k < 6; ++k) {
    ninedof::PointGradient& g = out.gradient[static_cast<std::size_t>(k)];
    g = ninedof::zero_gradient();
    ninedof::add_spectrum_gradient(at, legs, s, k, k, 0.5 / (s.sigma[k] * s.sigma[k]), g);
  }
  return out;
}

/// Singular values of J' from the points, by plain Eigen; the platform frame rotated to the base axes.
ninedof::Vec6 by_plain(const Flat& x) {
  const auto point = [&](std::size_t k) { return ninedof::Vec3(x[3 * k], x[3 * k + 1], x[3 * k + 2]); };
  const ninedof::Vec3 p = point(ninedof::point_p), zero = ninedof::Vec3::Zero();
  const auto triple = [&](std::size_t k, const ninedof::Vec3& from) -> ninedof::Triple {
    return {point(k) - from, point(k + 1) - from, point(k + 2) - from};
  };
  const ninedof::Geometry g(triple(ninedof::point_r, zero), triple(ninedof::point_r_hat, zero),
                            triple(ninedof::point_u, p), triple(ninedof::point_u_tilde, p));
  return plain::singular_values(g, {p, ninedof::Mat3::Identity(), point(ninedof::point_s)}, x.back());
}

/// Gradients of log sigma of M, one per row, by central differences.
Eigen::Matrix<double, 6, coordinates> differences(const Pose& p) {
  Flat x = flat(ninedof::points(p.geometry, p.configuration), length);
  Eigen::Matrix<double, 6, coordinates> out;
  for (std::size_t k = 0; k < coordinates; ++k) {
    constexpr double step = 1e-6;
    const double at = x[k];
    x[k] = at + step;
    const ninedof::Vec6 ahead = by_plain(x).array().log();
    x[k] = at - step;
    const ninedof::Vec6 behind = by_plain(x).array().log();
    x[k] = at;
    out.col(static_cast<Eigen::Index>(k)) = (behind - ahead).reverse() / (2.0 * step);
  }
  return out;
}

/// Close to equal singular values and close to a singularity, finite differences are inaccurate.
bool differences_hold(const ninedof::Vec6& sigma) {
  if (sigma[0] > 50.0 * sigma[5]) return false;
  for (Eigen::Index k = 0; k < 5; ++k)
    if (sigma[k] - sigma[k + 1] < 1e-2 * sigma[k]) return false;
  return true;
}

}  // namespace

Figures sensitivity() {
  const Poses poses = shared_poses();
  std::size_t compared = 0;
  for (const Pose& p : *poses) {
    const SpectrumAndGradients ours = with_gradients(p);
    const double kappa = ours.sigma[0] / ours.sigma[5];
    const double expected = plain::condition_number(p.geometry, p.configuration, length);
    require_close("condition number from the spectrum", kappa, expected, 1e-13 * kappa * kappa);
    if (!differences_hold(ours.sigma)) continue;
    const auto by_difference = differences(p);
    for (Eigen::Index k = 0; k < 6; ++k) {
      const ninedof::PointGradient& g = ours.gradient[static_cast<std::size_t>(k)];
      const Flat exact = flat(g.point, g.length);
      for (std::size_t i = 0; i < coordinates; ++i)
        require_close("derivative of a singular value", exact[i], by_difference(k, static_cast<Eigen::Index>(i)),
                      1e-6 * kappa * kappa);
    }
    ++compared;
  }
  require(compared > poses->size() / 4, "too few derivatives compared: " + std::to_string(compared));

  const auto gradients = each_in_block(poses, with_gradients);
  const auto value = each_in_block(
      poses, [](const Pose& p) { return ninedof::condition_number(p.geometry, p.configuration, length); });
  return {{{"six singular values, general, and 6 x 43 derivatives",
            "condition number alone",
            blocks,
            block_size,
            gradients,
            value,
            {},
            true},
           {"six singular values, general, and 6 x 43 derivatives",
            "central differences of plain Eigen",
            blocks,
            block_size,
            gradients,
            each_in_block(poses, differences),
            {},
            false,
            3}},
          {}};
}

}  // namespace bench
