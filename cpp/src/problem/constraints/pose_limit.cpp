/// A limit at every pose, and where its row says so at home and on the way there.
/// Declared in problem/constraints/solver_rows.hpp.

#include <algorithm>

#include "problem/constraints/solver_rows.hpp"

namespace ninedof {
namespace {

constexpr double beyond_all = 1e150;  // a condition number without end, to the solver

class PoseLimit : public SolverRows {
 public:
  PoseLimit(const Limit& limit, const LimitRow& row, int poses, const std::array<bool, leg_pairs>& exempt)
      : SolverRows(limit, row.solver),
        row_(row),
        poses_(row.on_the_way() ? 1 + poses * limit.steps : std::max(poses, 1)),
        exempt_(exempt),
        options_(limit.options()) {}

  /// Which points of two legs are nearest changes from design to design, and so does the load that rules.
  bool analytic() const override { return !row_.pose->pairs && *row_.info.needs == '\0'; }

  void margins(const DesignState& v, std::span<const MarginRow> rows, double* out) const override {
    if (row_.pose->numbers == nullptr) return SolverRows::margins(v, rows, out);
    std::array<double, 9> numbers;
    int known = -1;  // the pose that they are of
    for (const MarginRow& row : rows) {
      const auto [side, item] = item_of(row.row);
      if (pose(v, item) != known) {
        known = pose(v, item);
        row_.pose->numbers(look(v, item), numbers.data());
      }
      *out++ = margin_of(side, in_units(v, numbers[at_index(index(item))]));
    }
  }

 private:
  int items(Side) const override { return row_.pose->items * poses_; }
  int index(int item) const { return item % row_.pose->items; }
  std::string part(int item) const override { return row_.pose->part(index(item)); }
  /// The neutral pose comes first where the way is looked at.
  int pose(const DesignState& v, int item) const override {
    return (row_.on_the_way() ? 0 : first_pose(v)) + item / row_.pose->items;
  }
  bool exempt(int item) const { return row_.pose->pairs && exempt_[at_index(index(item))]; }
  PointLook look(const DesignState& v, int item) const {
    return {v.pose(pose(v, item)), v.pose(0), options_, v.characteristic_length};
  }

  double value(const DesignState& v, Side, int item) const override {
    // Never the least, in any unit.
    if (exempt(item)) return 1e6 * std::max(limit().low, v.length(v.longest) / unit(v));
    return in_units(v, row_.pose->number(look(v, item), index(item)));
  }
  double in_units(const DesignState& v, double number) const { return std::min(number, beyond_all) / unit(v); }
  void add_item_gradient(const DesignState& v, Side side, int item, Row out) const override {
    if (exempt(item)) return;
    PointSlopes slopes;
    const double number = row_.pose->slopes(look(v, item), index(item), slopes), u = unit(v);
    const double by = margin_slope(side, in_units(v, number)) / u;
    if (by == 0.0) return;
    const int k = pose(v, item);
    for (int n = 0; n < slopes.points; ++n)
      v.add_point(k, slopes.at[at_index(n)].point, by * slopes.at[at_index(n)].slope, out);
    for (int n = 0; n < slopes.home_points; ++n)
      v.add_point(0, slopes.home[at_index(n)].point, by * slopes.home[at_index(n)].slope, out);
    if (slopes.turns) {
      v.add_turn(k, by * slopes.turn, out);
      v.add_turn(0, by * slopes.home_turn, out);
    }
    v.add_length(by * slopes.length, out);
    add_unit_gradient(v, -by * number / u, out);
  }

  const LimitRow& row_;
  int poses_;
  std::array<bool, leg_pairs> exempt_;
  LimitOptions options_;
};

}  // namespace

std::unique_ptr<SolverRows> make_pose_limit(const Limit& limit, const LimitRow& row, int poses,
                                            const std::array<bool, leg_pairs>& exempt) {
  return std::make_unique<PoseLimit>(limit, row, poses, exempt);
}

}  // namespace ninedof
