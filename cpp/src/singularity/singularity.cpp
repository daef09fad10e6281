#include "ninedof/singularity/singularity.hpp"

#include <Eigen/Geometry>
#include <cmath>

#include "math/linear/jacobi_svd.hpp"
#include "math/numbers.hpp"
#include "ninedof/math/error.hpp"
#include "ninedof/math/rotation.hpp"
#include "singularity/unit_rows.hpp"

namespace ninedof {
namespace {

/// A smallest singular value up to this is rounding: the rows have length 1 and a few roundings each.
constexpr double lost = 64.0 * eps;

bool has_nan(const Configuration& c) {
  return c.position.hasNaN() || c.rotation.hasNaN() || c.internal_point.hasNaN();
}

PerMechanism margins_of(const UnitRows& rows) {
  return {determinant(rows.n), determinant(rows.b), determinant(rows.c)};
}

/// The weakest of the three. Of several that are lost the first of n, c, b: a turn about O leaves the internal legs
/// alone, and the motion of C or B needs N to be regular.
Mechanism weakest(const PerMechanism& sigma) {
  if (sigma.n <= lost) return Mechanism::n;
  if (sigma.c <= lost) return Mechanism::c;
  if (sigma.b <= lost) return Mechanism::b;
  if (sigma.n <= sigma.b && sigma.n <= sigma.c) return Mechanism::n;
  return sigma.c <= sigma.b ? Mechanism::c : Mechanism::b;
}

/// L, the root mean square distance of the six platform joints from O.
double platform_reach(const Spans& k) {
  double sum = 0.0;
  for (std::size_t i = 0; i < 3; ++i) sum += k.w[i].length * k.w[i].length + k.upper[i].length * k.upper[i].length;
  return std::sqrt(sum / 6.0);
}

bool has_leg_of_zero_length(const Spans& k, Mechanism mechanism) {
  const auto& legs = mechanism == Mechanism::n ? k.external : mechanism == Mechanism::b ? k.lower : k.upper;
  return legs[0].length == 0.0 || legs[1].length == 0.0 || legs[2].length == 0.0;
}

/// (omega, v_O, sdot) scaled to the length described in the header, as (omega, pdot, sdot).
Velocity motion_from(const Vec3& omega, const Vec3& at_o, const Vec3& sdot, double reach, const Configuration& c) {
  const double length = std::sqrt(omega.squaredNorm() + (at_o.squaredNorm() + sdot.squaredNorm()) / (reach * reach));
  const Vec3 y = c.internal_point - c.position;
  return {omega / length, (at_o + y.cross(omega)) / length, sdot / length};
}

/// The least-squares solution of least norm, from the decomposition of the matrix.
Vec3 solve(const Svd<3>& svd, const Vec3& b) {
  const Eigen::Index rank = svd.rank(3.0 * eps);
  const Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 3, 1> scaled =
      svd.sigma.head(rank).asDiagonal().inverse() * (svd.u.leftCols(rank).transpose() * b);
  return svd.v.leftCols(rank) * scaled;
}

}  // namespace

const char* to_string(Mechanism mechanism) {
  switch (mechanism) {
    case Mechanism::n: return "n";
    case Mechanism::b: return "b";
    case Mechanism::c: return "c";
    case Mechanism::none: break;
  }
  return "";
}

PerMechanism singularity_margins(const Geometry& g, const Configuration& c) {
  if (has_nan(c)) return {not_a_number, not_a_number, not_a_number};
  return margins_of(unit_rows(spans(g, c)));
}

SingularityReport singularity(const Geometry& g, const Configuration& c) {
  constexpr PerMechanism nothing{not_a_number, not_a_number, not_a_number};
  const Vec3 unknown = Vec3::Constant(not_a_number);
  SingularityReport out{nothing, nothing, Mechanism::none, {unknown, unknown, unknown}};
  if (has_nan(c)) return out;
  const Spans k = spans(g, c);
  const UnitRows rows = unit_rows(k);
  const Svd<3> svd_n = jacobi_svd(rows_of(rows.n)), svd_b = jacobi_svd(rows_of(rows.b)),
               svd_c = jacobi_svd(rows_of(rows.c));
  out.margins = margins_of(rows);
  out.sigma = {svd_n.sigma[2], svd_b.sigma[2], svd_c.sigma[2]};
  out.mechanism = weakest(out.sigma);
  if (has_leg_of_zero_length(k, out.mechanism)) return out;
  Vec3 omega, at_o = Vec3::Zero(), sdot = Vec3::Zero();
  if (out.mechanism == Mechanism::n) {
    omega = svd_n.v.col(2);
  } else {
    // The upper legs keep their lengths because v_O = sdot (B) or C v_O = 0 (C). The external legs keep theirs if
    // N' omega = -E_e v_O with rows w_i x e_i and e_i; here row i is multiplied by l_i / (|d_i| |w_i|).
    at_o = (out.mechanism == Mechanism::b ? svd_b : svd_c).v.col(2);
    if (out.mechanism == Mechanism::b) sdot = at_o;
    Vec3 pull;
    for (std::size_t i = 0; i < 3; ++i)
      pull[static_cast<Eigen::Index>(i)] =
          -(k.external[i].length / k.d[i].length / k.w[i].length) * k.external[i].direction.dot(at_o);
    omega = solve(svd_n, pull);
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
  const auto [sigma, v] = jacobi_right_svd(h);
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
