/// force, rate, power: of every leg, the greatest modulus of its force under the loads and weights of a machine at
/// rest, its greatest rate over all directions of both speeds of the platform, and their product. Slopes are those of
/// the power in a motion that is held: see docs/theory/statics.md. external_force, upper_rate and so on are of the legs
/// of one kind, whose actuators are others to buy. Declared in limits/rows.hpp.

#include <cmath>

#include "limits/duty_at_pose.hpp"
#include "limits/duty_over_box.hpp"
#include "limits/rows.hpp"

namespace ninedof {
namespace {

/// The force, the rate, or with both their product, of `count` legs from `first` on.
template <bool of_force, bool of_rate, int first = 0, int count = 9>
struct LegDuty {
  static constexpr int items = count;
  static constexpr bool falls = false;
  static constexpr double width = 5e-3;

  static std::string part(int item) { return leg_name(first + item); }
  static double of(DutyAtPose& here, int item) {
    const int leg = first + item;
    return (of_force ? here.force(leg) : 1.0) * (of_rate ? here.rate(leg) : 1.0);
  }
  static double number(const PointLook& look, int item) {
    DutyAtPose here(look);
    return of(here, item);
  }
  static void numbers(const PointLook& look, double* out) {
    DutyAtPose here(look);
    for (int item = 0; item < count; ++item) out[item] = of(here, item);
  }
  static double slopes(const PointLook& look, int item, PointSlopes& out) {
    DutyAtPose here(look);
    const int leg = first + item;
    const double force = of_force ? here.force(leg) : 1.0, rate = of_rate ? here.rate(leg) : 1.0;
    out.points = out.home_points = 0;
    out.turns = false;
    out.length = 0.0;
    const double value = force * rate;
    if (!std::isfinite(value)) return value;
    for (int point = 0; point < point_count; ++point) out.at[at_index(out.points++)] = {point, Vec3::Zero()};
    out.turns = true;
    out.turn.setZero();
    out.home_turn.setZero();
    if (of_force) here.add_force_slope(leg, rate, out);
    if (of_rate) here.add_rate_slope(leg, force, out);
    return value;
  }
  template <class Look>
  static auto of(DutyOverBox<Look>& box, int item) {
    const int leg = first + item;
    if constexpr (!of_rate) return box.force(leg);
    else if constexpr (!of_force) return box.rate(leg);
    else return box.force(leg) * box.rate(leg);
  }
  template <class Look>
  static auto u(const Look& look, int item) {
    DutyOverBox<Look> box(look);
    return of(box, item);
  }
  static void forms(const DesignLook& look, DesignForm* out) {
    DutyOverBox<DesignLook> box(look);
    for (int item = 0; item < count; ++item) out[item] = of(box, item);
  }
  static Interval read(const Interval& number) { return number; }
  static Interval smooth(const Interval& number) { return number; }
  template <class Look>
  static void moves(const Look& look, int, Moves& out) {
    for (int leg = 0; leg < 9; ++leg) {
      const auto ends = look.ends(leg);
      const auto v = ends.to - ends.from;
      out.add(v, 1.0 / std::max(centre(v).norm(), 1e-300));
    }
  }
};

}  // namespace

constinit const PoseRow force_row = pose_row_of<LegDuty<true, false>>();
constinit const PoseRow rate_row = pose_row_of<LegDuty<false, true>>();
constinit const PoseRow power_row = pose_row_of<LegDuty<true, true>>();
constinit const PoseRow external_force_row = pose_row_of<LegDuty<true, false, 0, 3>>();
constinit const PoseRow upper_force_row = pose_row_of<LegDuty<true, false, 3, 3>>();
constinit const PoseRow lower_force_row = pose_row_of<LegDuty<true, false, 6, 3>>();
constinit const PoseRow external_rate_row = pose_row_of<LegDuty<false, true, 0, 3>>();
constinit const PoseRow upper_rate_row = pose_row_of<LegDuty<false, true, 3, 3>>();
constinit const PoseRow lower_rate_row = pose_row_of<LegDuty<false, true, 6, 3>>();

}  // namespace ninedof
