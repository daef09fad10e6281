#pragma once
/// The data of all figures: fixed seeds, so that every run and every machine sees the same robots.

#include <array>
#include <random>
#include <vector>

#include "ninedof/math/rotation.hpp"
#include "ninedof/problem/problem.hpp"

namespace bench {

constexpr std::size_t blocks = 16;       // timed one by one
constexpr std::size_t block_size = 256;  // items between two looks at the clock, which costs some 25 ns

constexpr double length = 1.3;  // characteristic; not 1, so that an omission is detected
constexpr int multi_start_count = 64;

class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}
  double operator()(double low, double high) { return low + (high - low) * unit_(engine_); }
  ninedof::Vec3 point(double size) { return {(*this)(-size, size), (*this)(-size, size), (*this)(-size, size)}; }

 private:
  std::mt19937_64 engine_;
  std::uniform_real_distribution<double> unit_{0.0, 1.0};
};

/// A robot somewhere in its workspace.
struct Pose {
  ninedof::Geometry geometry;
  ninedof::Configuration configuration;
};

/// A hexagonal robot, or a general one: no symmetry, no two joints in one place.
inline ninedof::Geometry random_geometry(Random& random, bool hexagonal) {
  const auto triangle = [&](double size) {
    ninedof::Triple t;
    for (std::size_t i = 0; i < 3; ++i)
      t[i] = size * (ninedof::rotation_about_z(-2.1 * static_cast<double>(i)) * ninedof::Vec3::UnitX()) +
             random.point(0.3 * size);
    return t;
  };
  if (!hexagonal) return {triangle(2.0), triangle(2.0), triangle(1.0), triangle(1.0)};
  return ninedof::Geometry::hexagonal(random(0.2, 3.0), random(0.2, 3.0), random(0.2, 2.0), random(0.2, 2.0));
}

/// Platform tilted and off the axis, O somewhere between the plates.
inline ninedof::Configuration near_home(Random& random) {
  return {ninedof::Vec3(0.0, 0.0, 3.0) + random.point(0.7), ninedof::exp_rotation(random.point(0.5)),
          ninedof::Vec3(0.0, 0.0, 1.5) + random.point(0.5)};
}

/// Any orientation whatever, uniformly.
inline ninedof::Configuration any_configuration(Random& random) {
  Eigen::Vector4d wxyz;
  do {
    for (double& x : wxyz) x = random(-1.0, 1.0);
  } while (wxyz.squaredNorm() > 1.0 || wxyz.squaredNorm() < 1e-4);
  ninedof::Configuration c = near_home(random);
  c.rotation = ninedof::rotation_from_quaternion(wxyz);
  return c;
}

/// Hexagonal robots and general ones in turn.
inline std::vector<Pose> random_poses() {
  Random random(1);
  std::vector<Pose> poses;
  while (poses.size() < blocks * block_size) {
    const ninedof::Geometry g = random_geometry(random, poses.size() % 2 == 0);
    poses.push_back({g, near_home(random)});
  }
  return poses;
}

/// Variables of the hexagonal family: a1, a2, b1, b2, zp, zs, theta_z.
using Variables = std::array<double, 7>;

inline std::vector<Variables> random_designs() {
  Random random(2);
  std::vector<Variables> designs(blocks * block_size);
  for (Variables& x : designs) {
    for (std::size_t k = 0; k < 5; ++k) x[k] = random(0.3, 6.0);
    x[5] = random(0.1, 0.9) * x[4];
    x[6] = random(-0.5, 0.5);
  }
  return designs;
}

/// The paper's study: base at most twice the platform, theta_z = 0, lengths in characteristic lengths.
inline ninedof::Problem paper_study() {
  ninedof::Problem problem;
  problem.family = "hexagonal";
  problem.variables = {{0.0, 60.0}, {0.0, 60.0}, {0.0, 60.0}, {0.0, 60.0}, {0.05, 80.0}, {0.05, 80.0}, {0.0, 0.0}};
  problem.limits = {{"radius_ratio", 0.0, 2.0}};
  return problem;
}

constexpr double paper_optimum = 3.762659;  // least condition number of that study, to the digits given

/// Starts drawn uniformly from the study's bounds, those with zs < zp.
inline std::vector<Eigen::VectorXd> random_starts(const ninedof::Problem& problem, std::size_t count) {
  Random random(3);
  std::vector<Eigen::VectorXd> starts;
  while (starts.size() < count) {
    Eigen::VectorXd x(static_cast<Eigen::Index>(problem.variables.size()));
    for (Eigen::Index k = 0; k < x.size(); ++k) {
      const ninedof::Bounds& b = problem.variables[static_cast<std::size_t>(k)];
      x[k] = random(b.low, b.high);
    }
    if (x[5] < x[4]) starts.push_back(x);
  }
  return starts;
}

}  // namespace bench
