/// singularity_free: det N, det B and det C of singularity.hpp, positive on the side of the neutral configuration. The
/// places where they are tested belong to whoever looks. Declared in limits/rows.hpp.

#include "limits/rows.hpp"

namespace ninedof {
namespace {

enum Which { det_n, det_b, det_c };

/// The first leg of the three whose directions are the rows of B and C; of N, which is made of the external joints.
constexpr int first_leg(int which) {
  return which == det_b ? 6 : which == det_c ? 3 : 0;
}

/// A determinant of three rows: d_i x w_i from O to the joints of external leg i for N, legs for B and C. Rows are made
/// of unit vectors, or of vectors of any length.
template <bool unit_vectors, class Look>
auto determinant_of(const Look& look, int which) {
  const auto row = [&](int k) {
    const int leg = first_leg(which) + k;
    const LegEnds ends = leg_ends(leg);
    if constexpr (unit_vectors) {
      if (which != det_n) return look.direction(leg);
      return cross(look.towards(point_s, ends.from), look.towards(point_s, ends.to));
    } else {
      const auto from = look.at(ends.from), to = look.at(ends.to);
      if (which != det_n) return to - from;
      const auto s = look.at(point_s);
      return cross(from - s, to - s);
    }
  };
  const auto first = row(0), second = row(1), third = row(2);
  return dot(first, cross(second, third));
}

struct Determinants {
  static constexpr int items = 3;
  static constexpr bool falls = false, at_home = false, on_the_way = true;
  static constexpr double width = 1e-3;

  static std::string part(int item) { return std::string("det ") + "NBC"[item]; }
  static double slopes(const PointLook& look, int item, PointSlopes& out) {
    const LegEnds a = leg_ends(first_leg(item)), b = leg_ends(first_leg(item) + 1), c = leg_ends(first_leg(item) + 2);
    if (item == det_n)
      return slopes_of<Determinants, 7>(look, item, {point_s, a.from, a.to, b.from, b.to, c.from, c.to}, out);
    return slopes_of<Determinants, 4>(look, item, {point_s, a.from, b.from, c.from}, out);
  }
  template <class Look>
  static auto u(const Look& look, int item) {
    return look.side(item) * determinant_of<true>(look, item);
  }
  /// Never -0.0: a singularity has no side.
  static double number(const PointLook& look, int item) { return u(look, item) + 0.0; }
  static double number_of(double determinant, const PointLook&, int) { return determinant; }
  static double slope(double) { return 1.0; }
  static Interval read(const Interval& determinant) { return determinant; }
  static Interval smooth(const Interval& determinant) { return determinant; }
  /// Of rows that are not of unit length.
  template <class Look>
  static auto numerator(const Look& look, int item) {
    return look.side(item) * determinant_of<false>(look, item);
  }
  template <class Look>
  static void moves(const Look& look, int item, Moves& out) {
    for (int k = 0; k < 3; ++k) {
      const LegEnds ends = leg_ends(first_leg(item) + k);
      const auto from = look.at(ends.from), to = look.at(ends.to);
      if (item == det_n) {
        const auto s = look.at(point_s);
        out.add(from - s);
        out.add(to - s);
      } else {
        out.add(to - from);
      }
    }
  }
};

}  // namespace

double PointLook::side(int which) const {
  return determinant_of<true>(PointLook(home_, home_, axis_), which) < 0.0 ? -1.0 : 1.0;
}

FormHome::FormHome(const Geometry& g, const Configuration& home, const LimitOptions& options) {
  duty = options.duty;
  set_axes(g, form_pose(home), options.axis, *this);
  const PosedPoints points = posed_points(g, home);
  for (int which = 0; which < 3; ++which) side[at_index(which)] = PointLook(points, points, options.axis).side(which);
}

constinit const PoseRow singularity_free_row = pose_row_of<Determinants>();

}  // namespace ninedof
