#include "conditioning/forms/gram.hpp"

#include <algorithm>
#include <cmath>

#include "math/linear/jacobi_svd.hpp"

namespace ninedof::forms {
namespace {

const PoseForm& at(const Symmetric3& s, std::size_t i, std::size_t j) {
  return s[entry(i, j)];
}

template <class T>
void add_square(Symmetric3Of<T>& s, const Xyz<T>& v) {
  const std::array<const T*, 3> x{&v.x, &v.y, &v.z};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j <= i; ++j) s[entry(i, j)] = s[entry(i, j)] + *x[i] * *x[j];
}

Symmetric3 inverted(const Symmetric3& s) {
  const auto minor = [&](std::size_t i, std::size_t j, std::size_t k, std::size_t l) {
    return at(s, i, k) * at(s, j, l) - at(s, i, l) * at(s, j, k);
  };
  const Symmetric3 adjugate{minor(1, 2, 1, 2), -minor(0, 2, 1, 2), minor(0, 2, 0, 2),
                            minor(0, 1, 1, 2), -minor(0, 1, 0, 2), minor(0, 1, 0, 1)};
  const PoseForm one_over = inverse(at(s, 0, 0) * adjugate[0] + at(s, 1, 0) * adjugate[1] + at(s, 2, 0) * adjugate[3]);
  Symmetric3 out;
  for (std::size_t k = 0; k < 6; ++k) out[k] = one_over * adjugate[k];
  return out;
}

/// H - H (H + F)^-1 H
Symmetric3 parallel(const Symmetric3& h, const Symmetric3& f) {
  Symmetric3 sum;
  for (std::size_t k = 0; k < 6; ++k) sum[k] = h[k] + f[k];
  const Symmetric3 x = inverted(sum);
  std::array<std::array<PoseForm, 3>, 3> xh;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      xh[i][j] = at(x, i, 0) * at(h, 0, j) + at(x, i, 1) * at(h, 1, j) + at(x, i, 2) * at(h, 2, j);
  Symmetric3 out;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j <= i; ++j)
      out[entry(i, j)] = at(h, i, j) - (at(h, i, 0) * xh[0][j] + at(h, i, 1) * xh[1][j] + at(h, i, 2) * xh[2][j]);
  return out;
}

}  // namespace

template <class T, class Robot>
LegProducts<T> leg_products(const Robot& g, double characteristic_length, const PoseOf<T>& pose, Moves& moves) {
  const double inverse_lc = 1.0 / characteristic_length;
  const auto direction = [&](int k) {
    const Ends<T> e = ends_of(g, pose, k);
    const Xyz<T> out = direction_of(e.to - e.from);
    moves.add(out);
    return out;
  };
  LegProducts<T> out;
  for (int i = 0; i < 3; ++i) {
    const Xyz<T> e = direction(i), u = arm_at(g, pose, point_u + i);
    const Xyz<T> m = inverse_lc * cross(u, e);
    const std::array<const T*, 6> row{&m.x, &m.y, &m.z, &e.x, &e.y, &e.z};
    for (std::size_t j = 0; j < 6; ++j)
      for (std::size_t k = 0; k <= j; ++k) out.external[entry(j, k)] = out.external[entry(j, k)] + *row[j] * *row[k];
    add_square(out.upper, direction(i + 3));
    add_square(out.lower, direction(i + 6));
  }
  return out;
}

template LegProducts<PoseForm> leg_products(const AsBuilt&, double, const PoseOf<PoseForm>&, Moves&);
template LegProducts<CurvedForm> leg_products(const AsBuilt&, double, const PoseOf<CurvedForm>&, Moves&);
template LegProducts<DesignForm> leg_products(const JointsOf<DesignForm>&, double, const PoseOf<DesignForm>&, Moves&);
template LegProducts<CurvedForm> leg_products(const JointsOf<CurvedForm>&, double, const PoseOf<CurvedForm>&, Moves&);

Symmetric6 gram(const Geometry& g, double characteristic_length, const FormPose& pose, Moves& moves) {
  const double inverse_lc = 1.0 / characteristic_length;
  const LegProducts<PoseForm> legs = leg_products(AsBuilt{g}, characteristic_length, pose, moves);
  Symmetric6 out = legs.external;
  const Symmetric3 p = parallel(legs.upper, legs.lower);
  const FormVector y = inverse_lc * (pose.s - pose.p);
  // Columns of K: e_k x y for turns, e_k for shifts.
  const PoseForm zero = 0.0;
  const std::array<FormVector, 3> turn{FormVector{zero, -y.z, y.y}, FormVector{y.z, zero, -y.x},
                                       FormVector{-y.y, y.x, zero}};
  std::array<FormVector, 3> p_turn;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto row = [&](std::size_t i) {
      return at(p, i, 0) * turn[k].x + at(p, i, 1) * turn[k].y + at(p, i, 2) * turn[k].z;
    };
    p_turn[k] = {row(0), row(1), row(2)};
  }
  for (std::size_t j = 0; j < 3; ++j)
    for (std::size_t k = 0; k <= j; ++k) {
      out[entry(j, k)] = out[entry(j, k)] + dot(turn[j], p_turn[k]);
      out[entry(j + 3, k + 3)] = out[entry(j + 3, k + 3)] + at(p, j, k);
    }
  for (std::size_t k = 0; k < 3; ++k) {
    out[entry(3, k)] = out[entry(3, k)] + p_turn[k].x;
    out[entry(4, k)] = out[entry(4, k)] + p_turn[k].y;
    out[entry(5, k)] = out[entry(5, k)] + p_turn[k].z;
  }
  return out;
}

double condition_attained(const Symmetric6& g) {
  const Mat6 middle = middle_of(g);
  if (!middle.allFinite()) return 0.0;
  const RightSvd<6> eigen = jacobi_right_svd(middle);
  // The greatest eigenvalue is no less, the least no more, than the Rayleigh quotient of any vector.
  const auto quotient = [&](Eigen::Index column) {
    const Vec6 v = eigen.v.col(column);
    Interval sum, square_sum;
    for (std::size_t i = 0; i < 6; ++i) {
      const Interval x(v[static_cast<Eigen::Index>(i)]);
      square_sum += square(x);
      for (std::size_t j = 0; j < 6; ++j) {
        const PoseForm& e = g[entry(i, j)];
        sum += Interval(lower(e), upper(e)) * (x * Interval(v[static_cast<Eigen::Index>(j)]));
      }
    }
    return sum / square_sum;
  };
  const Interval most = quotient(0), least = max(quotient(5), 0.0);
  return most.lo > 0.0 ? sqrt(most / Interval(least.hi)).lo : 0.0;
}

}  // namespace ninedof::forms
