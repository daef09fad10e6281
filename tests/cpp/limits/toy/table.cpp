/// A table of limits with one row more, linked in place of the core's: apex_distance, the distance of O from the
/// platform's point p. Declared in limits/table.hpp.

#include <algorithm>

#include "limits/rows.hpp"

namespace ninedof {
namespace {

/// u is the squared distance.
struct ApexDistance {
  static constexpr int items = 1;
  static constexpr bool falls = false, at_home = false;

  static std::string part(int) { return "O"; }
  static double slopes(const PointLook& look, int item, PointSlopes& out) {
    return slopes_of<ApexDistance, 2>(look, item, {point_p, point_s}, out);
  }
  template <class Look>
  static auto u(const Look& look, int) {
    const auto between = look.at(point_s) - look.at(point_p);
    return dot(between, between);
  }
  static double number(const PointLook& look, int item) { return std::sqrt(u(look, item)); }
  static double number_of(double squared, const PointLook&, int) { return std::sqrt(squared); }
  static double slope(double distance) { return distance > 0.0 ? 0.5 / distance : 0.0; }
  static Interval read(const Interval& squared) { return sqrt(squared); }
  static Interval smooth(const Interval& distance) { return square(distance); }
  static void moves(const FormLook& look, int, Moves& out) { out.add(look.at(point_s) - look.at(point_p)); }
};

constinit const PoseRow apex_distance_row = pose_row_of<ApexDistance>();

constexpr auto rows = [] {
  std::array<LimitRow, known_limits.size() + 1> out{};
  std::ranges::copy(known_limits, out.begin());
  const ConstraintInfo info{"apex_distance", LimitKind::length, LimitSides::both, Unit::zp};
  out.back() = {info, SolverMargin::logarithm, &apex_distance_row, nullptr, nullptr};
  return out;
}();

}  // namespace

std::span<const LimitRow> limit_rows() {
  return rows;
}

}  // namespace ninedof
