#pragma once
/// Forces and rates of the legs of a machine over a box of poses.

#include "limits/leg_duty.hpp"

namespace ninedof {

/// What forces need of a FormLook, each formed once.
class KnownForms {
 public:
  using Number = PoseForm;
  explicit KnownForms(const FormLook& look);
  const FormVector& at(int point) const { return at_[at_index(point)]; }
  const FormVector& direction(int leg) const { return direction_[at_index(leg)]; }
  const std::array<FormVector, 3>& q() const { return look_.q(); }
  const Duty& duty() const { return look_.duty(); }

 private:
  const FormLook& look_;
  std::array<FormVector, point_count> at_;
  std::array<FormVector, 9> direction_;
};

class DutyOverBox {
 public:
  explicit DutyOverBox(const FormLook& look) : look_(look), duty_(look.duty()) {}
  PoseForm force(int leg) const;
  PoseForm rate(int leg) const;

 private:
  RateOf<PoseForm> settled(int leg) const;

  KnownForms look_;
  const Duty& duty_;
};

}  // namespace ninedof
