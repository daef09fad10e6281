/// M^T M between bounds, and directions of vectors. Declared in conditioning/forms/gram.hpp.

#include <Eigen/LU>
#include <cmath>

#include "conditioning/forms/gram.hpp"
#include "math/numbers.hpp"

namespace ninedof::forms {
namespace {

template <class T>
using Columns = std::array<Xyz<T>, 6>;

template <class T>
const T& of(const std::array<T, 6>& s, std::size_t i, std::size_t j) {
  return s[entry(i, j)];
}
template <class T>
Xyz<T> applied(const std::array<T, 6>& s, const Xyz<T>& v) {
  const auto row = [&](std::size_t i) { return of(s, i, 0) * v.x + of(s, i, 1) * v.y + of(s, i, 2) * v.z; };
  return {row(0), row(1), row(2)};
}
template <class T>
Xyz<T> applied(const Mat3& m, const Xyz<T>& v) {
  const auto row = [&](Eigen::Index i) { return m(i, 0) * v.x + m(i, 1) * v.y + m(i, 2) * v.z; };
  return {row(0), row(1), row(2)};
}
template <class T>
Mat3 middle_of(const std::array<T, 6>& s) {
  Mat3 out;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) out(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) = of(s, i, j).c;
  return out;
}
/// At most the length of what the vector may be away from its middle.
template <class T>
double wandering(const Xyz<T>& v) {
  double sum = 0.0;
  for (const T* x : {&v.x, &v.y, &v.z}) sum += radius(*x) * radius(*x);
  return std::sqrt(sum) * (1.0 + 0x1p-48);
}

/// At least the length of a 3 x 6 matrix times a unit vector.
template <class T>
double reach_of(const Columns<T>& columns) {
  double squares = 0.0;
  for (const Xyz<T>& v : columns)
    for (const T* x : {&v.x, &v.y, &v.z}) {
      const double most = std::abs(x->c) + radius(*x);
      squares += most * most;
    }
  return std::sqrt(squares) * (1.0 + 0x1p-45);
}

/// e + P d / l - ((e . d) P d + |P d|^2 e / 2) / l^2 of v = l e + d, with P = 1 - e e^T, and a rest below
/// (away / nearest)^3 / 2.
template <class T>
Xyz<T> curved_direction(const Xyz<T>& v, const std::array<double, 3>& e, double length, double away, double nearest) {
  std::array<T, 3> d{v.x, v.y, v.z};
  for (T& x : d) x.c = 0.0;
  const T along = e[0] * d[0] + e[1] * d[1] + e[2] * d[2];
  const double inverse = 1.0 / length, part = away / nearest;
  T square = 0.0;
  for (std::size_t i = 0; i < 3; ++i) {
    d[i] = inverse * (d[i] - e[i] * along);
    square = square + d[i] * d[i];
  }
  const T shrunk = 1.0 - inverse * along, half = 0.5 * square;
  for (std::size_t i = 0; i < 3; ++i) {
    d[i] = shrunk * d[i] - e[i] * half;
    d[i].c += e[i];
    d[i].r += (0.5 * part * part * part + 2.0 * forms::grain * (1.0 + part) * (1.0 + part)) * (1.0 + forms::grain);
  }
  return {d[0], d[1], d[2]};
}

}  // namespace

template <class T>
Xyz<T> direction_of(const Xyz<T>& v) {
  const double x = v.x.c, y = v.y.c, z = v.z.c, length = std::sqrt(x * x + y * y + z * z);
  const double away = wandering(v), nearest = length * (1.0 - 0x1p-48) - away;
  // Squares of numbers outside this range may be no doubles.
  if (!(length > 1e-140 && length < 1e140 && nearest > 0.0 && std::isfinite(away)))
    return {T::unknown(), T::unknown(), T::unknown()};
  const std::array<double, 3> e{x / length, y / length, z / length};
  if constexpr (T::curved) return curved_direction(v, e, length, away, nearest);
  const std::array<const T*, 3> part{&v.x, &v.y, &v.z};
  // e(v) = e + (1 - e e^T)(v - middle) / length + a rest below |v - middle|^2 / (sqrt(3) nearest^2).
  const double rest = 0.5774 * away * away / (nearest * nearest) * (1.0 + forms::grain);
  std::array<T, 3> out;
  for (std::size_t i = 0; i < 3; ++i) {
    T& f = out[i];
    f.c = e[i];
    double error = part[i]->r;
    for (std::size_t j = 0; j < 3; ++j) error += std::abs(e[i] * e[j]) * part[j]->r;
    for (std::size_t k = 0; k < T::size; ++k) {
      double along = 0.0;
      for (std::size_t j = 0; j < 3; ++j) along += e[j] * part[j]->a[k];
      f.a[k] = (part[i]->a[k] - e[i] * along) / length;
    }
    f.r = (rest + error / length) * (1.0 + forms::grain) + forms::grain * (1.0 + away / length) + forms::tiny;
  }
  return {out[0], out[1], out[2]};
}

namespace {

/// v without its part along a unit vector.
template <class T>
Xyz<T> across_of(const Xyz<T>& unit, const Xyz<T>& v) {
  return v - dot(unit, v) * unit;
}

/// What a leg leaves to O: all velocities, or with the leg locked those across it.
template <class T>
struct Freedom {
  bool locked = false;
  Xyz<T> along{};
  Xyz<T> left(const Xyz<T>& v) const { return locked ? across_of(along, v) : v; }
};

/// P S P + c c^T for P = 1 - c c^T: as S for vectors across c, apart from c.
template <class T>
void keep_across(const Xyz<T>& c, Symmetric3Of<T>& s) {
  const std::array<T, 3> e{c.x, c.y, c.z};
  std::array<Xyz<T>, 3> rows;
  for (std::size_t i = 0; i < 3; ++i) rows[i] = across_of(c, Xyz<T>{of(s, i, 0), of(s, i, 1), of(s, i, 2)});  // S P
  for (std::size_t j = 0; j < 3; ++j) {
    const auto part = [&](std::size_t i) { return j == 0 ? rows[i].x : j == 1 ? rows[i].y : rows[i].z; };
    const T along = e[0] * part(0) + e[1] * part(1) + e[2] * part(2);
    for (std::size_t i = j; i < 3; ++i) s[entry(i, j)] = part(i) - e[i] * along + e[i] * e[j];
  }
}

/// The best share S of K x that moves, of the least of (K x - S K x)^T other (..) + (S K x)^T own (..) in the middle.
template <class T>
Mat3 best_share(const Mat3& sum, const Mat3& other, const Freedom<T>& freedom) {
  // A little on the diagonal: where H + F is nearly singular the best one is of no use.
  const Mat3 middle = sum + 1e-7 * sum.trace() * Mat3::Identity();
  if (!freedom.locked) return middle.inverse() * other;
  const Vec3 c = Vec3(freedom.along.x.c, freedom.along.y.c, freedom.along.z.c).normalized();
  const Mat3 plane = Mat3::Identity() - c * c.transpose();
  return (plane * middle * plane + middle.trace() * c * c.transpose()).inverse() * plane * other;
}

}  // namespace

template <class T, class Robot>
SplitGramOf<T> split_gram(const Robot& g, double characteristic_length, const PoseOf<T>& pose, Moves& moves,
                          int locked) {
  const double inverse_lc = 1.0 / characteristic_length;
  const LegProducts<T> legs = leg_products(g, characteristic_length, pose, moves);
  const Symmetric3Of<T>&h = legs.upper, &f = legs.lower;
  SplitGramOf<T> out;
  out.external = legs.external;
  for (std::size_t n = 0; n < out.sum.size(); ++n) out.sum[n] = h[n] + f[n];
  Freedom<T> freedom{locked >= 0};
  if (freedom.locked) {
    const Ends<T> e = ends_of(g, pose, locked);
    freedom.along = direction_of(e.to - e.from);
  }
  // Any share gives bounds. That of the locked side is across its leg.
  const bool of_upper = locked >= 3 && locked < 6;
  const Mat3 share = best_share(middle_of(out.sum), middle_of(of_upper ? f : h), freedom);
  if (!share.allFinite()) return out;
  out.known = true;
  const Xyz<T> y = inverse_lc * (pose.s - pose.p);
  const T zero = 0.0, one = 1.0;
  // Columns of K: e_k x y for turns, e_k for shifts.
  const Columns<T> k{Xyz<T>{zero, -y.z, y.y}, Xyz<T>{y.z, zero, -y.x}, Xyz<T>{-y.y, y.x, zero},
                     Xyz<T>{one, zero, zero}, Xyz<T>{zero, one, zero}, Xyz<T>{zero, zero, one}};
  Columns<T> upper, lower, upper_pull, lower_pull;
  for (std::size_t j = 0; j < 6; ++j) {
    (of_upper ? upper : lower)[j] = freedom.left(applied(share, k[j]));
    if (of_upper) lower[j] = k[j] - upper[j];
    else upper[j] = k[j] - lower[j];
    upper_pull[j] = applied(h, upper[j]);
    lower_pull[j] = applied(f, lower[j]);
    const Xyz<T> across = freedom.left(lower_pull[j] - upper_pull[j]);
    out.across[0][j] = across.x;
    out.across[1][j] = across.y;
    out.across[2][j] = across.z;
  }
  for (std::size_t j = 0; j < 6; ++j)
    for (std::size_t i = 0; i <= j; ++i)
      out.above[entry(j, i)] = out.external[entry(j, i)] + dot(upper[i], upper_pull[j]) + dot(lower[i], lower_pull[j]);
  if constexpr (T::curved) {
    out.upper_reach = reach_of(upper);
    out.lower_reach = reach_of(lower);
  }
  if (freedom.locked) keep_across(freedom.along, out.sum);
  return out;
}

Looseness looseness(const AsBuilt& g, double characteristic_length, const PoseOf<CurvedForm>& pose,
                    const SplitGramOf<CurvedForm>& drawn) {
  const AsBuilt nominal{g.nominal};
  double fixed = 0.0, moved = 0.0;
  for (int leg = 0; leg < 9; ++leg) {
    const LegEnds joints = leg_ends(leg);
    double off = 0.0;
    for (const int joint : {joints.from, joints.to})
      if (joint != point_s) off += g.radius[static_cast<std::size_t>(joint)];
    const Ends<CurvedForm> ends = ends_of(nominal, pose, leg);
    const Xyz<CurvedForm> v = ends.to - ends.from;
    const double nearest = centre(v).norm() * (1.0 - 0x1p-48) - wandering(v);
    // A direction turns by at most an angle whose sine is off / length.
    const double turn = nearest > off ? off / (nearest - off) : infinity;
    if (leg < 3) {
      const double arm = joint_of(g.nominal, point_u + leg).norm() / characteristic_length;
      const double row =
          turn * std::sqrt(1.0 + arm * arm) + g.radius[static_cast<std::size_t>(point_u + leg)] / characteristic_length;
      fixed += row * row;
    } else {
      const double row = turn * (leg < 6 ? drawn.upper_reach : drawn.lower_reach);
      fixed += row * row;
      moved += turn * turn;
    }
  }
  return {std::sqrt(fixed) * (1.0 + 0x1p-40), std::sqrt(moved) * (1.0 + 0x1p-40)};
}

template Xyz<PoseForm> direction_of(const Xyz<PoseForm>&);
template Xyz<CurvedForm> direction_of(const Xyz<CurvedForm>&);
template Xyz<DesignForm> direction_of(const Xyz<DesignForm>&);
template SplitGram split_gram(const AsBuilt&, double, const PoseOf<PoseForm>&, Moves&, int);
template SplitGramOf<CurvedForm> split_gram(const AsBuilt&, double, const PoseOf<CurvedForm>&, Moves&, int);
template SplitGramOf<DesignForm> split_gram(const JointsOf<DesignForm>&, double, const PoseOf<DesignForm>&, Moves&,
                                            int);
template SplitGramOf<CurvedForm> split_gram(const JointsOf<CurvedForm>&, double, const PoseOf<CurvedForm>&, Moves&,
                                            int);

}  // namespace ninedof::forms
