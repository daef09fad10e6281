#pragma once
/// A pose and the points of a robot there over a number type: doubles, or linear forms over a box of poses.

#include <algorithm>
#include <array>
#include <cmath>
#include <type_traits>

#include "math/form.hpp"
#include "ninedof/math/xyz.hpp"
#include "ninedof/robot/configuration.hpp"
#include "ninedof/robot/geometry.hpp"
#include "ninedof/robot/points.hpp"

namespace ninedof {

/// p, s, and Q by columns.
template <class T>
struct PoseOf {
  Xyz<T> p, s;
  std::array<Xyz<T>, 3> q;
};

template <class T>
Xyz<T> constant(const Vec3& v) {
  return {v.x(), v.y(), v.z()};
}

template <class T>
Xyz<T> turned(const PoseOf<T>& pose, const Vec3& body) {
  return body.x() * pose.q[0] + body.y() * pose.q[1] + body.z() * pose.q[2];
}

/// Twelve joints in the order of Points, each in the frame of its body: those of a box of designs.
template <class T>
using JointsOf = std::array<Xyz<T>, 12>;

template <class T>
Xyz<T> turned(const PoseOf<T>& pose, const Xyz<T>& body) {
  return body.x * pose.q[0] + body.y * pose.q[1] + body.z * pose.q[2];
}
template <class T>
const Xyz<T>& joint_of(const JointsOf<T>& joints, int point) {
  return joints[static_cast<std::size_t>(point)];
}
inline const Vec3& joint_of(const Geometry& g, int point) {
  const Triple& triple = point < point_r_hat     ? g.base_external()
                         : point < point_u       ? g.base_internal()
                         : point < point_u_tilde ? g.platform_external()
                                                 : g.platform_internal();
  return triple[static_cast<std::size_t>(point % 3)];
}

/// A geometry whose joints lie anywhere in balls about their places: turned balls are the same balls.
struct AsBuilt {
  const Geometry& nominal;
  std::array<double, 12> radius{};  ///< in the order of Points

  bool exact() const { return radius == std::array<double, 12>{}; }
  /// A vector with the error of a joint.
  template <class T>
  Xyz<T> loose(Xyz<T> v, int point) const {
    const double r = radius[static_cast<std::size_t>(point)];
    if (r > 0.0)
      for (T* x : {&v.x, &v.y, &v.z}) x->r = detail::above(x->r + r);
    return v;
  }
};

/// From p to a joint of the platform.
template <class T, class Robot>
Xyz<T> arm_at(const Robot& g, const PoseOf<T>& pose, int point) {
  if constexpr (std::is_same_v<Robot, AsBuilt>) return g.loose(turned(pose, joint_of(g.nominal, point)), point);
  else return turned(pose, joint_of(g, point));
}

/// The joint of a robot with this index of Points, or p or s. The robot is a Geometry, AsBuilt or JointsOf<T>.
template <class T, class Robot>
Xyz<T> point_at(const Robot& g, const PoseOf<T>& pose, int point) {
  if (point == point_p) return pose.p;
  if (point == point_s) return pose.s;
  if (point >= point_u) return pose.p + arm_at(g, pose, point);
  if constexpr (std::is_same_v<Robot, AsBuilt>) return g.loose(constant<T>(joint_of(g.nominal, point)), point);
  else if constexpr (std::is_same_v<Robot, Geometry>) return constant<T>(joint_of(g, point));
  else return joint_of(g, point);
}

template <class T>
struct Ends {
  Xyz<T> from, to;
};
/// The ends of a leg, in the order of leg_ends.
template <class T, class Robot>
Ends<T> ends_of(const Robot& g, const PoseOf<T>& pose, int leg) {
  const LegEnds ends = leg_ends(leg);
  return {point_at(g, pose, ends.from), point_at(g, pose, ends.to)};
}

// Over a box of poses.
using FormVector = Xyz<PoseForm>;
using FormPose = PoseOf<PoseForm>;
using FormEnds = Ends<PoseForm>;

/// The middle of a vector of forms.
template <class T>
Vec3 centre(const Xyz<T>& v) {
  return {v.x.c, v.y.c, v.z.c};
}

/// The columns of a rotation matrix of doubles, and of the rotation next to it: matrices may come from elsewhere, with
/// fewer digits.
std::array<FormVector, 3> rotation_columns(const Mat3& q);

/// A configuration as a box of one pose.
FormPose form_pose(const Configuration& c);

/// How far vectors move along each coordinate of a box of poses, the most of all: what a box is divided by.
struct Moves {
  std::array<double, PoseForm::size> along{};
  template <class T>
  void add(const Xyz<T>& v, double scale = 1.0) {
    for (const T* x : {&v.x, &v.y, &v.z})
      for (std::size_t k = 0; k < along.size(); ++k) along[k] = std::max(along[k], scale * std::abs(x->a[k]));
  }
};

}  // namespace ninedof
