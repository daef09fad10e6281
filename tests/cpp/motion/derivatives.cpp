/// derivatives.hpp against polynomials, whose derivatives are known, and rotations against difference quotients of the
/// matrices.

#include "ninedof/motion/derivatives.hpp"

#include <doctest/doctest.h>

#include <stop_token>

#include "ninedof/math/control.hpp"
#include "support/motion.hpp"

using namespace ninedof;
using namespace support;

namespace {

std::vector<double> uneven_times(Random& random, int n) {
  std::vector<double> out{random.uniform(-1.5, -0.5)};
  while (static_cast<int>(out.size()) < n) out.push_back(out.back() + random.uniform(0.05, 0.25));
  return out;
}

/// A polynomial with random coefficients, and its derivatives.
struct Polynomial {
  Polynomial(Random& random, int degree) {
    for (int k = 0; k <= degree; ++k) coefficients.push_back(random.matrix<Vec3>());
  }
  Vec3 derivative(double t, int order) const {
    Vec3 sum = Vec3::Zero();
    for (int k = order; k < static_cast<int>(coefficients.size()); ++k) {
      double factor = 1.0;
      for (int j = 0; j < order; ++j) factor *= k - j;
      sum += factor * std::pow(t, k - order) * coefficients[static_cast<std::size_t>(k)];
    }
    return sum;
  }
  std::vector<Vec3> coefficients;
};

Mat3 turned(const Vec3& w) {
  return Eigen::AngleAxisd(w.norm(), w.normalized()).toRotationMatrix();
}

Vec3 axis_of(const Mat3& skew) {
  return 0.5 * Vec3(skew(2, 1) - skew(1, 2), skew(0, 2) - skew(2, 0), skew(1, 0) - skew(0, 1));
}

/// Largest error of the derivatives of p and s that follow polynomials, and of a turn about one axis whose angle does.
double polynomial_error(Random& random, int samples, int degree) {
  const std::vector<double> time = uneven_times(random, samples);
  const Polynomial p(random, degree), s(random, degree), angle(random, degree);
  const Vec3 axis = random.unit();
  const Mat3 start = random.rotation();
  const double slow = 0.02;
  std::vector<Configuration> path;
  for (const double t : time) {
    const Mat3 turn = Eigen::AngleAxisd(slow * angle.derivative(t, 0).x(), axis).toRotationMatrix();
    path.push_back({p.derivative(t, 0), turn * start, s.derivative(t, 0)});
  }
  const PathDerivatives found = path_derivatives(time, path);
  double error = 0.0;
  for (std::size_t k = 0; k < time.size(); ++k) {
    const auto of = [&](int order) {
      const double t = time[k];
      return stacked(slow * angle.derivative(t, order).x() * axis, p.derivative(t, order), s.derivative(t, order));
    };
    error = std::max({error, (stacked(found.velocity[k]) - of(1)).cwiseAbs().maxCoeff(),
                      (stacked(found.acceleration[k]) - of(2)).cwiseAbs().maxCoeff()});
  }
  return error;
}

}  // namespace

TEST_SUITE("derivatives") {
  TEST_CASE("polynomials of degree four are differentiated exactly on uneven times, of degree five they are not") {
    Random random(301);
    for (int n = 0; n < 50; ++n) {
      CHECK(polynomial_error(random, 12, 4) < 1e-8);
      CHECK(polynomial_error(random, 5, 4) < 1e-8);
      CHECK(polynomial_error(random, 4, 3) < 1e-8);
      CHECK(polynomial_error(random, 3, 2) < 1e-8);
      CHECK(polynomial_error(random, 12, 5) > 1e-5);
      CHECK(polynomial_error(random, 3, 3) > 1e-5);
    }
  }

  TEST_CASE("rotations about a moving axis agree with difference quotients of their matrices") {
    Random random(302);
    for (int n = 0; n < 20; ++n) {
      const Vec3 a = random.matrix<Vec3>(), b = random.matrix<Vec3>(), c = random.matrix<Vec3>();
      const auto rotation = [&](double t) { return Mat3(turned(a + t * b + t * t * c)); };
      const auto velocity = [&](double t) {
        constexpr double h = 1e-5;
        return axis_of((rotation(t + h) - rotation(t - h)) / (2.0 * h) * rotation(t).transpose());
      };
      std::vector<double> time = uneven_times(random, 30);
      std::vector<Configuration> path;
      for (double& t : time) {
        t *= 0.02;
        path.push_back({Vec3::Zero(), rotation(t), Vec3::Zero()});
      }
      const PathDerivatives found = path_derivatives(time, path);
      for (std::size_t k = 2; k + 2 < time.size(); ++k) {
        constexpr double h = 1e-3;
        const Vec3 acceleration = (velocity(time[k] + h) - velocity(time[k] - h)) / (2.0 * h);
        CHECK((found.velocity[k].omega - velocity(time[k])).norm() < 1e-5);
        CHECK((found.acceleration[k].alpha - acceleration).norm() < 1e-3);
      }
    }
  }

  TEST_CASE("a platform that does not turn has no angular velocity at all, and a large offset costs no digits") {
    Random random(303);
    const std::vector<double> time = uneven_times(random, 9);
    const Mat3 q = random.rotation();
    std::vector<Configuration> path;
    for (const double t : time) path.push_back({Vec3(1e9, 0.0, t), q, Vec3(0.0, 1e9, 0.0)});
    const PathDerivatives found = path_derivatives(time, path);
    for (std::size_t k = 0; k < time.size(); ++k) {
      CHECK((found.velocity[k].omega.isZero(0.0) && found.acceleration[k].alpha.isZero(0.0)));
      CHECK((found.velocity[k].pdot - Vec3::UnitZ()).norm() < 1e-12);
      CHECK(found.velocity[k].sdot.isZero(0.0));
    }
  }

  TEST_CASE("two samples and other numbers of times are refused, and a stop ends the call") {
    const std::vector<Configuration> path(3);
    CHECK(refuses("time", [&] { path_derivatives(std::vector{0.0, 1.0}, std::span(path).first(2)); }));
    std::stop_source source;
    source.request_stop();
    CHECK_THROWS_AS(path_derivatives(std::vector{0.0, 1.0, 2.0}, path, source.get_token()), Stopped);
    CHECK(refuses("path", [&] { path_derivatives(std::vector{0.0, 1.0, 2.0, 3.0}, path); }));
  }
}
