/// Spectra of many poses at once against those of one pose, which share with the kernel neither the matrix M nor code:
/// any number of poses, singular ones among them, and singular values that meet.

#include "batch/spectrum_stack.hpp"

#include <doctest/doctest.h>

#include <cstring>

#include "batch/kernels/dispatch.hpp"
#include "ninedof/math/error.hpp"
#include "ninedof/math/rotation.hpp"
#include "support/support.hpp"

using namespace ninedof;
using namespace support;

namespace {

using Poses = std::vector<PosedPoints>;

Poses some_poses(const Geometry& g, Random& random, std::size_t count) {
  Poses out;
  for (std::size_t k = 0; k < count; ++k)
    out.push_back(posed_points(g, {Vec3(0.0, 0.0, 3.0) + cube(random, 0.7), exp_rotation(cube(random, 1.0)),
                                   Vec3(0.0, 0.0, 1.5) + cube(random, 0.5)}));
  return out;
}

std::vector<const PosedPoints*> each(const Poses& poses) {
  std::vector<const PosedPoints*> out;
  for (const PosedPoints& pose : poses) out.push_back(&pose);
  return out;
}

using Flat = Eigen::Matrix<double, 43, 1>;

Flat flat(const PointGradient& g) {
  Flat out;
  for (int k = 0; k < point_count; ++k) out.segment<3>(3 * k) = g.point[static_cast<std::size_t>(k)];
  out[42] = g.length;
  return out;
}

/// The derivatives of the logarithm of a singular value, by the functions of one pose.
PointGradient slopes_alone(const PosedPoints& pose, const Spectrum& s, int k) {
  PointGradient out = zero_gradient();
  add_spectrum_gradient(pose.at, pose.legs, s, k, k, 0.5 / (s.sigma[k] * s.sigma[k]), out);
  return out;
}

/// The largest relative error of singular values, beside what rounding of M makes of them.
double furthest_values(const Poses& poses, double lc) {
  const auto all = each(poses);
  const SpectrumStack stack(all, lc);
  double most = 0.0;
  for (std::size_t n = 0; n < poses.size(); ++n) {
    const Vec6 expected = spectrum(poses[n].at, poses[n].legs, lc).sigma, found = stack.spectrum(n).sigma;
    for (int k = 0; k < 6; ++k)
      most = std::max(most, std::abs(found[k] / expected[k] - 1.0) / std::max(1.0, expected[0] / expected[k] / 1e3));
  }
  return most;
}

/// The largest error of slopes, relative to the largest of them, beside what vectors of near singular values lose.
double furthest_slopes(const Poses& poses, double lc) {
  const auto all = each(poses);
  const SpectrumStack stack(all, lc);
  double most = 0.0;
  for (std::size_t n = 0; n < poses.size(); ++n) {
    const Spectrum expected = spectrum(poses[n].at, poses[n].legs, lc), found = stack.spectrum(n);
    for (int k = 0; k < 6; ++k) {
      const auto one = flat(slopes_alone(poses[n], expected, k));
      const Vec6 square = expected.sigma.cwiseAbs2();
      double gap = square[0];
      for (int j = 0; j < 6; ++j)
        if (j != k) gap = std::min(gap, std::abs(square[j] - square[k]));
      most = std::max(most, (flat(stack.slopes(n, found, k)) - one).norm() / one.norm() * gap / square[0]);
    }
  }
  return most;
}

}  // namespace

TEST_SUITE("spectrum_stack") {
  TEST_CASE("any number of poses has the spectra and slopes of its poses one by one") {
    Random random(31);
    for (const std::size_t count : {1UL, 2UL, 3UL, 7UL, 13UL, SpectrumStack::most})
      for (int n = 0; n < 20; ++n) {
        CAPTURE(count);
        const Poses poses = some_poses(random_robot(random).geometry, random, count);
        const double lc = random.log_uniform(0.3, 3.0);
        CHECK(furthest_values(poses, lc) < 1e-12);
        CHECK(furthest_slopes(poses, lc) < 1e-12);
      }
  }

  TEST_CASE("vectors and rates belong to the values") {
    Random random(32);
    const Poses poses = some_poses(random_robot(random).geometry, random, 9);
    const auto all = each(poses);
    const SpectrumStack stack(all, 1.3);
    for (std::size_t n = 0; n < poses.size(); ++n) {
      const Spectrum s = stack.spectrum(n), one = spectrum(poses[n].at, poses[n].legs, 1.3);
      CHECK((s.twist.transpose() * s.twist - Mat6::Identity()).norm() < 1e-13);
      for (int k = 0; k < 6; ++k) {
        CHECK(s.rates.col(k).norm() == doctest::Approx(s.sigma[k]).epsilon(1e-12));
        const double sign = s.twist.col(k).dot(one.twist.col(k)) < 0.0 ? -1.0 : 1.0;
        CHECK((s.sdot.col(k) - sign * one.sdot.col(k)).norm() < 1e-8 * (1.0 + one.sdot.col(k).norm()));
      }
    }
  }

  TEST_CASE("singular poses, and legs of no length, are left to the functions of one pose") {
    Random random(33);
    const Geometry g = random_robot(random).geometry;
    Poses poses = some_poses(g, random, 6);
    Poses singular = poses;
    for (std::size_t i = 0; i < 3; ++i) {  // all legs lead through O
      const Points& at = singular[2].at;
      singular[2].at[point_r + i] = at[point_s] + 2.0 * (at[point_s] - at[point_u + i]);
    }
    singular[4].at[point_s] = singular[4].at[point_r_hat];
    for (PosedPoints& pose : singular) pose.legs = nine_legs(pose.at);
    const auto all = each(singular), before = each(poses);
    const SpectrumStack stack(all, 1.0), regular(before, 1.0);
    for (const std::size_t n : {2UL, 4UL}) {
      const Spectrum s = stack.spectrum(n), one = spectrum(singular[n].at, singular[n].legs, 1.0);
      CHECK(s.sigma == one.sigma);
      CHECK(s.twist == one.twist);
      CHECK(flat(stack.slopes(n, s, 0)) == flat(slopes_alone(singular[n], one, 0)));
    }
    for (const std::size_t n : {0UL, 1UL, 3UL, 5UL}) CHECK(stack.spectrum(n).sigma == regular.spectrum(n).sigma);
    CHECK_THROWS_AS(SpectrumStack(all, 0.0), InvalidArgument);
    CHECK_THROWS_AS(SpectrumStack(all, std::numeric_limits<double>::quiet_NaN()), InvalidArgument);
  }

  TEST_CASE("singular values that meet have the slopes of their mean") {
    // On the axis of a symmetric robot two pairs are equal: their vectors may be any in a plane.
    const Geometry g = Geometry::hexagonal(0.4, 5.8, 2.9, 0.3);
    const PosedPoints home = posed_points(g, {Vec3(0.0, 0.0, 4.0), Mat3::Identity(), Vec3(0.0, 0.0, 2.4)});
    const Poses poses(5, home);
    const auto all = each(poses);
    const SpectrumStack stack(all, 1.0);
    const Spectrum expected = spectrum(home.at, home.legs, 1.0);
    for (std::size_t n = 0; n < poses.size(); ++n) {
      const Spectrum found = stack.spectrum(n);
      CHECK((found.sigma - expected.sigma).norm() < 1e-13 * expected.sigma[0]);
      int pairs = 0;
      for (int k = 0; k + 1 < 6; ++k) {
        if (expected.sigma[k] - expected.sigma[k + 1] > 1e-9) continue;
        ++pairs;
        const Flat one = flat(slopes_alone(home, expected, k)) + flat(slopes_alone(home, expected, k + 1));
        const Flat two = flat(stack.slopes(n, found, k)) + flat(stack.slopes(n, found, k + 1));
        CHECK((one - two).norm() < 1e-11);
      }
      CHECK(pairs == 2);
    }
  }

  TEST_CASE("the same bits on every level and in every lane") {
    Random random(34);
    const Poses poses = some_poses(random_robot(random).geometry, random, 37);
    std::vector<const double*> at;
    for (const PosedPoints& pose : poses) at.push_back(pose.at.front().data());
    const auto rows = [&](const kernels::Table& t, long count) {
      std::vector<double> out(at.size() * kernels::spectrum_numbers);
      for (std::size_t k = 0; k < at.size(); k += static_cast<std::size_t>(count))
        t.spectra(at.data() + k, std::min(count, static_cast<long>(at.size() - k)), 1.7,
                  out.data() + k * kernels::spectrum_numbers);
      return out;
    };
    const std::vector<double> expected = rows(*kernels::table_of("base"), 37);
    int unsure = 0;
    for (std::size_t k = 0; k < at.size(); ++k) unsure += expected[k * kernels::spectrum_numbers] == kernels::unsure;
    CHECK(unsure < 3);
    for (const char* level : {"base", "v3", "v4"})
      for (const long count : {1L, 5L, 37L})
        if (const kernels::Table* t = kernels::table_of(level)) {
          CAPTURE(level);
          CAPTURE(count);
          CHECK(std::memcmp(rows(*t, count).data(), expected.data(), expected.size() * sizeof(double)) == 0);
        }
  }
}
