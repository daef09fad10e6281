#pragma once
/// The singular values of M with their slopes by all points (docs/theory/conditioning.md): Spectrum and
/// add_spectrum_gradient of conditioning/sensitivity.hpp in every lane.

#include "batch/kernels/conditioning_matrix.hpp"

namespace ninedof::kernels::inline NINEDOF_LEVEL {

/// A 6x6 matrix by columns, each times the root of its weight, and the same combinations of the unit vectors.
template <class P>
struct WeightedColumns {
  P column[6][12], weight[6], squared_norm[6];

  NINEDOF_INLINE explicit WeightedColumns(const P (&m)[6][6]) {
    for (int k = 0; k < 6; ++k) {
      weight[k] = 1.0;
      for (int i = 0; i < 6; ++i) {
        column[k][i] = m[i][k];
        column[k][6 + i] = i == k ? 1.0 : 0.0;
      }
    }
  }

  NINEDOF_INLINE P product(const P* a, const P* b) const {
    return ((a[0] * b[0] + a[1] * b[1]) + (a[2] * b[2] + a[3] * b[3])) + (a[4] * b[4] + a[5] * b[5]);
  }
  NINEDOF_INLINE void refresh_norms() {
    for (int k = 0; k < 6; ++k) squared_norm[k] = weight[k] * product(column[k], column[k]);
  }

  /// The rotations of math/linear/svd6.cpp. A lane that has converged is left alone: it must not depend on the others.
  NINEDOF_INLINE void sweep_until_orthogonal() {
    constexpr int pairs[15][2] = {{0, 5}, {1, 4}, {2, 3}, {0, 4}, {5, 3}, {1, 2}, {0, 3}, {4, 2},
                                  {5, 1}, {0, 2}, {3, 1}, {4, 5}, {0, 1}, {2, 5}, {3, 4}};
    constexpr int most_sweeps = 30;
    typename P::Mask open = P(0.0) < P(1.0);
    for (int sweep = 0; sweep < most_sweeps && any(open); ++sweep) {
      refresh_norms();
      typename P::Mask far = P(1.0) < P(0.0);
      for (const auto& [i, j] : pairs) {
        P *const a = column[i], *const b = column[j];
        P &aa = squared_norm[i], &bb = squared_norm[j];
        const P dot = product(a, b), weights = weight[i] * weight[j], ab2 = weights * dot * dot, norms = aa * bb;
        far = far | (ab2 > 1e-17 * norms);
        const P difference = bb - aa;
        const P denominator = abs(difference) + sqrt(difference * difference + 4.0 * ab2);
        const P g = select(open & (ab2 > 1e-31 * norms), copysign(P(2.0), difference) * dot / denominator, P(0.0));
        const P ti = g * weight[j], tj = g * weight[i], cosine2 = 1.0 / (1.0 + ti * tj), moved = g * weights * dot;
        for (int n = 0; n < 12; ++n) {
          const P old = a[n];
          a[n] = old - ti * b[n];
          b[n] = b[n] + tj * old;
        }
        weight[i] *= cosine2;
        weight[j] *= cosine2;
        aa -= moved;
        bb += moved;
      }
      open = open & far;
    }
    refresh_norms();
  }
};

/// The velocity of O that makes the rates of the internal legs least for a twist: least squares by L D L^T.
template <class P>
struct BestVelocity {
  P d0, d1, d2, l10, l20, l21;

  /// From the rows of C and B.
  NINEDOF_INLINE explicit BestVelocity(const Xyz<P>* row) {
    P xx = 0.0, xy = 0.0, xz = 0.0, yy = 0.0, yz = 0.0, zz = 0.0;
    for (int k = 0; k < 6; ++k) {
      xx += row[k].x * row[k].x;
      xy += row[k].x * row[k].y;
      xz += row[k].x * row[k].z;
      yy += row[k].y * row[k].y;
      yz += row[k].y * row[k].z;
      zz += row[k].z * row[k].z;
    }
    d0 = 1.0 / xx;
    l10 = d0 * xy;
    l20 = d0 * xz;
    d1 = 1.0 / (yy - l10 * xy);
    const P rest = yz - l20 * xy;
    l21 = d1 * rest;
    d2 = 1.0 / (zz - l20 * xz - l21 * rest);
  }
  /// Whether no digits were lost to speak of. Each row is a unit vector.
  NINEDOF_INLINE typename P::Mask clear() const {
    const P most = max(max(d0, d1), d2);
    return (most < 1e4) & (min(min(d0, d1), d2) > 0.0);
  }
  NINEDOF_INLINE Xyz<P> of(const Xyz<P>& right) const {
    const P y = right.y - l10 * right.x, z = d2 * (right.z - l20 * right.x - l21 * y);
    const P second = d1 * y - l21 * z;
    return {d0 * right.x - l10 * second - l20 * z, second, z};
  }
};

/// The numbers of a row of Table::spectra: those of each singular value, in no order.
template <class P>
NINEDOF_INLINE void spectrum(const double (&points)[42][P::lanes], const P& length,
                             double (&out)[spectrum_numbers][P::lanes]) {
  const auto point = [&](int k) {
    return Xyz<P>{P::load(points[3 * k]), P::load(points[3 * k + 1]), P::load(points[3 * k + 2])};
  };
  constexpr int u = 6, u_tilde = 9, point_p = 12, point_s = 13;  // robot/points.hpp
  const auto from_of = [](int leg) { return leg < 3 ? leg : leg < 6 ? u_tilde + leg - 3 : leg - 3; };
  const auto to_of = [](int leg) { return leg < 3 ? u + leg : point_s; };
  const P inverse_lc = 1.0 / length;
  const Xyz<P> p = point(point_p), lever = inverse_lc * (point(point_s) - p);
  SquaredLengths<P> lengths;
  Xyz<P> e[9], w[3];
  P inverse[9], m[6][6];
  for (int k = 0; k < 9; ++k) {
    const Xyz<P> leg = point(to_of(k)) - point(from_of(k));
    inverse[k] = 1.0 / sqrt(lengths.of(leg));
    e[k] = inverse[k] * leg;
  }
  shared_rows<P>({e[3], e[4], e[5]}, {e[6], e[7], e[8]}, w);
  for (int k = 0; k < 3; ++k) {
    set_row(m[k], inverse_lc * cross(point(u + k) - p, e[k]), e[k]);
    set_row(m[k + 3], cross(lever, w[k]), w[k]);
  }
  WeightedColumns<P> svd(m);
  svd.sweep_until_orthogonal();
  const BestVelocity<P> best(e + 3);
  P least = svd.squared_norm[0], greatest = least;
  for (int k = 1; k < 6; ++k) {
    least = min(least, svd.squared_norm[k]);
    greatest = max(greatest, svd.squared_norm[k]);
  }
  constexpr double most_condition = 1e6, most_lever = 16.0;  // beyond, rounding errors are too large
  const auto sure = lengths.clear() & best.clear() & (least * (most_condition * most_condition) >= greatest) &
                    (dot(lever, lever) <= (most_lever * most_lever) * greatest);
  for (int k = 0; k < 6; ++k) {
    double (*to)[P::lanes] = out + k * sigma_numbers;
    const auto put = [&](const P& x) { store(x, *to++); };
    const auto put_all = [&](const Xyz<P>& x) { put(x.x), put(x.y), put(x.z); };
    const P root = sqrt(svd.weight[k]), *v = svd.column[k] + 6;
    const Xyz<P> turn = root * Xyz<P>{v[0], v[1], v[2]}, omega = inverse_lc * turn;
    const Xyz<P> pdot = root * Xyz<P>{v[3], v[4], v[5]};
    put(select(sure, svd.squared_norm[k], P(unsure)));
    put_all(turn);
    put_all(pdot);
    Xyz<P> velocity[9], right{P(0.0), P(0.0), P(0.0)};
    for (int n = 0; n < 6; ++n) {
      velocity[n] = pdot + cross(omega, point(u + n) - p);
      if (n >= 3) right = right + dot(e[n], velocity[n]) * e[n];
    }
    const Xyz<P> sdot = best.of(right);
    put_all(sdot);
    // d(log sigma) = sum (leg rate) d(leg rate) / sigma^2
    Xyz<P> slope[14];
    for (auto& s : slope) s = {P(0.0), P(0.0), P(0.0)};
    P by_length = 0.0;
    const P scale = 1.0 / svd.squared_norm[k];
    for (int n = 0; n < 9; ++n) {
      if (n >= 3) velocity[n] = n < 6 ? sdot - velocity[n] : sdot;
      const P rate = dot(e[n], velocity[n]), weight = scale * rate;
      put(rate);
      const Xyz<P> turning = (weight * inverse[n]) * (velocity[n] - rate * e[n]);
      slope[to_of(n)] = slope[to_of(n)] + turning;
      slope[from_of(n)] = slope[from_of(n)] - turning;
      if (n >= 6) continue;
      const int joint = n < 3 ? to_of(n) : from_of(n);
      const Xyz<P> moment = (n < 3 ? weight : -weight) * cross(e[n], omega);
      slope[joint] = slope[joint] + moment;
      slope[point_p] = slope[point_p] - moment;
      by_length -= inverse_lc * dot(point(joint) - p, moment);
    }
    for (const Xyz<P>& s : slope) put_all(s);
    put(by_length);
  }
}

}  // namespace ninedof::kernels::inline NINEDOF_LEVEL
