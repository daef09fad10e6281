#pragma once
/// Numbers of a pose as functions to be maximized: bounds over a box, and what is attained at a point.

#include <memory>

#include "proof/region/pose.hpp"

namespace ninedof::over_region {

/// What a bound over a box goes by.
struct Slopes {
  std::array<double, PoseForm::size> slope{};  ///< of the function, per half width of each coordinate
  Moves moves;                                 ///< of the vectors it is made of
};

class Quantity {
 public:
  virtual ~Quantity() = default;
  /// At least every value at the poses of the domain in the box.
  virtual double bound(const Domain& domain, const Box& box, Slopes& slopes) const = 0;
  /// At most the value at a pose given as a box of one point.
  virtual double attained(const FormPose& point) const = 0;
  /// The number itself, as it is asked for, where the function to be maximized is within [low, high].
  virtual Interval number(const Interval& value) const = 0;
};

std::unique_ptr<Quantity> make_quantity(const PosedRobot& machine, const PoseQuantity& wanted);

}  // namespace ninedof::over_region
