#pragma once
/// Numbers of a pose as functions to be maximized: bounds over a box, and what is attained at a point.

#include <memory>

#include "proof/region/pose.hpp"

namespace ninedof::over_region {

/// What a bound over a box goes by.
struct Slopes {
  std::array<double, form_size> slope{};  ///< of the function, per half width of each coordinate
  std::array<double, form_size> moves{};  ///< how far the vectors it is made of move
  void add(const Vector& v, double scale = 1.0) {
    for (const Form* x : {&v.x, &v.y, &v.z})
      for (std::size_t k = 0; k < form_size; ++k) moves[k] = std::max(moves[k], scale * std::abs(x->a[k]));
  }
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

/// The ends of a leg, in the order of leg_ends.
struct Ends {
  Vector from, to;
};
Ends ends_of(const Geometry& g, const FormPose& pose, int leg);

}  // namespace ninedof::over_region
