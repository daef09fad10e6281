#pragma once
/// Forces and rates of the legs of a machine over a box of poses, and of designs.

#include "limits/leg_duty.hpp"

namespace ninedof {

/// What forces need of a look at forms, each formed once.
template <class Look>
class KnownForms {
 public:
  using Number = typename Look::Number;
  using Vector = typename Look::Vector;
  explicit KnownForms(const Look& look);
  const Vector& at(int point) const { return at_[at_index(point)]; }
  const Vector& direction(int leg) const { return direction_[at_index(leg)]; }
  const std::array<Vector, 3>& q() const { return look_.q(); }
  const Duty& duty() const { return look_.duty(); }

 private:
  const Look& look_;
  std::array<Vector, point_count> at_;
  std::array<Vector, 9> direction_;
};

template <class Look>
class DutyOverBox {
 public:
  using T = typename Look::Number;
  explicit DutyOverBox(const Look& look) : look_(look), duty_(look.duty()) {}
  T force(int leg) const;
  T rate(int leg) const;

 private:
  RateOf<T> settled(int leg) const;

  KnownForms<Look> look_;
  const Duty& duty_;
};

}  // namespace ninedof
