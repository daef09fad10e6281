#include "ninedof/families/design_family.hpp"

#include "ninedof/families/general_family.hpp"
#include "ninedof/families/hexagonal_family.hpp"
#include "ninedof/families/symmetric_family.hpp"
#include "ninedof/math/error.hpp"

namespace ninedof {
namespace {

std::vector<const DesignFamily*> all_families() {
  static const HexagonalFamily hexagonal;
  static const SymmetricFamily<9> symmetric;
  static const SymmetricFamily<13> symmetric_nonplanar;
  static const GeneralFamily general;
  return {&hexagonal, &symmetric, &symmetric_nonplanar, &general};
}

}  // namespace

const char* to_string(VariableKind kind) {
  switch (kind) {
    case VariableKind::length: return "length";
    case VariableKind::coordinate: return "coordinate";
    case VariableKind::angle: return "angle";
    case VariableKind::fraction: return "fraction";
  }
  return "";
}

void DesignFamily::axis(std::span<const double>, double, const AxisShift&, Machine, AxisPoint&) const {
  throw InvalidArgument("family", "\"" + name() + "\"", "a family of designs symmetric about z");
}

Geometry DesignFamily::geometry(std::span<const double> x) const {
  Blueprint b;
  blueprint(x, b);
  const auto triple = [&](std::size_t first) -> Triple {
    return {b.joint[first], b.joint[first + 1], b.joint[first + 2]};
  };
  return {triple(point_r), triple(point_r_hat), triple(point_u), triple(point_u_tilde)};
}

Configuration DesignFamily::configuration(std::span<const double> x) const {
  Blueprint b;
  blueprint(x, b);
  return neutral(b.zp, b.zs, b.theta_z);
}

int DesignFamily::index(const std::string& variable) const {
  const auto& all = variables();
  for (std::size_t k = 0; k < all.size(); ++k)
    if (all[k].name == variable) return static_cast<int>(k);
  throw InvalidArgument("variable", "\"" + variable + "\"", "a variable of the family " + name());
}

std::vector<std::string> design_family_names() {
  std::vector<std::string> names;
  for (const DesignFamily* f : all_families()) names.push_back(f->name());
  return names;
}

const DesignFamily& design_family(const std::string& name) {
  std::string known;
  for (const DesignFamily* f : all_families()) {
    if (f->name() == name) return *f;
    known += (known.empty() ? "\"" : ", \"") + f->name() + "\"";
  }
  throw InvalidArgument("family", "\"" + name + "\"", "one of " + known);
}

}  // namespace ninedof
