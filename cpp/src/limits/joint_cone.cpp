/// base_cone, platform_cone: angle between each leg, pointing away from its joint on that body, and an axis of the
/// body: a given one, or the direction of that leg at the neutral configuration. u is its cosine. The same of the
/// external or the internal legs alone, whose joints are others to buy and to mount: base_cone_external and so on.
/// Declared in limits/rows.hpp.

#include <algorithm>
#include <cmath>

#include "limits/rows.hpp"

namespace ninedof {
namespace {

/// The legs of a body from `first` on.
template <bool platform, int first = 0, int count = legs_at_body>
struct JointCone {
  static constexpr int items = count, cone_body = platform, first_at_body = first;
  static constexpr double width = 1e-5;
  static constexpr bool falls = true, at_home = true;

  static std::string part(int item) { return leg_name(leg_at(platform, first + item)); }
  static double slopes(const PointLook& look, int item, PointSlopes& out) {
    const LegEnds ends = leg_ends(leg_at(platform, first + item));
    return slopes_of<JointCone, 2>(look, item, {ends.from, ends.to}, out);
  }
  template <class Look>
  static auto direction(const Look& look, int item) {
    return sense_at(platform, first + item) * look.direction(leg_at(platform, first + item));
  }
  /// The axis at the pose, base frame.
  template <class Look>
  static auto axis(const Look& look, int item) {
    const auto a = look.axis(platform, first + item);
    if constexpr (!platform) return a;
    const auto& q = look.q();
    return a.x * q[0] + a.y * q[1] + a.z * q[2];
  }
  template <class Look>
  static auto u(const Look& look, int item) {
    return dot(direction(look, item), axis(look, item));
  }
  /// By the tangent: the cosine alone leaves 1e-8 of a small angle.
  static double number(const PointLook& look, int item) { return cone_angle(direction(look, item), axis(look, item)); }
  static double number_of(double, const PointLook& look, int item) { return number(look, item); }
  /// On the axis the angle has no slope.
  static double slope(double angle) {
    const double sine = std::sin(angle);
    return sine > 1e-12 ? -1.0 / sine : 0.0;
  }
  static Interval read(const Interval& cosine) { return acos(cosine); }
  static Interval smooth(const Interval& angle) { return cos(angle); }
  template <class Look>
  static void moves(const Look& look, int item, Moves& out) {
    const auto v = from_joint(platform, first + item, [&](int point) { return look.at(point); });
    out.add(v);
    out.add(axis(look, item), centre(v).norm());
  }
};

}  // namespace

constinit const PoseRow base_cone_row = pose_row_of<JointCone<false>>();
constinit const PoseRow platform_cone_row = pose_row_of<JointCone<true>>();
constinit const PoseRow base_cone_external_row = pose_row_of<JointCone<false, 0, 3>>();
constinit const PoseRow base_cone_internal_row = pose_row_of<JointCone<false, 3, 3>>();
constinit const PoseRow platform_cone_external_row = pose_row_of<JointCone<true, 0, 3>>();
constinit const PoseRow platform_cone_internal_row = pose_row_of<JointCone<true, 3, 3>>();

}  // namespace ninedof
