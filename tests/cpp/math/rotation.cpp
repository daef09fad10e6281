/// rotation.hpp against the exponential series, against literal matrices, and round trips.

#include "ninedof/math/rotation.hpp"

#include <doctest/doctest.h>

#include "support/support.hpp"

using namespace ninedof;
using namespace support;

namespace {

/// The series of the matrix exponential in extended precision, scaled and squared. Shares with exp_rotation neither the
/// angle-axis formula nor a trigonometric function.
Mat3 exponential_series(const Vec3& w) {
  using Wide = Eigen::Matrix<long double, 3, 3>;
  int halvings = 0;
  double norm = w.cwiseAbs().maxCoeff();
  for (; norm > 0.01; norm /= 2.0) ++halvings;
  const auto x = (w.cast<long double>() * std::ldexp(1.0L, -halvings)).eval();
  Wide generator;
  generator << 0, -x[2], x[1], x[2], 0, -x[0], -x[1], x[0], 0;
  Wide sum = Wide::Identity(), term = Wide::Identity();
  for (int k = 1; k < 12; ++k) {
    term = (term * generator / k).eval();
    sum += term;
  }
  for (int k = 0; k < halvings; ++k) sum = (sum * sum).eval();
  return sum.cast<double>();
}

/// Angles of all sizes: zero, so small that the square underflows, tiny, ordinary, on both sides of a half turn,
/// several turns.
const std::vector<double> all_angles{0.0,       1e-300,     1e-160, 1e-100,    1e-20,     1e-9,     1e-8,
                                     1e-5,      1e-3,       0.3,    1.0,       2.0,       3.0,      pi - 1e-4,
                                     pi - 1e-8, pi - 1e-13, pi,     pi + 1e-9, pi + 1e-2, 2.0 * pi, 10.0};

/// Coordinate axes, diagonals with ties for the largest component, and random ones.
std::vector<Vec3> axes() {
  std::vector<Vec3> out{Vec3::UnitX(),
                        -Vec3::UnitY(),
                        Vec3::UnitZ(),
                        Vec3(1, 1, 0).normalized(),
                        Vec3(0, -1, 1).normalized(),
                        Vec3(1, 1, 1).normalized(),
                        Vec3(-1, 1, -1).normalized(),
                        Vec3(1, 1e-9, -1e-9).normalized()};
  Random random(11);
  for (int k = 0; k < 40; ++k) out.push_back(random.unit());
  return out;
}

double orthogonality_error(const Mat3& q) {
  return (q.transpose() * q - Mat3::Identity()).cwiseAbs().maxCoeff();
}

}  // namespace

TEST_SUITE("rotation") {
  TEST_CASE("exp_rotation is the exponential series, rows and columns orthonormal") {
    for (const Vec3& axis : axes())
      for (const double angle : all_angles) {
        CAPTURE(axis);
        CAPTURE(angle);
        const Mat3 q = exp_rotation(angle * axis);
        CHECK((q - exponential_series(angle * axis)).cwiseAbs().maxCoeff() <= (4.0 + 2.0 * angle) * eps);
        CHECK(orthogonality_error(q) <= 16.0 * eps);
        // For a small rotation the difference from the identity has relative accuracy.
        if (angle > 0.0 && angle < 1e-3)
          CHECK((q - q.transpose()).norm() == doctest::Approx(std::sqrt(8.0) * angle).epsilon(1e-6));
      }
  }

  TEST_CASE("log undoes exp below a half turn, with relative accuracy down to 1e-100") {
    for (const Vec3& axis : axes())
      for (const double angle : {1e-100, 1e-20, 1e-9, 1e-8, 1e-5, 1e-3, 0.3, 1.0, 2.0, 3.0, pi - 1e-4, pi - 1e-8}) {
        CAPTURE(axis);
        CAPTURE(angle);
        CHECK(matrix_error(log_rotation(exp_rotation(angle * axis)), angle * axis) <= 8.0 * eps);
      }
    CHECK(log_rotation(Mat3::Identity()) == Vec3::Zero());
  }

  TEST_CASE("log of a half turn is one of its two axes times pi") {
    for (const Vec3& axis : axes()) {
      CAPTURE(axis);
      const Mat3 q = 2.0 * axis * axis.transpose() - Mat3::Identity();  // the half turn by its definition
      const Vec3 w = log_rotation(q);
      CHECK(w.norm() == doctest::Approx(pi).epsilon(4.0 * eps));
      CHECK(std::min((w - pi * axis).norm(), (w + pi * axis).norm()) <= 16.0 * eps);
      CHECK((exp_rotation(w) - q).cwiseAbs().maxCoeff() <= 16.0 * eps);
    }
  }

  TEST_CASE("log returns the shorter rotation: beyond a half turn the opposite one") {
    for (const Vec3& axis : axes())
      for (const double angle : {pi + 1e-9, pi + 0.01, 4.0, 6.0, 2.0 * pi + 1.0, 20.0}) {
        CAPTURE(axis);
        CAPTURE(angle);
        const Vec3 w = log_rotation(exp_rotation(angle * axis));
        CHECK(w.norm() <= pi * (1.0 + eps));
        CHECK((w - std::remainder(angle, 2.0 * pi) * axis).norm() <= 8.0 * angle * eps);
      }
  }

  TEST_CASE("exp undoes log for any rotation") {
    Random random(12);
    for (int k = 0; k < 2000; ++k) {
      const Mat3 q = random.rotation();
      CHECK((exp_rotation(log_rotation(q)) - q).cwiseAbs().maxCoeff() <= 16.0 * eps);
    }
  }

  TEST_CASE("quaternions are (w, x, y, z): literal quarter turns") {
    const double h = std::sqrt(0.5);
    Mat3 about_x, about_y, about_z;
    about_x << 1, 0, 0, 0, 0, -1, 0, 1, 0;
    about_y << 0, 0, 1, 0, 1, 0, -1, 0, 0;
    about_z << 0, -1, 0, 1, 0, 0, 0, 0, 1;
    const std::vector<std::pair<Mat3, Eigen::Vector4d>> known{
        {about_x, {h, h, 0, 0}}, {about_y, {h, 0, h, 0}}, {about_z, {h, 0, 0, h}}, {Mat3::Identity(), {1, 0, 0, 0}}};
    for (const auto& [q, wxyz] : known) {
      CHECK((rotation_from_quaternion(wxyz) - q).cwiseAbs().maxCoeff() <= 4.0 * eps);
      CHECK((quaternion_from_rotation(q) - wxyz).cwiseAbs().maxCoeff() <= 4.0 * eps);
    }
    CHECK((rotation_about_z(pi / 2.0) - about_z).cwiseAbs().maxCoeff() <= eps);
    CHECK((exp_rotation({0, pi / 2.0, 0}) - about_y).cwiseAbs().maxCoeff() <= 4.0 * eps);
  }

  TEST_CASE("round trip of quaternion and matrix; w >= 0; length and sign do not matter") {
    Random random(13);
    for (int k = 0; k < 2000; ++k) {
      Eigen::Vector4d wxyz = random.matrix<Eigen::Vector4d>().normalized();
      if (k % 5 == 0) wxyz[0] = 0.0;                  // half turns
      if (k % 7 == 0) wxyz.tail<3>() *= 1e-12;        // nearly no rotation
      if (k % 11 == 0) wxyz[1 + k % 3] = 0.0;
      wxyz.normalize();
      const Mat3 q = rotation_from_quaternion(wxyz);
      const Eigen::Vector4d back = quaternion_from_rotation(q);
      CHECK(orthogonality_error(q) <= 16.0 * eps);
      CHECK(back[0] >= 0.0);
      CHECK(back.norm() == doctest::Approx(1.0).epsilon(4.0 * eps));
      CHECK(std::min((back - wxyz).norm(), (back + wxyz).norm()) <= 8.0 * eps);
      for (const double length : {-1.0, 3.0, 1e-200, 1e200})
        CHECK((rotation_from_quaternion(length * wxyz) - q).cwiseAbs().maxCoeff() <= 16.0 * eps);
    }
  }

  TEST_CASE("skew is the cross product; rotation_about_z rotates x towards y") {
    CHECK(skew({1, 2, 3}) * Vec3(4, 5, 6) == Vec3(-3, 6, -3));
    for (const double angle : {-3.0, -0.1, 0.0, 1e-9, 2.0, 5.0}) {
      CHECK((rotation_about_z(angle) * Vec3::UnitX() - Vec3(std::cos(angle), std::sin(angle), 0)).norm() <= eps);
      CHECK((rotation_about_z(angle) - exponential_series({0, 0, angle})).cwiseAbs().maxCoeff() <= 12.0 * eps);
    }
  }

  TEST_CASE("how a rotation turns as its vector changes, against difference quotients") {
    Random random(7);
    for (const double angle : all_angles)
      for (int n = 0; n < 20; ++n) {
        constexpr double h = 1e-5;
        const Vec3 w = angle * random.matrix<Vec3>().normalized(), dw = random.matrix<Vec3>().normalized();
        const Mat3 back = exp_rotation(w).transpose();
        const Vec3 turn = log_rotation(exp_rotation(w + h * dw) * back) - log_rotation(exp_rotation(w - h * dw) * back);
        CHECK((turn / (2.0 * h) - turn_by_vector(w) * dw).norm() < 1e-9);
        CHECK((turn_by_vector(w) * w - w).norm() <= 1e-14 * w.norm());
      }
  }

  TEST_CASE("invalid rotations are rejected by name") {
    CHECK(refuses("quaternion", [] { rotation_from_quaternion({0, 0, 0, 0}); }));
    CHECK(refuses("quaternion", [] { rotation_from_quaternion({1, not_a_number, 0, 0}); }));
    CHECK(refuses("quaternion", [] { rotation_from_quaternion({1, 0, infinity, 0}); }));

    const Mat3 q = exp_rotation({0.3, -0.2, 0.9});
    CHECK_NOTHROW(require_rotation("tilt", q));
    CHECK_NOTHROW(require_rotation("tilt", q + Mat3::Constant(1e-10)));
    CHECK(refuses("tilt", [&] { require_rotation("tilt", q + Mat3::Constant(1e-8)); }));
    CHECK(refuses("tilt", [&] { require_rotation("tilt", 1.001 * q); }));
    CHECK(refuses("tilt", [&] { require_rotation("tilt", Mat3::Zero()); }));
    CHECK(refuses("tilt", [&] { require_rotation("tilt", -q); }));
    CHECK(message_of([&] { require_rotation("tilt", -q); }).find("reflection") != std::string::npos);
    CHECK(refuses("tilt", [&] { require_rotation("tilt", Mat3::Constant(1e200)); }));
    for (const double bad : {not_a_number, infinity, -infinity}) {
      Mat3 broken = q;
      broken(2, 1) = bad;
      CHECK(refuses("tilt", [&] { require_rotation("tilt", broken); }));
    }
  }
}
