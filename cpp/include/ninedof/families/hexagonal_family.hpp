#pragma once
/// The paper's semi-regular hexagons (eqs. 37-38) at the neutral configuration (eq. 6), with the twist theta_z.

#include "ninedof/families/axis_family.hpp"
#include "ninedof/robot/hexagon.hpp"

namespace ninedof {

class HexagonalFamily : public AxisFamily<HexagonalFamily, 7> {
 public:
  const std::string& name() const override { return name_; }
  const std::vector<VariableInfo>& variables() const override { return variables_; }

  Geometry geometry(std::span<const double> x) const override { return Geometry::hexagonal(x[0], x[1], x[2], x[3]); }

  template <class T>
  Orbits<T> orbits(std::span<const T, 7> x) const {
    const Xyz<T> base = hexagon_joint_1(x[0], x[1]), platform = hexagon_joint_1(x[2], x[3]);
    return {base, mirrored(base), platform, mirrored(platform), x[4], x[5], x[6]};
  }

 private:
  std::string name_ = "hexagonal";
  std::vector<VariableInfo> variables_{
      {"a1", VariableKind::length, 0.0, 60.0},   {"a2", VariableKind::length, 0.0, 60.0},
      {"b1", VariableKind::length, 0.0, 60.0},   {"b2", VariableKind::length, 0.0, 60.0},
      {"zp", VariableKind::length, 0.05, 80.0},  {"zs", VariableKind::length, 0.05, 80.0},
      {"theta_z", VariableKind::angle, 0.0, 0.0}};
};

}  // namespace ninedof
