#include "proof/admissible/designs.hpp"

#include <algorithm>
#include <numbers>

#include "ninedof/families/general_family.hpp"
#include "ninedof/families/hexagonal_family.hpp"
#include "ninedof/families/symmetric_family.hpp"
#include "ninedof/math/error.hpp"

namespace ninedof::admissible {
namespace {

/// Three joints from the first: -120 degrees at a time, as eqs. (37)-(38) number them.
template <class T>
void put_orbit(const Xyz<T>& first, int triple, JointsOf<T>& out) {
  constexpr double half_root = 0.5 * std::numbers::sqrt3;
  const std::array<double, 3> cosine{1.0, -0.5, -0.5}, sine{0.0, -half_root, half_root};
  for (std::size_t i = 0; i < 3; ++i)
    out[at_index(triple) + i] =
        i == 0 ? first
               : Xyz<T>{cosine[i] * first.x - sine[i] * first.y, sine[i] * first.x + cosine[i] * first.y, first.z};
}

template <class T>
struct Blueprints {
  JointsOf<T> joints;
  T zp, zs, theta_z;
};

template <class Family, std::size_t N, class T>
bool put_symmetric(const DesignFamily& family, std::span<const T> x, Blueprints<T>& out) {
  const auto* one = dynamic_cast<const Family*>(&family);
  if (one == nullptr) return false;
  const Orbits<T> o = one->template orbits<T>(x.template first<N>());
  put_orbit(o.base_external, point_r, out.joints);
  put_orbit(o.base_internal, point_r_hat, out.joints);
  put_orbit(o.platform_external, point_u, out.joints);
  put_orbit(o.platform_internal, point_u_tilde, out.joints);
  out.zp = o.zp;
  out.zs = o.zs;
  out.theta_z = o.theta_z;
  return true;
}

template <class T>
Blueprints<T> blueprints(const DesignFamily& family, std::span<const T> x) {
  Blueprints<T> out;
  if (put_symmetric<HexagonalFamily, 7>(family, x, out) || put_symmetric<SymmetricFamily<9>, 9>(family, x, out) ||
      put_symmetric<SymmetricFamily<13>, 13>(family, x, out))
    return out;
  if (dynamic_cast<const GeneralFamily*>(&family) == nullptr)
    throw InvalidArgument("family", family.name(), "a family whose joints are known over boxes of designs");
  for (std::size_t k = 0; k < out.joints.size(); ++k) out.joints[k] = {x[3 * k], x[3 * k + 1], x[3 * k + 2]};
  out.zp = x[row_zp];
  out.zs = x[row_zs];
  out.theta_z = x[row_theta_z];
  return out;
}

template <class T>
using RowsOf = std::array<Xyz<T>, 3>;

/// The rotation by w: 1 + S w x + C w x w x with S = sin a / a, C = 2 (sin(a/2) / a)^2, a = |w|. A matrix of doubles
/// would be another one.
template <class T>
RowsOf<T> rotation_rows(const Vec3& w) {
  const Interval x = w.x(), y = w.y(), z = w.z(), u = square(x) + square(y) + square(z), angle = sqrt(u);
  const auto mean = [](const Interval& a) { return a.lo > 0.0 ? sin(a) / a : Interval(0.0, 1.0); };
  const Interval s = mean(angle), c = 0.5 * square(mean(0.5 * angle)), rest = 1.0 - c * u;
  const auto row = [](const Interval& a, const Interval& b, const Interval& d) {
    return Xyz<T>{T::of(a), T::of(b), T::of(d)};
  };
  return {row(rest + c * square(x), c * (x * y) - s * z, c * (x * z) + s * y),
          row(c * (x * y) + s * z, rest + c * square(y), c * (y * z) - s * x),
          row(c * (x * z) - s * y, c * (y * z) + s * x, rest + c * square(z))};
}
template <class T>
Xyz<T> times(const RowsOf<T>& m, const Xyz<T>& v) {
  return {dot(m[0], v), dot(m[1], v), dot(m[2], v)};
}
template <class T>
RowsOf<T> transposed(const RowsOf<T>& m) {
  return {Xyz<T>{m[0].x, m[1].x, m[2].x}, Xyz<T>{m[0].y, m[1].y, m[2].y}, Xyz<T>{m[0].z, m[1].z, m[2].z}};
}

}  // namespace

DesignBox range_of(const DesignQuestion& question) {
  DesignBox out;
  std::ranges::copy(question.low, out.low.begin());
  std::ranges::copy(question.high, out.high.begin());
  return out;
}

DesignBox middle_of(const DesignBox& box, std::size_t dimensions) {
  DesignBox out = box;
  for (std::size_t k = 0; k < dimensions; ++k) out.low[k] = out.high[k] = 0.5 * (box.low[k] + box.high[k]);
  return out;
}

template <class T>
DesignsOf<T> design_forms(const DesignQuestion& question, const DesignBox& box) {
  std::vector<T> x(question.at.begin(), question.at.end());
  for (std::size_t k = 0; k < question.varied.size(); ++k)
    x[at_index(question.varied[k])] = T::coordinate(box.low[k], box.high[k], T::size - most_varied + k);
  const Blueprints<T> own = blueprints<T>(design_family(question.problem.family), x);
  const Tool& tool = question.problem.tool;
  const T zero = 0.0, one = 1.0;
  DesignsOf<T> out{own.joints, own.joints, {}, own.zp, own.zs, design_family(question.problem.family).symmetric()};
  const bool twisted = own.theta_z.c != 0.0 || radius(own.theta_z) > 0.0;
  const T c = twisted ? cos(own.theta_z) : one, s = twisted ? sin(own.theta_z) : zero;
  out.home.q = {Xyz<T>{c, s, zero}, Xyz<T>{-s, c, zero}, Xyz<T>{zero, zero, one}};
  out.home.p = {zero, zero, own.zp};
  out.home.s = {zero, zero, own.zs};
  if (!tool.position.isZero(0.0)) out.home.p = out.home.p + turned(out.home, tool.position);
  for (std::size_t k = point_u; k < out.joints.size(); ++k) out.joints[k] = own.joints[k] - constant<T>(tool.position);
  if (!tool.turned()) return out;
  const RowsOf<T> axes = transposed(rotation_rows<T>(tool.rotation));
  out.home.q = {turned(out.home, axes[0]), turned(out.home, axes[1]), turned(out.home, axes[2])};
  for (std::size_t k = point_u; k < out.joints.size(); ++k) out.joints[k] = times(axes, out.joints[k]);
  return out;
}

template <class T>
PoseOf<T> listed_pose(const Pose& pose, const DesignsOf<T>& designs) {
  PoseOf<T> out = designs.home;
  const auto shift = [&](const Vec3& by) {
    const Xyz<T> v = constant<T>(by);
    return pose.in_zp ? designs.zp * v : v;
  };
  out.p = out.p + shift(pose.position);
  out.s = out.s + shift(pose.internal);
  if (pose.rotation.isZero(0.0)) return out;
  const RowsOf<T> turn = rotation_rows<T>(pose.rotation);
  for (Xyz<T>& column : out.q) column = times(turn, column);
  return out;
}

template DesignsOf<DesignForm> design_forms(const DesignQuestion&, const DesignBox&);
template DesignsOf<CurvedForm> design_forms(const DesignQuestion&, const DesignBox&);
template PoseOf<DesignForm> listed_pose(const Pose&, const DesignsOf<DesignForm>&);
template PoseOf<CurvedForm> listed_pose(const Pose&, const DesignsOf<CurvedForm>&);

}  // namespace ninedof::admissible
