#pragma once
/// What a limit may see of a robot: its points and the columns of Q at a pose, and at the neutral pose, which fixes the
/// axes of cones without one and the sides of determinants. A formula of a limit is a template over these three, which
/// have the same members:
///
///   PointLook   doubles
///   DualLook    their derivatives by the points that the limit touches, and by turns of the platform
///   FormLook    linear forms over a box of poses, and over a box of designs (DesignLook)

#include <algorithm>
#include <cassert>

#include "ninedof/limits/limits.hpp"
#include "ninedof/math/dual.hpp"
#include "robot/joint_cones.hpp"
#include "robot/pose_of.hpp"

namespace ninedof {

// The unit vector of a vector. One of no length has none: zero, and over a box where that may be, not known.

inline Xyz<double> unit(const Xyz<double>& v) {
  const double length = std::sqrt(dot(v, v));
  if (!(length > 0.0)) return {0.0, 0.0, 0.0};
  return {v.x / length, v.y / length, v.z / length};
}
template <std::size_t N>
Xyz<Form<N>> unit(const Xyz<Form<N>>& v) {
  return inverse_root(dot(v, v)) * v;
}

/// Leg k of a body (joint_cones.hpp) from its joint, base frame.
template <class Point>
auto from_joint(bool platform, int k, const Point& point) {
  const LegEnds ends = leg_ends(leg_at(platform, k));
  return sense_at(platform, k) * (point(ends.to) - point(ends.from));
}

/// A vector of the base frame in that of the platform, or of a body.
template <class T>
Xyz<T> in_body(bool platform, const std::array<Xyz<T>, 3>& q, const Xyz<T>& v) {
  return platform ? Xyz<T>{dot(q[0], v), dot(q[1], v), dot(q[2], v)} : v;
}

class PointLook {
 public:
  using Number = double;
  /// The duty of the options must stay.
  PointLook(const PosedPoints& here, const PosedPoints& home, const LimitOptions& options,
            double characteristic_length = 1.0)
      : here_(here), home_(home), axis_(options.axis), duty_(options.duty.get()), length_(characteristic_length) {}

  Xyz<double> at(int point) const { return xyz(here_.at[at_index(point)]); }
  Xyz<double> direction(int leg) const { return xyz(here_.legs.direction[at_index(leg)]); }
  Xyz<double> towards(int from, int to) const { return unit(at(to) - at(from)); }
  /// The point at a fraction of a leg.
  Xyz<double> on_leg(int leg, double t) const {
    const LegEnds ends = leg_ends(leg);
    return at(ends.from) + t * (at(ends.to) - at(ends.from));
  }
  std::array<Xyz<double>, 3> q() const { return columns(here_.rotation); }
  Xyz<double> axis(bool platform, int k) const {
    if (!axis_.isZero(0.0)) return xyz(axis_.normalized());
    const Xyz<double> along = xyz(home_.legs.direction[at_index(leg_at(platform, k))]);
    return in_body(platform, columns(home_.rotation), sense_at(platform, k) * along);
  }
  double side(int which) const;

  const PosedPoints& here() const { return here_; }
  const PosedPoints& home() const { return home_; }
  const Vec3& given_axis() const { return axis_; }
  const Duty& duty() const { return *duty_; }
  double characteristic_length() const { return length_; }

  static Xyz<double> xyz(const Vec3& v) { return {v.x(), v.y(), v.z()}; }
  static std::array<Xyz<double>, 3> columns(const Mat3& q) { return {xyz(q.col(0)), xyz(q.col(1)), xyz(q.col(2))}; }

 private:
  const PosedPoints& here_;
  const PosedPoints& home_;
  Vec3 axis_;
  const Duty* duty_;
  double length_;
};

/// Derivatives by P points of the pose, and where the limit looks at home too, by a turn of the platform about base
/// axes, by the same points at home and by a turn there, in this order.
template <int P, bool at_home>
class DualLook {
 public:
  static constexpr int turn = 3 * P, home_points = turn + 3, home_turn = home_points + 3 * P;
  static constexpr int variables = at_home ? home_turn + 3 : 3 * P;
  using Number = Dual<variables>;
  DualLook(const PointLook& look, const std::array<int, P>& touched) : look_(look), touched_(touched) {}

  Xyz<Number> at(int point) const {
    Xyz<Number> out = constant(look_.at(point));
    add(out, 1.0, place(point));
    return out;
  }
  /// The point at a fraction of a leg.
  Xyz<Number> on_leg(int leg, double t) const {
    const LegEnds ends = leg_ends(leg);
    Xyz<Number> out = constant(look_.on_leg(leg, t));
    add(out, 1.0 - t, place(ends.from));
    add(out, t, place(ends.to));
    return out;
  }
  Xyz<Number> direction(int leg) const {
    const LegEnds ends = leg_ends(leg);
    const NineLegs& legs = look_.here().legs;
    return turning_vector(legs.direction[at_index(leg)], legs.length[leg], place(ends.from), place(ends.to));
  }
  Xyz<Number> towards(int from, int to) const {
    const Vec3 v = look_.here().at[at_index(to)] - look_.here().at[at_index(from)];
    const double length = v.norm();
    return turning_vector(length > 0.0 ? Vec3(v / length) : v, length, place(from), place(to));
  }
  std::array<Xyz<Number>, 3> q() const { return turned_columns(look_.here().rotation, turn); }
  Xyz<Number> axis(bool platform, int k) const {
    if (!look_.given_axis().isZero(0.0)) return constant(look_.axis(platform, k));
    const int leg = leg_at(platform, k);
    const LegEnds ends = leg_ends(leg);
    const NineLegs& legs = look_.home().legs;
    const Xyz<Number> along =
        turning_vector(sense_at(platform, k) * legs.direction[at_index(leg)], sense_at(platform, k) * legs.length[leg],
                       home_points + place(ends.from), home_points + place(ends.to));
    return platform ? in_body(true, turned_columns(look_.home().rotation, home_turn), along) : along;
  }
  double side(int which) const { return look_.side(which); }
  const PosedPoints& here() const { return look_.here(); }

 private:
  static Xyz<Number> constant(const Xyz<double>& v) { return {v.x, v.y, v.z}; }
  /// The first variable of a touched point.
  int place(int point) const {
    const auto found = std::ranges::find(touched_, point);
    assert(found != touched_.end());
    return 3 * static_cast<int>(found - touched_.begin());
  }
  /// v changes by `by` times the three variables from `first` on.
  static void add(Xyz<Number>& v, const Mat3& by, int first) {
    for (Eigen::Index j = 0; j < 3; ++j) {
      const auto k = at_index(first) + at_index(j);
      v.x.gradient[k] += by(0, j);
      v.y.gradient[k] += by(1, j);
      v.z.gradient[k] += by(2, j);
    }
  }
  static void add(Xyz<Number>& v, double by, int first) {
    const auto k = at_index(first);
    v.x.gradient[k] += by;
    v.y.gradient[k + 1] += by;
    v.z.gradient[k + 2] += by;
  }
  /// A unit vector between two points can only turn: it changes by what is across it over the length.
  static Xyz<Number> turning_vector(const Vec3& e, double length, int from, int to) {
    Xyz<Number> out = constant(PointLook::xyz(e));
    if (length == 0.0) return out;
    const Mat3 by = (Mat3::Identity() - e * e.transpose()) / length;
    add(out, by, to);
    add(out, -by, from);
    return out;
  }
  /// The columns of a rotation, which change by w x column for a turn w.
  static std::array<Xyz<Number>, 3> turned_columns(const Mat3& rotation, int first) {
    std::array<Xyz<Number>, 3> out;
    for (Eigen::Index k = 0; k < 3; ++k) {
      const Vec3 c = rotation.col(k);
      out[at_index(k)] = constant(PointLook::xyz(c));
      Mat3 by;
      by << 0.0, c.z(), -c.y(), -c.z(), 0.0, c.x(), c.y(), -c.x(), 0.0;
      add(out[at_index(k)], by, first);
    }
    return out;
  }

  const PointLook& look_;
  const std::array<int, P>& touched_;
};

/// The axes and sides of a robot as forms, and its duty: the same in every box of poses.
template <class T>
struct HomeOf {
  std::array<std::array<Xyz<T>, 6>, 2> axis;  ///< of base and platform
  std::array<double, 3> side;
  std::shared_ptr<const Duty> duty;
};
struct FormHome : HomeOf<PoseForm> {
  FormHome(const Geometry& g, const Configuration& home, const LimitOptions& options);
};
/// `given` is zero for the directions of the legs at home.
template <class T, class Robot>
void set_axes(const Robot& g, const PoseOf<T>& at_home, const Vec3& given, HomeOf<T>& out) {
  for (const bool platform : {false, true})
    for (int k = 0; k < legs_at_body; ++k) {
      const auto point = [&](int index) { return point_at(g, at_home, index); };
      const Xyz<T> along =
          given.isZero(0.0) ? in_body(platform, at_home.q, from_joint(platform, k, point)) : constant<T>(given);
      out.axis[platform][at_index(k)] = unit(along);
    }
}

template <class T, class Robot>
class FormLookOf {
 public:
  using Number = T;
  using Vector = Xyz<T>;
  FormLookOf(const Robot& g, const PoseOf<T>& pose, const HomeOf<T>& home) : g_(g), pose_(pose), home_(home) {}

  Vector at(int point) const { return point_at(g_, pose_, point); }
  Vector direction(int leg) const { return towards(leg_ends(leg).from, leg_ends(leg).to); }
  Vector towards(int from, int to) const { return unit(at(to) - at(from)); }
  const std::array<Vector, 3>& q() const { return pose_.q; }
  const Vector& axis(bool platform, int k) const { return home_.axis[platform][at_index(k)]; }
  double side(int which) const { return home_.side[at_index(which)]; }
  const Duty& duty() const { return *home_.duty; }
  Ends<T> ends(int leg) const { return ends_of(g_, pose_, leg); }

 private:
  const Robot& g_;
  const PoseOf<T>& pose_;
  const HomeOf<T>& home_;
};
/// Over a box of poses, of every machine within tolerances; over a box of poses and a box of designs.
using FormLook = FormLookOf<PoseForm, AsBuilt>;
using DesignLook = FormLookOf<DesignForm, JointsOf<DesignForm>>;

}  // namespace ninedof
