/// The limits of the design alone. Declared in limits/rows.hpp.

#include <cmath>

#include "limits/rows.hpp"

namespace ninedof {
namespace {

template <class T>
T from_axis(const Xyz<T>& joint) {
  using std::sqrt;
  return sqrt(joint.x * joint.x + joint.y * joint.y);
}

/// A row of one item that touches no joint; others hide what differs.
struct PlainDesignRow {
  static constexpr bool picks_widest = false;
  static int items(Side) { return 1; }
  static std::pair<int, int> joints(Joints, Side, int) { return {0, 0}; }
  static int body(int) { return -1; }
};

/// Largest distance of a base joint from z over the same of the platform, each in its own frame. At most: every base
/// joint against the widest of the platform. At least: the widest of the base against every other.
struct RadiusRatio : PlainDesignRow {
  static constexpr bool picks_widest = true;
  static int items(Side) { return 6; }
  static std::pair<int, int> joints(Joints all, Side side, int item) {
    if (side == Side::high) return {item, widest_joint(all, point_u)};
    return {widest_joint(all, 0), point_u + item};
  }
  template <class T>
  static T u(const Touched<T>& x, int) {
    return from_axis(x.a) / from_axis(x.b);
  }
};

/// Height of the internal point at the neutral configuration, as a fraction of the platform's.
struct ZsFraction : PlainDesignRow {
  template <class T>
  static T u(const Touched<T>& x, int) {
    return x.zs / x.zp;
  }
};

/// zp, the height of the platform frame over the base frame at the neutral configuration.
struct Height : PlainDesignRow {
  template <class T>
  static T u(const Touched<T>& x, int) {
    return x.zp;
  }
};

/// Largest distance of a base joint from z. At most: every base joint. At least: the widest one.
struct Footprint : PlainDesignRow {
  static constexpr bool picks_widest = true;
  static int items(Side side) { return side == Side::high ? 6 : 1; }
  static std::pair<int, int> joints(Joints all, Side side, int item) {
    const int joint = side == Side::high ? item : widest_joint(all, 0);
    return {joint, joint};
  }
  template <class T>
  static T u(const Touched<T>& x, int) {
    return from_axis(x.a);
  }
};

/// Distance of every joint from z = 0 of its body's frame, above and below apart: |z| itself has a kink at zero.
struct JointHeight : PlainDesignRow {
  static int items(Side) { return 24; }
  static std::pair<int, int> joints(Joints, Side, int item) { return {item % 12, item % 12}; }
  template <class T>
  static T u(const Touched<T>& x, int item) {
    return item < 12 ? x.a.z : -x.a.z;
  }
};

/// Distance of every two of the six joints of a body; of "radius": of the largest distance of a joint of that body from
/// z.
struct JointSpacing : PlainDesignRow {
  static constexpr int pairs = 15;
  static int items(Side) { return 2 * pairs; }
  static int body(int item) { return item < pairs ? 0 : point_u; }
  static std::pair<int, int> joints(Joints, Side, int item) {
    int left = item % pairs, a = 0;
    for (; left >= 5 - a; ++a) left -= 5 - a;
    return {body(item) + a, body(item) + a + 1 + left};
  }
  template <class T>
  static T u(const Touched<T>& x, int) {
    using std::sqrt;
    const Xyz<T> between = x.a - x.b;
    return sqrt(square(between.x) + square(between.y) + square(between.z));
  }
};

template <class Row>
constexpr DesignRow design_row_of() {
  return {Row::picks_widest,
          Row::items,
          Row::joints,
          Row::body,
          [](const Touched<double>& x, int item) { return Row::u(x, item); },
          [](const Touched<double>& x, int item) {
            using D = Dual<8>;
            const std::array at{x.a.x, x.a.y, x.a.z, x.b.x, x.b.y, x.b.z, x.zp, x.zs};
            const std::array<D, 8> v = D::variables(at);
            const D u = Row::u(Touched<D>{{v[0], v[1], v[2]}, {v[3], v[4], v[5]}, v[6], v[7]}, item);
            const auto& g = u.gradient;
            return DesignSlopes{u.value, {g[0], g[1], g[2]}, {g[3], g[4], g[5]}, g[6], g[7]};
          },
          [](const Touched<Interval>& x, int item) { return Row::u(x, item); },
          [](const Touched<DesignForm>& x, int item) { return Row::u(x, item); }};
}

}  // namespace

int widest_joint(Joints joints, int body) {
  const int begin = body < 0 ? 0 : body, end = body < 0 ? 12 : body + 6;
  int widest = begin;
  double most = -1.0;
  for (int k = begin; k < end; ++k) {
    const double squared = joints[at_index(k)].head<2>().squaredNorm();
    if (squared <= most) continue;
    most = squared;
    widest = k;
  }
  return widest;
}

constinit const DesignRow radius_ratio_row = design_row_of<RadiusRatio>();
constinit const DesignRow zs_fraction_row = design_row_of<ZsFraction>();
constinit const DesignRow height_row = design_row_of<Height>();
constinit const DesignRow footprint_row = design_row_of<Footprint>();
constinit const DesignRow joint_height_row = design_row_of<JointHeight>();
constinit const DesignRow joint_spacing_row = design_row_of<JointSpacing>();

}  // namespace ninedof
