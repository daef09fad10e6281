#pragma once
/// Limits on the spread of the lengths of some legs: the quotient or the difference of the longest and the shortest.
///
/// With phi the logarithm of a length, or its quotient by the limit, the limit is  phi(longest) - phi(shortest) <=
/// room. Which legs those are changes from design to design. For a few legs every ordered pair is a margin. For many
/// legs, one auxiliary variable h for each group makes all margins smooth:
///   phi(b) - h >= 0  for every b,    room + h - phi(a) >= 0  for every a.

#include "design/constraints/constraint.hpp"

namespace ninedof {

class Spread : public Constraint {
 public:
  enum class Measure { ratio, difference };

  /// `groups` of `count` legs each.
  Spread(const Limit& limit, Measure measure, int groups, int count, Purpose purpose);

  double price_factor(int row) const override;
  double violation_factor(int row) const override;
  int auxiliary_count() const override { return way_ == Way::auxiliary ? groups_ : 0; }
  double auxiliary_value(const DesignState& v, int group) const override;

 protected:
  /// Leg `k` of a group, and its longest and shortest leg.
  virtual LegExtreme leg(const DesignState& v, int group, int k) const = 0;
  virtual LegExtreme longest(const DesignState& v, int group) const = 0;
  virtual LegExtreme shortest(const DesignState& v, int group) const = 0;

 private:
  enum class Way { pairs, auxiliary, ruling };
  static constexpr int few = 9;

  int each() const;
  int items(Side side) const override;
  double item_margin(const DesignState& v, Side side, int item) const override;
  void add_item_gradient(const DesignState& v, Side side, int item, Row out) const override;

  double room() const;
  double phi(const DesignState& v, const LegExtreme& l) const;
  void add_phi(const DesignState& v, const LegExtreme& l, double scale, Row out) const;
  std::pair<LegExtreme, LegExtreme> pair(const DesignState& v, int group, int item) const;

  Measure measure_;
  int groups_, count_;
  Way way_;
};

}  // namespace ninedof
