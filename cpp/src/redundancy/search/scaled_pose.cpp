#include "redundancy/search/scaled_pose.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

namespace ninedof {
namespace {

double triple_product(const Vec3& a, const Vec3& b, const Vec3& c) {
  return a.dot(b.cross(c));
}

/// Subtracts the logarithm of |x - a|.
void subtract_log_distance(const Vec3& x, const Vec3& a, Jet& out) {
  const Vec3 v = x - a;
  const double squared = v.squaredNorm();
  out.value -= 0.5 * std::log(squared);
  out.gradient -= v / squared;
  out.hessian -= (Mat3::Identity() - (2.0 / squared) * (v * v.transpose())) / squared;
}

/// Logarithm of the size of a volume that is not zero.
Jet log_volume(double volume, const Vec3& gradient, const Mat3& hessian) {
  Jet out;
  out.value = std::log(std::abs(volume));
  out.gradient = gradient / volume;
  out.hessian = hessian / volume - out.gradient * out.gradient.transpose();
  return out;
}

double cubic(const std::array<double, 4>& c, double t) {
  return c[0] + t * (c[1] + t * (c[2] + t * c[3]));
}

/// Zeros of the derivative, ascending; NaN where there is none.
std::array<double, 2> turning_points(const std::array<double, 4>& c) {
  const double a = 3.0 * c[3], half = c[2], b = c[1];  // a t^2 + 2 half t + b
  const double root = std::sqrt(half * half - a * b);
  const double sum = -(half + std::copysign(root, half));
  const double one = sum / a, other = b / sum;
  return {std::min(one, other), std::max(one, other)};
}

/// The zero in (low, high] of a cubic that is monotone there and changes sign: bisection down to neighbouring numbers.
double between(const std::array<double, 4>& c, double low, double high) {
  for (int k = 0; k < 200; ++k) {
    const double middle = 0.5 * (low + high);
    if (middle <= low || middle >= high) break;
    (cubic(c, middle) * c[0] > 0.0 ? low : high) = middle;
  }
  return low;
}

/// The first t in (0, most] where the cubic, c0 other than zero, changes sign or touches zero; `most` if there is none.
double first_zero(const std::array<double, 4>& c, double most) {
  double from = 0.0;
  const auto turns = turning_points(c);
  for (const double to : {turns[0], turns[1], most}) {
    if (!(to > from) || to > most) continue;
    if (!(cubic(c, to) * c[0] > 0.0)) return between(c, from, to);
    from = to;
  }
  return most;
}

}  // namespace

ScaledPose::ScaledPose(const Geometry& g, const Vec3& position, const Mat3& rotation,
                       const InternalPointProblem& problem)
    : geometry_(g), position_(position), rotation_(rotation) {
  at_ = ninedof::points(g, {position, rotation, Vec3::Zero()});
  for (int k = 0; k < 12; ++k) origin_ += at_[at_index(k)] / 12.0;
  unit_ = 0.0;
  for (int k = 0; k < 12; ++k) unit_ = std::max(unit_, (at_[at_index(k)] - origin_).norm());
  for (Vec3& point : at_) point = scaled(point);
  characteristic_length_ = problem.characteristic_length / unit_;
  low_ << problem.limits.low.tail<6>() / unit_,
      Vec6::Constant(problem.criterion == Criterion::singularity ? joint_clearance : 0.0);
  high_ << problem.limits.high.tail<6>() / unit_, Vec6::Constant(std::numeric_limits<double>::infinity());
  for (int i = 0; i < 3; ++i) {
    const Vec3 &r = at_[at_index(point_r + i)], &u = at_[at_index(point_u + i)];
    moment_[at_index(i)] = r.cross(u);
    span_[at_index(i)] = u - r;
  }
  const auto normal = [&](int triple) {
    const Vec3& first = at_[at_index(triple)];
    return Vec3((at_[at_index(triple + 1)] - first).cross(at_[at_index(triple + 2)] - first));
  };
  normal_ = {normal(point_r_hat), normal(point_u_tilde)};
}

Points ScaledPose::points(const Vec3& x) const {
  Points out = at_;
  out[point_s] = x;
  return out;
}

Vec3 ScaledPose::volumes(const Vec3& x) const {
  return {normal_[0].dot(x - at_[point_r_hat]), normal_[1].dot(x - at_[point_u_tilde]),
          triple_product(turning_row(0, x), turning_row(1, x), turning_row(2, x))};
}

Vec3 ScaledPose::determinants(const Vec3& x) const {
  Vec3 rows = Vec3::Ones();
  for (int i = 0; i < 3; ++i) {
    rows[0] *= (x - at_[at_index(point_r_hat + i)]).norm();
    rows[1] *= (x - at_[at_index(point_u_tilde + i)]).norm();
    rows[2] *= (x - at_[at_index(point_r + i)]).norm() * (x - at_[at_index(point_u + i)]).norm();
  }
  const Vec3 v = volumes(x);
  Vec3 out;
  for (int k = 0; k < 3; ++k) out[k] = rows[k] > 0.0 ? v[k] / rows[k] : 0.0;
  return out;
}

std::array<Jet, 3> ScaledPose::log_determinants(const Vec3& x) const {
  const Vec3 v = volumes(x);
  std::array<Vec3, 3> row;
  for (int i = 0; i < 3; ++i) row[at_index(i)] = turning_row(i, x);
  Vec3 gradient = Vec3::Zero();
  Mat3 hessian = Mat3::Zero();
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
    gradient += row[j].cross(row[k]).cross(span_[i]);
    const Vec3 both = span_[i].cross(span_[j]);
    hessian += both * row[k].transpose() + row[k] * both.transpose();
  }
  std::array<Jet, 3> out{log_volume(v[0], normal_[0], Mat3::Zero()), log_volume(v[1], normal_[1], Mat3::Zero()),
                         log_volume(v[2], gradient, hessian)};
  for (int i = 0; i < 3; ++i) {
    subtract_log_distance(x, at_[at_index(point_r_hat + i)], out[0]);
    subtract_log_distance(x, at_[at_index(point_u_tilde + i)], out[1]);
    subtract_log_distance(x, at_[at_index(point_r + i)], out[2]);
    subtract_log_distance(x, at_[at_index(point_u + i)], out[2]);
  }
  return out;
}

double ScaledPose::step_to_singularity(const Vec3& x, const Vec3& d, double most) const {
  const Vec3 v = volumes(x);
  double way = most;
  for (std::size_t k = 0; k < 2; ++k) {
    const double slope = normal_[k].dot(d), start = v[static_cast<Eigen::Index>(k)];
    if (start * slope < 0.0) way = std::min(way, -start / slope);
  }
  Triple row, turn;
  for (int i = 0; i < 3; ++i) {
    row[at_index(i)] = turning_row(i, x);
    turn[at_index(i)] = span_[at_index(i)].cross(d);
  }
  double first = 0.0, second = 0.0;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
    first += triple_product(turn[i], row[j], row[k]);
    second += triple_product(row[i], turn[j], turn[k]);
  }
  return first_zero({v[2], first, second, triple_product(turn[0], turn[1], turn[2])}, way);
}

}  // namespace ninedof
