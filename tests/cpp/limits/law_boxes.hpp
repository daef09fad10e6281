#pragma once
/// What the law of limits is held at: robots at poses, boxes of poses and of designs about them, what rows see there.

#include <algorithm>
#include <cmath>
#include <memory>

#include "limits/pose_row.hpp"
#include "ninedof/math/rotation.hpp"
#include "support/support.hpp"

namespace law {

using namespace ninedof;
using namespace support;

/// Two loads with masses of all bodies and each motion of O in turn; of every third case a platform that only turns.
inline Duty random_duty(int n) {
  Random random(static_cast<unsigned>(n) + 1);  // its own: that of the poses stays
  Duty out;
  for (int k = 0; k < n % 2; ++k) out.loads.push_back({random.matrix<Vec3>(), random.matrix<Vec3>(), Vec3::Zero()});
  out.loads.front() = {random.matrix<Vec3>(), random.matrix<Vec3>(), Vec3::Zero()};
  Masses& m = out.masses;
  m.platform = 0.5;
  m.centre = random.matrix<Vec3>();
  m.internal_point = 0.1;
  for (Vec9* each : {&m.cylinder, &m.rod, &m.cylinder_centre, &m.rod_centre}) *each = random.matrix<Vec9>().cwiseAbs();
  out.gravity = random.matrix<Vec3>();
  using enum InternalMotion;
  out.motion = {std::array{least, held, shifted, carried}[at_index(n % 4)], n % 3 == 0 ? 0.0 : 0.7, 0.4, {}};
  return out;
}

/// A robot at a pose and at home; the axis is that of every second case.
struct Case {
  Geometry g;
  Configuration home, here;
  LimitOptions options;

  Case(Random& random, int n) : Case(random_robot(random), random, n) {}
  Case(const Robot& robot, Random& random, int n)
      : g(robot.geometry), home(robot.configuration), here(robot.configuration) {
    here.position += 0.2 * random.matrix<Vec3>();
    here.rotation = exp_rotation(0.2 * random.matrix<Vec3>()) * home.rotation;
    here.internal_point += 0.2 * random.matrix<Vec3>();
    if (n % 2 == 0) options.axis = random.matrix<Vec3>();
    options.duty = std::make_shared<const Duty>(random_duty(n));
  }
};

/// A box of positions, of s and of turns about z; over designs also of a coordinate of six joints.
template <class T>
struct Box {
  using Place = Eigen::Matrix<double, static_cast<int>(T::size), 1>;
  const Case& one;
  double half;

  static T along(const Vec3& v, Eigen::Index k, std::size_t coordinate, double half) {
    return T::coordinate(v[k] - half, v[k] + half, coordinate);
  }
  PoseOf<T> forms() const {
    const Vec3 &p = one.here.position, &s = one.here.internal_point;
    PoseOf<T> out{{along(p, 0, 0, half), along(p, 1, 1, half), along(p, 2, 2, half)},
                  {along(s, 0, 3, half), along(s, 1, 4, half), T(s.z())},
                  {}};
    const T yaw = T::coordinate(-half, half, 5), c = cos(yaw), sine = sin(yaw);
    for (std::size_t k = 0; k < 3; ++k) {
      const Xyz<T> v = constant<T>(one.here.rotation.col(static_cast<Eigen::Index>(k)));
      out.q[k] = {c * v.x - sine * v.y, sine * v.x + c * v.y, v.z};
    }
    return out;
  }
  /// Symbol 6 + n moves coordinate n % 3 of joint 2 n.
  JointsOf<T> joints() const {
    JointsOf<T> out;
    for (int k = 0; k < 12; ++k) out[at_index(k)] = constant<T>(joint_of(one.g, k));
    for (std::size_t n = 0; n + PoseForm::size < T::size; ++n) {
      Xyz<T>& joint = out[2 * n];
      const auto k = static_cast<Eigen::Index>(n % 3);
      *std::array{&joint.x, &joint.y, &joint.z}[n % 3] =
          along(joint_of(one.g, static_cast<int>(2 * n)), k, PoseForm::size + n, half);
    }
    return out;
  }
  Case at(const Place& t) const {
    Case out = one;
    out.here.position += half * t.template head<3>();
    out.here.internal_point.template head<2>() += half * t.template segment<2>(3);
    out.here.rotation = rotation_about_z(half * t[5]) * one.here.rotation;
    std::array<Triple, 4> bodies{one.g.base_external(), one.g.base_internal(), one.g.platform_external(),
                                 one.g.platform_internal()};
    for (std::size_t n = 0; n + PoseForm::size < T::size; ++n)
      bodies[2 * n / 3][2 * n % 3][static_cast<Eigen::Index>(n % 3)] +=
          half * t[static_cast<Eigen::Index>(PoseForm::size + n)];
    out.g = Geometry(bodies[0], bodies[1], bodies[2], bodies[3]);
    return out;
  }
  static Place random_place(Random& random) {
    return Place::NullaryExpr([&] { return std::clamp(random.normal(), -1.0, 1.0); });
  }
};

/// What a row sees over a box of poses, and the functions that look at it.
template <class T>
struct Seen {
  explicit Seen(const Box<T>& box)
      : machine{box.one.g}, pose(box.forms()), home(box.one.g, box.one.home, box.one.options) {}
  AsBuilt machine;
  FormPose pose;
  FormHome home;
  FormLook look{machine, pose, home};
  static auto form(const PoseRow& row) { return row.form; }
  static auto numerator(const PoseRow& row) { return row.numerator; }
  static auto moves(const PoseRow& row) { return row.moves; }
};
/// The same over a box of designs as well.
template <>
struct Seen<DesignForm> {
  explicit Seen(const Box<DesignForm>& box) : machine(box.joints()), pose(box.forms()) {
    const PosedPoints points = posed_points(box.one.g, box.one.home);
    const FormPose at_home = form_pose(box.one.home);
    const auto wider = [](const FormVector& v) {
      const auto one = [](const PoseForm& x) { return DesignForm::of({lower(x), upper(x)}); };
      return Xyz<DesignForm>{one(v.x), one(v.y), one(v.z)};
    };
    const PoseOf<DesignForm> there{
        wider(at_home.p), wider(at_home.s), {wider(at_home.q[0]), wider(at_home.q[1]), wider(at_home.q[2])}};
    home.duty = box.one.options.duty;
    set_axes(machine, there, box.one.options.axis, home);
    for (int k = 0; k < 3; ++k) home.side[at_index(k)] = PointLook(points, points, box.one.options).side(k);
  }
  JointsOf<DesignForm> machine;
  PoseOf<DesignForm> pose;
  HomeOf<DesignForm> home;
  DesignLook look{machine, pose, home};
  static auto form(const PoseRow& row) { return row.design_form; }
  static auto numerator(const PoseRow& row) { return row.design_numerator; }
  static auto moves(const PoseRow& row) { return row.design_moves; }
};

template <class T>
Interval at(const T& f, const typename Box<T>::Place& t) {
  if (!is_known(f)) return Interval::whole();
  double value = f.c, size = std::abs(f.c);
  for (std::size_t k = 0; k < T::size; ++k) {
    value += f.a[k] * t[static_cast<Eigen::Index>(k)];
    size += std::abs(f.a[k]);
  }
  const double room = f.r + 1e-15 * size;
  return {value - room, value + room};
}

inline bool holds(const Interval& all, double number) {
  const double room = 1e-13 * (1.0 + std::abs(number));
  return all.lo - room <= number && number <= all.hi + room;
}

inline double number_of(const PoseRow& row, const Case& one, int item) {
  const PosedPoints here = posed_points(one.g, one.here), home = posed_points(one.g, one.home);
  return row.number(PointLook(here, home, one.options), item);
}

}  // namespace law
