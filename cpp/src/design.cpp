#include "ninedof/design.hpp"

#include "ninedof/error.hpp"
#include "ninedof/hexagonal_family.hpp"

namespace ninedof {
namespace {

std::vector<const DesignFamily*> all_families() {
  static const HexagonalFamily hexagonal;
  return {&hexagonal};
}

}  // namespace

Extremes DesignPoint::extremes() const {
  return {value[log_transverse_max] > value[log_axial_max] ? log_transverse_max : log_axial_max,
          value[log_transverse_min] < value[log_axial_min] ? log_transverse_min : log_axial_min};
}

double DesignPoint::log_condition_number() const {
  const Extremes k = extremes();
  return value[k.max] - value[k.min];
}

Eigen::VectorXd DesignPoint::log_condition_number_gradient() const {
  const Extremes k = extremes();
  return gradient.row(k.max) - gradient.row(k.min);
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
