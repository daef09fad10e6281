#pragma once
/// What several test sources need: numbers from fixed seeds, random robots, and the message of an error.

#include <doctest/doctest.h>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>
#include <concepts>
#include <cstdint>
#include <functional>
#include <limits>
#include <numbers>
#include <random>
#include <span>
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

/// Sanitizers make a program ten times slower, and find in a few cases what they find in many.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool sanitized = true;
#else
constexpr bool sanitized = false;
#endif

/// How many random cases to take: one of `share` under sanitizers.
constexpr int cases(int n, int share = 8) {
  return sanitized ? (n + share - 1) / share : n;
}

/// The same numbers with every standard library: only the engine is standardised, the distributions are not.
class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}

  double uniform(double low, double high);
  double log_uniform(double low, double high);
  double sign();
  double normal();

  template <class Matrix>
  Matrix matrix();
  Vec3 unit();

  /// Uniform over all rotations, made by Eigen and not by ninedof.
  Mat3 rotation();
  Mat3 rotation(double most);

 private:
  std::mt19937_64 engine_;
};

template <class Matrix>
Matrix Random::matrix() {
  return Matrix::NullaryExpr([this] { return normal(); });
}
extern template Vec3 Random::matrix<Vec3>();
extern template Vec6 Random::matrix<Vec6>();
extern template Vec9 Random::matrix<Vec9>();
extern template Mat3 Random::matrix<Mat3>();
extern template ninedof::Mat6 Random::matrix<ninedof::Mat6>();

/// The paper's plates.
inline const Geometry published = Geometry::hexagonal(0.0, 5.8124, 2.9062, 0.0);

/// Uniform in a cube about the origin.
inline Vec3 cube(Random& random, double half) {
  return {random.uniform(-half, half), random.uniform(-half, half), random.uniform(-half, half)};
}

inline std::span<const double> span(const Eigen::VectorXd& x) {
  return {x.data(), static_cast<std::size_t>(x.size())};
}

/// A robot somewhere.
struct Robot {
  Geometry geometry;
  Configuration configuration;
};

/// Three joints in no special position, about `size` from the z axis.
Triple random_triple(Random& random, double size);

/// A robot with no symmetry: joints off every plane, platform shifted and tilted (up to 0.5 rad), O between the plates.
Robot random_robot(Random& random);

/// The same turned in any way, or hexagonal plates there.
Robot any_robot(Random& random, bool hexagonal);

Orbit random_orbit(Random& random);

/// A robot with threefold symmetry about z, its triples in no plane in particular.
Robot random_symmetric_robot(Random& random);

/// Lengths times `factor`.
Triple scaled(Triple t, double factor);
Robot scaled(const Robot& r, double factor);

/// |a - b| / |b|, infinite where either is no number.
double relative_error(double a, double b);

/// Largest |a - b| over largest |b|, infinite where either holds something that is no number.
double matrix_error(const Eigen::Ref<const Eigen::MatrixXd>& a, const Eigen::Ref<const Eigen::MatrixXd>& b);

bool all_nan(const Eigen::Ref<const Eigen::MatrixXd>& m);

/// What a failed check prints.
std::string text(const Eigen::Ref<const Eigen::MatrixXd>& m);

/// The message of the InvalidArgument that `action` throws; "nothing thrown" if it throws none.
std::string message_of(const std::function<void()>& action);

/// Whether `action` throws InvalidArgument with a message that opens with `start`: the name of the argument.
bool refuses(const std::string& start, const std::function<void()>& action);

}  // namespace support

/// One way to print all matrices: Eigen's own is compiled for each type and size.
template <class M>
  requires std::derived_from<M, Eigen::MatrixBase<M>> && std::same_as<typename M::Scalar, double>
struct doctest::StringMaker<M> {
  static String convert(const M& m) { return support::text(m).c_str(); }
};
