#pragma once
/// Any twelve joints: 36 coordinates in their bodies' frames, with the neutral configuration on the z axis.

#include "ninedof/families/design_family.hpp"

namespace ninedof {

/// Variables: base_external_1_x ... platform_internal_3_z, zp, zs, theta_z. Those not given stand at the published
/// coupled triangles (base side 5.8124, platform side 2.9062, in characteristic lengths), so that any subset may be
/// freed.
class GeneralFamily : public DesignFamily {
 public:
  GeneralFamily();
  const std::string& name() const override { return name_; }
  const std::vector<VariableInfo>& variables() const override { return variables_; }
  void blueprint(std::span<const double> x, Blueprint& out) const override;

 private:
  std::string name_ = "general";
  std::vector<VariableInfo> variables_;
};

}  // namespace ninedof
