#include "ninedof/families/general_family.hpp"

#include "ninedof/math/error.hpp"

namespace ninedof {

GeneralFamily::GeneralFamily() {
  const Geometry published = Geometry::hexagonal(0.0, 5.8124, 2.9062, 0.0);
  const auto add = [&](const char* triple, const Triple& joints) {
    for (std::size_t i = 0; i < 3; ++i)
      for (int axis = 0; axis < 3; ++axis)
        variables_.push_back({std::string(triple) + "_" + std::to_string(i + 1) + "_" + "xyz"[axis],
                              VariableKind::coordinate, joints[i][axis], joints[i][axis]});
  };
  add("base_external", published.base_external());
  add("base_internal", published.base_internal());
  add("platform_external", published.platform_external());
  add("platform_internal", published.platform_internal());
  variables_.push_back({"zp", VariableKind::length, 0.05, 80.0});
  variables_.push_back({"zs", VariableKind::length, 0.05, 80.0});
  variables_.push_back({"theta_z", VariableKind::angle, 0.0, 0.0});
}

void GeneralFamily::blueprint(std::span<const double> x, Blueprint& out) const {
  if (x.size() != blueprint_rows)
    throw InvalidArgument("x", std::to_string(x.size()) + " values", std::to_string(static_cast<int>(blueprint_rows)));
  for (std::size_t k = 0; k < out.joint.size(); ++k) out.joint[k] = Vec3(x[3 * k], x[3 * k + 1], x[3 * k + 2]);
  out.zp = x[row_zp];
  out.zs = x[row_zs];
  out.theta_z = x[row_theta_z];
  out.gradient.setIdentity(blueprint_rows, blueprint_rows);
}

}  // namespace ninedof
