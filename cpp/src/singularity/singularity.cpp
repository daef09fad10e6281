#include "ninedof/singularity/singularity.hpp"

#include <Eigen/Geometry>
#include <Eigen/SVD>
#include <array>
#include <cmath>

#include "math/linear/decompositions.hpp"
#include "math/numbers.hpp"
#include "math/rows_of.hpp"
#include "ninedof/math/error.hpp"
#include "ninedof/math/rotation.hpp"
#include "ninedof/robot/legs.hpp"

namespace ninedof {
namespace {

/// A difference of points shorter than this many roundings of their coordinates has no direction.
constexpr double roundings_of_zero = 4.0;

/// A smallest singular value that cannot be told from zero: rows of size one carry a few roundings each.
constexpr double lost = 64.0 * eps;

/// A vector between two points: length, and direction if it has one.
struct Span {
  double length = 0.0;
  Vec3 direction = Vec3::Zero();
};

/// `size`: how large the coordinates were that the vector is a difference of.
Span span(double length, const Vec3& direction, double size) {
  return length <= roundings_of_zero * eps * size ? Span{} : Span{length, direction};
}
Span span(const Vec3& v, double size) {
  const double length = v.norm();
  return length == 0.0 ? Span{} : span(length, v / length, size);
}

/// All vectors that the three mechanisms are made of, base frame.
struct Spans {
  std::array<Span, 3> d, w;  // O -> base joint, O -> platform joint, of the external legs
  std::array<Span, 3> external, upper, lower;
};

Spans spans(const Geometry& g, const Configuration& c) {
  const Legs k = legs(g, c);
  const Vec3 &p = c.position, &s = c.internal_point;
  const double p_size = p.norm(), s_size = s.norm();
  Spans out;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    const Vec3& r = g.base_external()[i];
    const double r_size = r.norm(), head = p_size + k.u[i].norm();
    out.d[i] = span(r - s, r_size + s_size);
    out.w[i] = span(p + k.u[i] - s, head + s_size);
    out.external[i] = span(k.l[row], k.e[i], head + r_size);
    out.upper[i] = span(k.q[row], k.e_tilde[i], s_size + p_size + k.u_tilde[i].norm());
    out.lower[i] = span(k.r[row], k.e_hat[i], s_size + g.base_internal()[i].norm());
  }
  return out;
}

Mat3 directions(const std::array<Span, 3>& t) {
  return rows_of({t[0].direction, t[1].direction, t[2].direction});
}

/// Rows d^ x w^: zero for a leg of zero length too.
Mat3 turning_rows(const Spans& k) {
  Triple rows;
  for (std::size_t i = 0; i < 3; ++i) {
    rows[i] = k.d[i].direction.cross(k.w[i].direction);
    if (k.external[i].length == 0.0) rows[i].setZero();
  }
  return rows_of(rows);
}

/// No -0.0: at a singularity there is no side.
double determinant(const Mat3& rows) {
  return rows.row(0).dot(rows.row(1).cross(rows.row(2))) + 0.0;
}

bool has_nan(const Configuration& c) {
  return c.position.hasNaN() || c.rotation.hasNaN() || c.internal_point.hasNaN();
}

PerMechanism margins_of(const Mat3& m, const Mat3& b, const Mat3& c) {
  return {determinant(m), determinant(b), determinant(c)};
}

/// The weakest of the three. Of several that are lost the first of m, c, b: a turn about O asks nothing of the internal
/// legs, and a motion of C or B asks M for a turn.
Mechanism weakest(const PerMechanism& sigma) {
  if (sigma.m <= lost) return Mechanism::m;
  if (sigma.c <= lost) return Mechanism::c;
  if (sigma.b <= lost) return Mechanism::b;
  if (sigma.m <= sigma.b && sigma.m <= sigma.c) return Mechanism::m;
  return sigma.c <= sigma.b ? Mechanism::c : Mechanism::b;
}

/// L: root mean square distance of the six platform joints from O.
double platform_reach(const Spans& k) {
  double sum = 0.0;
  for (std::size_t i = 0; i < 3; ++i) sum += k.w[i].length * k.w[i].length + k.upper[i].length * k.upper[i].length;
  return std::sqrt(sum / 6.0);
}

bool has_leg_of_zero_length(const Spans& k, Mechanism mechanism) {
  const auto& legs = mechanism == Mechanism::m ? k.external : mechanism == Mechanism::b ? k.lower : k.upper;
  return legs[0].length == 0.0 || legs[1].length == 0.0 || legs[2].length == 0.0;
}

/// (omega, v_O, sdot) at the length described in the header, as (omega, pdot, sdot).
Velocity motion_from(const Vec3& omega, const Vec3& at_o, const Vec3& sdot, double reach, const Configuration& c) {
  const double length = std::sqrt(omega.squaredNorm() + (at_o.squaredNorm() + sdot.squaredNorm()) / (reach * reach));
  const Vec3 y = c.internal_point - c.position;
  return {omega / length, (at_o + y.cross(omega)) / length, sdot / length};
}

using Svd = Eigen::JacobiSVD<Mat3>;

}  // namespace

const char* to_string(Mechanism mechanism) {
  switch (mechanism) {
    case Mechanism::m: return "m";
    case Mechanism::b: return "b";
    case Mechanism::c: return "c";
    case Mechanism::none: break;
  }
  return "";
}

PerMechanism singularity_margins(const Geometry& g, const Configuration& c) {
  if (has_nan(c)) return {not_a_number, not_a_number, not_a_number};
  const Spans k = spans(g, c);
  return margins_of(turning_rows(k), directions(k.lower), directions(k.upper));
}

SingularityReport singularity(const Geometry& g, const Configuration& c) {
  if (has_nan(c)) {
    const PerMechanism nothing{not_a_number, not_a_number, not_a_number};
    const Vec3 unknown = Vec3::Constant(not_a_number);
    return {nothing, nothing, Mechanism::none, {unknown, unknown, unknown}};
  }
  const Spans k = spans(g, c);
  const Mat3 m = turning_rows(k), lower = directions(k.lower), upper = directions(k.upper);
  constexpr unsigned full = Eigen::ComputeFullU | Eigen::ComputeFullV;
  const Svd svd_m(m, full), svd_b(lower, full), svd_c(upper, full);

  SingularityReport out;
  out.margins = margins_of(m, lower, upper);
  out.sigma = {svd_m.singularValues()[2], svd_b.singularValues()[2], svd_c.singularValues()[2]};
  out.mechanism = weakest(out.sigma);
  if (has_leg_of_zero_length(k, out.mechanism)) {
    const Vec3 unknown = Vec3::Constant(not_a_number);
    out.motion = {unknown, unknown, unknown};
    return out;
  }
  Vec3 omega, at_o = Vec3::Zero(), sdot = Vec3::Zero();
  if (out.mechanism == Mechanism::m) {
    omega = svd_m.matrixV().col(2);
  } else {
    // The upper legs are kept by v_O = sdot (B) or by C v_O = 0 (C), the external ones by M omega = -Ee v_O, here with
    // row i times l_i / (|d_i| |w_i|).
    at_o = (out.mechanism == Mechanism::b ? svd_b : svd_c).matrixV().col(2);
    if (out.mechanism == Mechanism::b) sdot = at_o;
    Vec3 pull;
    for (std::size_t i = 0; i < 3; ++i)
      pull[static_cast<Eigen::Index>(i)] =
          -(k.external[i].length / k.d[i].length / k.w[i].length) * k.external[i].direction.dot(at_o);
    omega = svd_m.solve(pull);
  }
  out.motion = motion_from(omega, at_o, sdot, platform_reach(k), c);
  return out;
}

std::vector<Vec9> uncontrolled_motions(const Geometry& g, const Configuration& c, double tolerance) {
  require_positive("tolerance", tolerance);
  if (has_nan(c)) throw InvalidArgument("configuration", "NaN", "numbers");
  const Spans k = spans(g, c);
  const double reach = platform_reach(k);
  // Three rows for each leg: its direction, or for a leg of zero length all of space. Columns L omega, v_O, sdot.
  Eigen::Matrix<double, 27, 9> h = Eigen::Matrix<double, 27, 9>::Zero();
  const auto along = [](const Span& leg) -> Mat3 {
    if (leg.length == 0.0) return Mat3::Identity();
    Mat3 row = Mat3::Zero();
    row.row(0) = leg.direction.transpose();
    return row;
  };
  for (std::size_t i = 0; i < 3; ++i) {
    const auto row = static_cast<Eigen::Index>(9 * i);
    const Mat3 external = along(k.external[i]), upper = along(k.upper[i]), lower = along(k.lower[i]);
    h.block<3, 3>(row, 0) = -external * skew((k.w[i].length / reach) * k.w[i].direction);
    h.block<3, 3>(row, 3) = external;
    h.block<3, 3>(row + 3, 3) = -upper;
    h.block<3, 3>(row + 3, 6) = upper;
    h.block<3, 3>(row + 6, 6) = lower;
  }
  const auto [sigma, v] = right_svd(h);
  std::vector<Vec9> out;
  for (Eigen::Index n = 8; n >= 0 && sigma[n] <= tolerance; --n) {
    const Vec9 x = v.col(n);
    const Velocity rates = motion_from(x.head<3>() / reach, x.segment<3>(3), x.tail<3>(), reach, c);
    Vec9 motion;
    motion << rates.omega, rates.pdot, rates.sdot;
    out.push_back(motion);
  }
  return out;
}

}  // namespace ninedof
