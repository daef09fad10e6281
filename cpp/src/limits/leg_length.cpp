/// leg_length: every leg. external_length, upper_length, lower_length: the legs of that kind. u is the squared length.
/// Declared in limits/rows.hpp.

#include "limits/rows.hpp"

namespace ninedof {
namespace {

template <int first, int count>
struct LegLengths {
  static constexpr int items = count, first_leg = first;
  static constexpr bool falls = false, at_home = false;

  static std::string part(int item) { return leg_name(first + item); }
  static double slopes(const PointLook& look, int item, PointSlopes& out) {
    const LegEnds ends = leg_ends(first + item);
    return slopes_of<LegLengths, 2>(look, item, {ends.from, ends.to}, out);
  }
  template <class Look>
  static auto leg(const Look& look, int item) {
    const LegEnds ends = leg_ends(first + item);
    return look.at(ends.to) - look.at(ends.from);
  }
  template <class Look>
  static auto u(const Look& look, int item) {
    const auto v = leg(look, item);
    return dot(v, v);
  }
  static double number(const PointLook& look, int item) { return look.here().legs.length[first + item]; }
  static double number_of(double, const PointLook& look, int item) { return number(look, item); }
  static double slope(double length) { return length > 0.0 ? 0.5 / length : 0.0; }
  static Interval read(const Interval& squared) { return sqrt(squared); }
  static Interval smooth(const Interval& length) { return square(length); }
  template <class Look>
  static void moves(const Look& look, int item, Moves& out) {
    out.add(leg(look, item));
  }
};

}  // namespace

constinit const PoseRow leg_length_row = pose_row_of<LegLengths<0, 9>>();
constinit const PoseRow external_length_row = pose_row_of<LegLengths<0, 3>>();
constinit const PoseRow upper_length_row = pose_row_of<LegLengths<3, 3>>();
constinit const PoseRow lower_length_row = pose_row_of<LegLengths<6, 3>>();

}  // namespace ninedof
