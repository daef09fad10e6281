#pragma once
/// Forces and rates of the legs of a machine over a box of poses, and of designs.

#include <optional>

#include "limits/box_system.hpp"
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
  T force(int leg);
  T rate(int leg);

 private:
  /// What balances a load, and the loads with the weights; as nine equations.
  struct Balance {
    BoxSystem<T> system;
    std::vector<Nine<T>> wanted;
  };
  /// Rates of internal legs and of O that make the squares of the former least, of unit motions of the platform.
  struct Settling {
    BoxSystem<T> system;
    std::array<Wrench<T>, 6> unit;
  };
  Balance balance() const;
  Settling settling() const;
  RateOf<T> settled(int leg);

  KnownForms<Look> look_;
  const Duty& duty_;
  std::optional<Balance> balance_;    ///< the same for each leg
  std::optional<Settling> settling_;
};

}  // namespace ninedof
