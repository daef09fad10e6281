/// leg_ratio: longest over shortest leg, of all legs at all poses where the limit holds. stroke: longest less shortest
/// length of each leg over those poses; stroke_ratio: longest over shortest. Declared in
/// problem/constraints/solver_rows.hpp.
///
/// With phi the logarithm of a length, or its quotient by the limit, the limit is  phi(longest) - phi(shortest) <=
/// room. Which legs those are changes from design to design. For a few legs every ordered pair is a margin. For many
/// legs, one auxiliary variable h for each group makes all margins smooth:
///   phi(b) - h >= 0  for every b,    room + h - phi(a) >= 0  for every a.

#include <algorithm>
#include <cmath>

#include "problem/constraints/solver_rows.hpp"

namespace ninedof {
namespace {

class Spread : public SolverRows {
 public:
  /// One group of all legs, or one for each leg; a leg at each of `poses` poses is a member.
  Spread(const Limit& limit, const LimitRow& row, int poses, Purpose purpose)
      : SolverRows(limit, row.solver),
        row_(row),
        each_leg_(row.spread->each_leg),
        groups_(each_leg_ ? 9 : 1),
        count_(each_leg_ ? poses : 9 * poses),
        way_(purpose == Purpose::evaluate || count_ < 2 || !std::isfinite(limit.high) ? Way::ruling
             : count_ <= few                                                          ? Way::pairs
                                                                                      : Way::auxiliary) {}

  bool compares_poses() const override { return !at_neutral(); }
  double price_factor(int row) const override {
    const auto [side, item] = item_of(row);
    return way_ == Way::auxiliary && side == Side::high && item % each() < count_ ? 0.0 : 1.0;
  }
  double violation_factor(int row) const override {
    return way_ == Way::auxiliary && item_of(row).first == Side::high ? 2.0 : 1.0;
  }
  int auxiliary_count() const override { return way_ == Way::auxiliary ? groups_ : 0; }
  double auxiliary_value(const DesignState& v, int group) const override {
    // In the middle between the bounds of h, whether they leave room or not.
    return 0.5 * (phi(v, shortest(v, group)) + phi(v, longest(v, group)) - room());
  }

  std::vector<int> poses_of(const DesignState& v, int row) const override {
    const auto [side, item] = item_of(row);
    if (side == Side::low) return {longest(v, item).pose, shortest(v, item).pose};
    const int group = item / each(), k = item % each();
    if (way_ == Way::auxiliary) return {leg(v, group, k % count_).pose};
    const auto [a, b] = pair(v, group, k);
    return {a.pose, b.pose};
  }

 private:
  std::string part(int item) const override { return each_leg_ && way_ == Way::ruling ? leg_name(item) : ""; }
  enum class Way { pairs, auxiliary, ruling };
  static constexpr int few = 9;

  int each() const {
    switch (way_) {
      case Way::pairs: return count_ * (count_ - 1);
      case Way::auxiliary: return 2 * count_;
      case Way::ruling: return 1;
    }
    return 0;
  }
  int items(Side side) const override {
    // At least: only the longest and the shortest leg count.
    return side == Side::high ? groups_ * each() : groups_;
  }

  /// Member `k` of a group, and its longest and shortest. At the neutral pose there is one group, of all legs.
  LegExtreme leg(const DesignState& v, int group, int k) const {
    return each_leg_ ? LegExtreme{first_pose(v) + k, group} : LegExtreme{first_pose(v) + k / 9, k % 9};
  }
  static const Vec9& neutral(const DesignState& v) { return v.pose(0).legs.length; }
  LegExtreme longest(const DesignState& v, int group) const {
    if (at_neutral()) return {0, static_cast<int>(std::ranges::max_element(neutral(v)) - neutral(v).begin())};
    return each_leg_ ? LegExtreme{v.longest_of[at_index(group)], group} : v.longest;
  }
  LegExtreme shortest(const DesignState& v, int group) const {
    if (at_neutral()) return {0, static_cast<int>(std::ranges::min_element(neutral(v)) - neutral(v).begin())};
    return each_leg_ ? LegExtreme{v.shortest_of[at_index(group)], group} : v.shortest;
  }

  double room() const { return row_.spread->width(limit().high); }
  double size(const DesignState& v) const { return row_.spread->ratio ? v.unit : limit().high * unit(v); }
  double phi(const DesignState& v, const LegExtreme& l) const { return row_.spread->measured(v.length(l), size(v)); }
  void add_phi(const DesignState& v, const LegExtreme& l, double scale, Row out) const {
    const double length = v.length(l), size = this->size(v);
    const bool ratio = row_.spread->ratio;
    if (!ratio || length > 0.0) v.add_leg(l.pose, l.leg, scale / row_.spread->slope_over(length, size), out);
    if (!ratio) add_unit_gradient(v, -scale * length * limit().high / (size * size), out);
  }
  std::pair<LegExtreme, LegExtreme> pair(const DesignState& v, int group, int item) const {
    if (way_ == Way::ruling) return {longest(v, group), shortest(v, group)};
    const int a = item / (count_ - 1), b = item % (count_ - 1);
    return {leg(v, group, a), leg(v, group, b < a ? b : b + 1)};
  }

  double item_margin(const DesignState& v, Side side, int item) const override {
    if (side == Side::low)
      return phi(v, longest(v, item)) - phi(v, shortest(v, item)) - row_.spread->width(limit().low);
    const int group = item / each(), k = item % each();
    if (way_ != Way::auxiliary) {
      const auto [a, b] = pair(v, group, k);
      return room() - (phi(v, a) - phi(v, b));
    }
    const double h = v.x[auxiliary_variable() + group];
    return k < count_ ? phi(v, leg(v, group, k)) - h : room() + h - phi(v, leg(v, group, k - count_));
  }
  void add_item_gradient(const DesignState& v, Side side, int item, Row out) const override {
    if (side == Side::low) {
      add_phi(v, longest(v, item), 1.0, out);
      add_phi(v, shortest(v, item), -1.0, out);
      return;
    }
    const int group = item / each(), k = item % each();
    if (way_ != Way::auxiliary) {
      const auto [a, b] = pair(v, group, k);
      add_phi(v, a, -1.0, out);
      add_phi(v, b, 1.0, out);
      return;
    }
    const double sign = k < count_ ? 1.0 : -1.0;
    add_phi(v, leg(v, group, k % count_), sign, out);
    out[auxiliary_coordinate() + group] -= sign;
  }

  const LimitRow& row_;
  bool each_leg_;
  int groups_, count_;
  Way way_;
};

}  // namespace

std::unique_ptr<SolverRows> make_spread(const Limit& limit, const LimitRow& row, int poses, Purpose purpose) {
  return std::make_unique<Spread>(limit, row, std::max(poses, 1), purpose);
}

}  // namespace ninedof
