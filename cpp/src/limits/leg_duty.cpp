/// force, rate, power: of every leg, the greatest modulus of its force under the loads and weights of a machine at rest,
/// its greatest rate over all directions of both speeds of the platform, and their product. Slopes are those of the
/// power in a motion that is held: see docs/theory/statics.md. Declared in limits/pose_row.hpp.

#include <cmath>

#include "limits/duty_at_pose.hpp"
#include "limits/duty_over_box.hpp"
#include "limits/pose_row.hpp"

namespace ninedof {
namespace {

/// The force, the rate, or with both their product.
template <bool of_force, bool of_rate>
struct LegDuty {
  static constexpr int items = 9;
  static constexpr bool falls = false;
  static constexpr double width = 5e-3;

  static std::string part(int item) { return leg_name(item); }
  static double number(const PointLook& look, int item) {
    DutyAtPose here(look);
    return (of_force ? here.force(item) : 1.0) * (of_rate ? here.rate(item) : 1.0);
  }
  static double slopes(const PointLook& look, int item, PointSlopes& out) {
    DutyAtPose here(look);
    const double force = of_force ? here.force(item) : 1.0, rate = of_rate ? here.rate(item) : 1.0;
    out.points = out.home_points = 0;
    out.turns = false;
    out.length = 0.0;
    const double value = force * rate;
    if (!std::isfinite(value)) return value;
    DutySlope all;
    const auto add = [&all](double by, const DutySlope& one) {
      all.points = all.points + by * one.points;
      all.turn += by * one.turn;
    };
    if (of_force) add(rate, here.force_slope(item));
    if (of_rate) add(force, here.rate_slope(item));
    for (int point = 0; point < point_count; ++point) {
      const auto k = at_index(3 * point);
      const auto& g = all.points.gradient;
      out.at[at_index(out.points++)] = {point, {g[k], g[k + 1], g[k + 2]}};
    }
    out.turns = true;
    out.turn = all.turn;
    out.home_turn.setZero();
    return value;
  }
  static PoseForm u(const FormLook& look, int item) {
    const DutyOverBox box(look);
    if constexpr (!of_rate) return box.force(item);
    else if constexpr (!of_force) return box.rate(item);
    else return box.force(item) * box.rate(item);
  }
  static Interval read(const Interval& number) { return number; }
  static Interval smooth(const Interval& number) { return number; }
  static void moves(const FormLook& look, int, Moves& out) {
    for (int leg = 0; leg < 9; ++leg) {
      const FormEnds ends = look.ends(leg);
      const FormVector v = ends.to - ends.from;
      out.add(v, 1.0 / std::max(centre(v).norm(), 1e-300));
    }
  }
};

}  // namespace

constinit const PoseRow force_row = pose_row_of<LegDuty<true, false>>();
constinit const PoseRow rate_row = pose_row_of<LegDuty<false, true>>();
constinit const PoseRow power_row = pose_row_of<LegDuty<true, true>>();

}  // namespace ninedof
