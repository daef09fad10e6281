#pragma once
/// What several test sources need: numbers from fixed seeds, random robots, and the message of an error.

#include <Eigen/Geometry>
#include <cmath>
#include <concepts>
#include <cstdint>
#include <limits>
#include <numbers>
#include <random>
#include <string>

#include "math/numbers.hpp"
#include "ninedof/math/error.hpp"
#include "ninedof/robot/configuration.hpp"
#include "ninedof/robot/geometry.hpp"

namespace support {

using ninedof::Configuration;
using ninedof::eps;
using ninedof::Geometry;
using ninedof::infinity;
using ninedof::Mat3;
using ninedof::not_a_number;
using ninedof::Orbit;
using ninedof::Triple;
using ninedof::Vec3;
using ninedof::Vec6;
using ninedof::Vec9;

constexpr double pi = std::numbers::pi;

/// The same numbers with every standard library: only the engine is standardised, the distributions are not.
class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}

  double uniform(double low, double high) {
    return low + (high - low) * 0x1p-53 * static_cast<double>(engine_() >> 11);
  }
  double log_uniform(double low, double high) { return std::exp(uniform(std::log(low), std::log(high))); }
  double sign() { return uniform(-1.0, 1.0) < 0.0 ? -1.0 : 1.0; }
  double normal() { return std::sqrt(-2.0 * std::log(uniform(0x1p-60, 1.0))) * std::cos(uniform(0.0, 2.0 * pi)); }

  template <class Matrix>
  Matrix matrix() {
    return Matrix::NullaryExpr([this] { return normal(); });
  }
  Vec3 unit() { return matrix<Vec3>().normalized(); }

  /// Uniform over all rotations, made by Eigen and not by ninedof.
  Mat3 rotation() { return Eigen::Quaterniond(matrix<Eigen::Vector4d>().normalized()).toRotationMatrix(); }
  Mat3 rotation(double most) { return Eigen::AngleAxisd(uniform(0.0, most), unit()).toRotationMatrix(); }

 private:
  std::mt19937_64 engine_;
};

/// A robot somewhere.
struct Robot {
  Geometry geometry;
  Configuration configuration;
};

/// Three joints in no special position, about `size` from the z axis.
inline Triple random_triple(Random& random, double size) {
  Triple t;
  for (std::size_t i = 0; i < 3; ++i) {
    const double angle = 2.0 * pi / 3.0 * static_cast<double>(i) + random.uniform(-0.6, 0.6);
    const double radius = size * random.uniform(0.6, 1.4);
    t[i] = {radius * std::cos(angle), radius * std::sin(angle), size * random.uniform(-0.3, 0.3)};
  }
  return t;
}

/// A robot with no symmetry: joints off every plane, platform shifted and tilted (up to 0.5 rad), O between the plates.
inline Robot random_robot(Random& random) {
  const double base = random.uniform(1.0, 3.0), platform = random.uniform(0.5, 1.5);
  const Geometry geometry(random_triple(random, base), random_triple(random, base), random_triple(random, platform),
                          random_triple(random, platform));
  const double height = random.uniform(2.0, 4.0);
  Configuration c;
  c.position = {random.uniform(-0.5, 0.5), random.uniform(-0.5, 0.5), height};
  c.internal_point = {random.uniform(-0.5, 0.5), random.uniform(-0.5, 0.5), height * random.uniform(0.35, 0.65)};
  c.rotation = random.rotation(0.5);
  return {geometry, c};
}

inline Orbit random_orbit(Random& random) {
  return {random.uniform(0.3, 4.0), random.uniform(-pi, pi), random.uniform(-1.0, 1.0)};
}

/// A robot with threefold symmetry about z, its triples in no plane in particular.
inline Robot random_symmetric_robot(Random& random) {
  const Orbit a = random_orbit(random), b = random_orbit(random), c = random_orbit(random), d = random_orbit(random);
  return {Geometry::symmetric(a, b, c, d),
          ninedof::neutral(random.uniform(-6.0, 6.0), random.uniform(-6.0, 6.0), random.uniform(-pi, pi))};
}

/// Lengths times `factor`.
inline Triple scaled(Triple t, double factor) {
  for (Vec3& joint : t) joint *= factor;
  return t;
}
inline Robot scaled(const Robot& r, double factor) {
  const Geometry& g = r.geometry;
  const Configuration& c = r.configuration;
  return {{scaled(g.base_external(), factor), scaled(g.base_internal(), factor), scaled(g.platform_external(), factor),
           scaled(g.platform_internal(), factor)},
          {c.position * factor, c.rotation, c.internal_point * factor}};
}

/// |a - b| / |b|, infinite where either is no number.
inline double relative_error(double a, double b) {
  if (a == b) return 0.0;
  const double error = std::abs(a - b) / std::abs(b);
  return std::isfinite(error) ? error : infinity;
}

/// Largest |a - b| over largest |b|, infinite where either holds something that is no number.
template <class A, class B>
double matrix_error(const Eigen::MatrixBase<A>& a, const Eigen::MatrixBase<B>& b) {
  if (!a.allFinite() || !b.allFinite()) return infinity;
  return static_cast<double>((a - b).cwiseAbs().maxCoeff() / b.cwiseAbs().maxCoeff());
}

/// The message of the InvalidArgument that `action` throws; "nothing thrown" if it throws none.
std::string message_of(const std::invocable auto& action) {
  try {
    action();
  } catch (const ninedof::InvalidArgument& error) {
    return error.what();
  }
  return "nothing thrown";
}

/// Whether `action` throws InvalidArgument with a message that opens with `start`: the name of the argument.
bool refuses(const std::string& start, const std::invocable auto& action) {
  return message_of(action).starts_with(start + ": got ");
}

}  // namespace support
