#pragma once
/// The paper's semi-regular hexagons (eqs. 37-38) at the neutral configuration (eq. 6), with the twist theta_z.

#include <numbers>

#include "ninedof/axis_family.hpp"

namespace ninedof {

class HexagonalFamily : public AxisFamily<HexagonalFamily, 7> {
 public:
  const std::string& name() const override { return name_; }
  const std::vector<VariableInfo>& variables() const override { return variables_; }

  Geometry geometry(std::span<const double> x) const override { return Geometry::hexagonal(x[0], x[1], x[2], x[3]); }
  Configuration configuration(std::span<const double> x) const override { return neutral(x[4], x[5], x[6]); }

  template <class T>
  AxisDesign<T> axis_design(const std::array<T, 7>& x) const {
    using std::cos;
    using std::sin;
    const auto& [a1, a2, b1, b2, zp, zs, theta_z] = x;
    const T zero(0.0);
    const T ay = side_height(a1, a2), by = side_height(b1, b2);
    const T half_a = 0.5 * a1, half_b = 0.5 * b1;
    const T c = cos(theta_z), s = sin(theta_z);
    return {{half_a, ay, zero},
            {-half_a, ay, zero},
            {c * half_b - s * by, s * half_b + c * by, zero},
            {-(c * half_b) - s * by, c * by - s * half_b, zero},
            zp,
            zs};
  }

 private:
  /// y of joints 1 in eqs. (37)-(38)
  template <class T>
  static T side_height(const T& s1, const T& s2) {
    return (-std::numbers::sqrt3 / 6.0) * (s1 + 2.0 * s2);
  }

  std::string name_ = "hexagonal";
  std::vector<VariableInfo> variables_{{"a1", false, 0.0, 60.0},   {"a2", false, 0.0, 60.0},  {"b1", false, 0.0, 60.0},
                                       {"b2", false, 0.0, 60.0},   {"zp", false, 0.05, 80.0}, {"zs", false, 0.05, 80.0},
                                       {"theta_z", true, 0.0, 0.0}};
};

}  // namespace ninedof
