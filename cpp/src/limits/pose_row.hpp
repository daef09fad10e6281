#pragma once
/// Limits that have a value at one pose, as rows: what they limit, over every number type. One file defines one
/// quantity, once; whoever looks at a limit takes it from here.

#include <string>

#include "limits/look.hpp"
#include "ninedof/math/interval.hpp"

namespace ninedof {

/// The derivatives of a number by what it touches.
struct PointSlopes {
  struct Of {
    int point;
    Vec3 slope;
  };
  int points = 0, home_points = 0;
  bool turns = false;  ///< whether Q and the pose at home count beyond these points
  std::array<Of, point_count> at;  ///< by points of the pose
  std::array<Of, 2> home;  ///< by points of the neutral pose
  Vec3 turn, home_turn;    ///< by a turn of the platform about base axes beyond that of its points
  double length = 0.0;     ///< by the characteristic length
};

/// The functions of a row. u is the smooth quantity behind the number that people read: a squared length, a cosine.
struct PoseRow {
  int items = 0;  ///< legs, pairs of legs, determinants
  /// Of a row of leg lengths: its items are legs from this one on.
  int first_leg = -1;
  /// Of a row of angles at the joints of a body: 0 for the base, 1 for the platform; its items are the legs of the body
  /// from `first_at_body` on.
  int cone_body = -1, first_at_body = 0;
  bool pairs = false;       ///< items are pairs of legs (leg_pairs.hpp), which may be exempt
  bool on_the_way = false;  ///< it also has to hold at home and on the way from there to each pose
  double width = 3e-5;      ///< of an enclosure in which no limit lies, relative: it is narrow enough
  std::string (*part)(int item) = nullptr;  ///< "l1", "l1-q2", "det N"
  /// The number that people read, at a pose.
  double (*number)(const PointLook&, int item) = nullptr;
  /// `number` and its derivatives, zero where it has none.
  double (*slopes)(const PointLook&, int item, PointSlopes&) = nullptr;
  /// u over a box of poses. Null for pairs of legs, see limits/leg_clearance.hpp, and for condition numbers.
  PoseForm (*form)(const FormLook&, int item) = nullptr;
  /// u without a positive factor, where that is simpler: enough for a limit of 0.
  PoseForm (*numerator)(const FormLook&, int item) = nullptr;
  /// The vectors that u is made of.
  void (*moves)(const FormLook&, int item, Moves&) = nullptr;
  /// The same over a box of designs as well. Null as `form` is.
  DesignForm (*design_form)(const DesignLook&, int item) = nullptr;
  DesignForm (*design_numerator)(const DesignLook&, int item) = nullptr;
  void (*design_moves)(const DesignLook&, int item, Moves&) = nullptr;
  /// `design_form` of all items, where one look gives them with less work; or null.
  void (*design_forms)(const DesignLook&, DesignForm* out) = nullptr;
  /// The number, of u; and u, of the number.
  Interval (*read)(const Interval& u) = nullptr;
  Interval (*smooth)(const Interval& number) = nullptr;
  /// Whether the number falls as u grows.
  bool falls = false;

  /// Of a row of condition numbers with a leg locked: its items are legs from this one on. It has no u: over boxes of
  /// poses it is bounded as the condition number is (conditioning/forms).
  int first_locked = -1;

  /// `number` of all items, at most nine, where one look at a pose gives them with less work; or null.
  void (*numbers)(const PointLook&, double* out) = nullptr;
};

/// "l1" to "r3", in the order of leg_lengths.
const char* leg_name(int leg);

/// The number of a row and its slopes, by P touched points.
template <class Row, int P>
double slopes_of(const PointLook& look, int item, const std::array<int, P>& touched, PointSlopes& out) {
  static_assert(P <= point_count && (P <= 2 || !Row::at_home), "PointSlopes has no room for more");
  using Seen = DualLook<P, Row::at_home>;
  const auto u = Row::u(Seen(look, touched), item);
  const double number = Row::number_of(u.value, look, item), slope = Row::slope(number);
  out.points = out.home_points = 0;
  out.turns = false;
  out.length = 0.0;
  if (slope == 0.0) return number;
  const auto three = [&](int first) {
    const auto f = at_index(first);
    return Vec3(slope * Vec3(u.gradient[f], u.gradient[f + 1], u.gradient[f + 2]));
  };
  for (int k = 0; k < P; ++k) out.at[at_index(out.points++)] = {touched[at_index(k)], three(3 * k)};
  if constexpr (Row::at_home) {
    out.turns = true;
    out.turn = three(Seen::turn);
    out.home_turn = three(Seen::home_turn);
    if (!look.given_axis().isZero(0.0)) return number;
    for (int k = 0; k < P; ++k)
      out.home[at_index(out.home_points++)] = {touched[at_index(k)], three(Seen::home_points + 3 * k)};
  }
  return number;
}

/// Makes the functions of a row from its formula.
template <class Row>
constexpr PoseRow pose_row_of() {
  PoseRow out;
  out.items = Row::items;
  if constexpr (requires { Row::first_leg; }) out.first_leg = Row::first_leg;
  if constexpr (requires { Row::cone_body; }) out.cone_body = Row::cone_body;
  if constexpr (requires { Row::first_at_body; }) out.first_at_body = Row::first_at_body;
  if constexpr (requires { Row::on_the_way; }) out.on_the_way = Row::on_the_way;
  if constexpr (requires { Row::width; }) out.width = Row::width;
  out.part = Row::part;
  out.number = [](const PointLook& look, int item) { return Row::number(look, item); };
  if constexpr (requires(const PointLook& look, double* all) { Row::numbers(look, all); }) out.numbers = Row::numbers;
  out.slopes = Row::slopes;
  if constexpr (requires { Row::read; }) {
    out.form = [](const FormLook& look, int item) { return Row::u(look, item); };
    out.moves = [](const FormLook& look, int item, Moves& moves) { Row::moves(look, item, moves); };
    if constexpr (requires(const DesignLook& look, Moves& moves) { Row::u(look, 0), Row::moves(look, 0, moves); }) {
      out.design_form = [](const DesignLook& look, int item) { return Row::u(look, item); };
      out.design_moves = [](const DesignLook& look, int item, Moves& moves) { Row::moves(look, item, moves); };
      if constexpr (requires(const DesignLook& look, DesignForm* all) { Row::forms(look, all); })
        out.design_forms = [](const DesignLook& look, DesignForm* all) { Row::forms(look, all); };
    }
    out.read = Row::read;
    out.smooth = Row::smooth;
    out.falls = Row::falls;
  }
  if constexpr (requires { Row::pairs; }) out.pairs = Row::pairs;
  if constexpr (requires { Row::first_locked; }) out.first_locked = Row::first_locked;
  if constexpr (requires(const FormLook& look) { Row::numerator(look, 0); }) {
    out.numerator = [](const FormLook& look, int item) { return Row::numerator(look, item); };
    out.design_numerator = [](const DesignLook& look, int item) { return Row::numerator(look, item); };
  }
  return out;
}

}  // namespace ninedof
