#pragma once
/// C3 designs whose four joint triples have their own radius, angle and, where not planar, height.

#include "ninedof/families/axis_family.hpp"

namespace ninedof {

/// Variables: radius of the external base triple (at angle 0), then radius and angle of the other three, zp, zs; and,
/// where N = 13, the four heights.
template <int N>
class SymmetricFamily : public AxisFamily<SymmetricFamily<N>, N> {
  static_assert(N == 9 || N == 13);

 public:
  const std::string& name() const override { return name_; }
  const std::vector<VariableInfo>& variables() const override { return variables_; }

  template <class T>
  Orbits<T> orbits(std::span<const T, N> x) const {
    const T zero(0.0);
    const auto height = [&](std::size_t k) -> T {
      if constexpr (N == 13) return x[9 + k];
      else return zero;
    };
    return {{x[0], zero, height(0)},
            at(x[1], x[2], height(1)),
            at(x[3], x[4], height(2)),
            at(x[5], x[6], height(3)),
            x[7],
            x[8],
            zero};
  }

 private:
  template <class T>
  static Xyz<T> at(const T& radius, const T& angle, const T& height) {
    using std::cos;
    using std::sin;
    return {radius * cos(angle), radius * sin(angle), height};
  }

  static std::vector<VariableInfo> named() {
    const auto radius = [](const char* name) { return VariableInfo{name, VariableKind::length, 0.05, 12.0}; };
    constexpr double open = std::numeric_limits<double>::infinity();
    const auto angle = [](const char* name) { return VariableInfo{name, VariableKind::angle, -open, open}; };
    std::vector<VariableInfo> all{radius("base_external_radius"),
                                  radius("base_internal_radius"),
                                  angle("base_internal_angle"),
                                  radius("platform_external_radius"),
                                  angle("platform_external_angle"),
                                  radius("platform_internal_radius"),
                                  angle("platform_internal_angle"),
                                  {"zp", VariableKind::length, 0.05, 80.0},
                                  {"zs", VariableKind::length, 0.05, 80.0}};
    if constexpr (N == 13)
      for (const char* name :
           {"base_external_height", "base_internal_height", "platform_external_height", "platform_internal_height"})
        all.push_back({name, VariableKind::coordinate, -12.0, 12.0});
    return all;
  }

  std::string name_ = N == 13 ? "symmetric_nonplanar" : "symmetric";
  std::vector<VariableInfo> variables_ = named();
};

}  // namespace ninedof
