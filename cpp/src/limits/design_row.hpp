#pragma once
/// Limits of the design alone, as rows over every number type. An item touches two joints at most, zp and zs.

#include <span>
#include <utility>

#include "math/form.hpp"
#include "ninedof/limits/limits.hpp"
#include "ninedof/math/dual.hpp"
#include "ninedof/math/interval.hpp"
#include "ninedof/math/xyz.hpp"
#include "ninedof/robot/points.hpp"

namespace ninedof {

/// The twelve joints in the order of Points, each in the frame of its body.
using Joints = std::span<const Vec3, 12>;

/// The joint of a body (0 base, 6 platform, -1 both) farthest from z.
int widest_joint(Joints joints, int body);

/// What an item touches.
template <class T>
struct Touched {
  Xyz<T> a, b;
  T zp, zs;
};

/// A number and its derivatives by what it touches.
struct DesignSlopes {
  double value;
  Vec3 a, b;
  double zp, zs;
};

struct DesignRow {
  bool picks_widest;  ///< whether `joints` depends on which joint is farthest from z
  /// A piecewise function has an item for each piece that may rule.
  int (*items)(Side side);
  /// The joints a and b that an item touches.
  std::pair<int, int> (*joints)(Joints joints, Side side, int item);
  /// The body whose radius is the unit, see widest_joint.
  int (*body)(int item);
  double (*number)(const Touched<double>&, int item);
  DesignSlopes (*slopes)(const Touched<double>&, int item);
  Interval (*enclosure)(const Touched<Interval>&, int item);
  DesignForm (*form)(const Touched<DesignForm>&, int item);  ///< over a box of designs
};

}  // namespace ninedof
