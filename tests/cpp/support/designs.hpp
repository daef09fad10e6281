#pragma once
/// Random designs of every family, and derivatives by differences.

#include <string>
#include <vector>

#include "ninedof/families/design_family.hpp"
#include "ninedof/problem/problem.hpp"
#include "ninedof/robot/points.hpp"
#include "support/support.hpp"

namespace designs {

using namespace support;
using ninedof::design_family;
using ninedof::DesignFamily;

inline const std::vector<std::string> families{"hexagonal", "symmetric", "symmetric_nonplanar", "general"};
inline const std::vector<std::string> axis_families{"hexagonal", "symmetric", "symmetric_nonplanar"};

/// A robot of ordinary size, O between the plates, no two joints in one place.
inline Eigen::VectorXd random_design(const std::string& family, Random& random) {
  const auto& variables = design_family(family).variables();
  Eigen::VectorXd x(static_cast<Eigen::Index>(variables.size()));
  for (Eigen::Index k = 0; k < x.size(); ++k) {
    const auto& v = variables[static_cast<std::size_t>(k)];
    const bool base = v.name.starts_with("base") || v.name.starts_with("a");
    if (v.kind == ninedof::VariableKind::length) x[k] = random.uniform(base ? 2.0 : 0.7, base ? 4.0 : 1.8);
    else x[k] = random.uniform(-0.5, 0.5);
    if (v.kind == ninedof::VariableKind::angle && v.name != "theta_z") x[k] = random.uniform(-pi, pi);
  }
  if (family == "general")
    for (int triple = 0; triple < 4; ++triple) {
      const Triple joints = random_triple(random, triple < 2 ? 2.5 : 1.2);
      for (int i = 0; i < 3; ++i) x.segment<3>(9 * triple + 3 * i) = joints[static_cast<std::size_t>(i)];
    }
  const int zp = design_family(family).index("zp"), zs = design_family(family).index("zs");
  x[zp] = random.uniform(2.5, 4.5);
  x[zs] = x[zp] * random.uniform(0.35, 0.65);
  return x;
}

/// A value for every variable of the problem: of its family, the places of O, the characteristic length.
inline Eigen::VectorXd random_full(const ninedof::Problem& p, Random& random) {
  const Eigen::VectorXd own = random_design(p.family, random);
  Eigen::VectorXd x(static_cast<Eigen::Index>(p.names().size()));
  x.head(own.size()) = own;
  const std::vector<std::string> names = p.names();
  for (Eigen::Index k = own.size(); k < x.size(); ++k)
    x[k] = names[static_cast<std::size_t>(k)] == "characteristic_length" ? random.uniform(0.7, 2.0)
                                                                         : random.uniform(-0.1, 0.1);
  return x;
}

constexpr Eigen::Index point_coordinates = 3 * ninedof::point_count + 1;  // the points', then the characteristic length

inline ninedof::Points points_of(const Eigen::VectorXd& x) {
  ninedof::Points at;
  for (int k = 0; k < ninedof::point_count; ++k) at[static_cast<std::size_t>(k)] = x.segment<3>(3 * k);
  return at;
}

/// df/dx_k to fourth order in h.
template <class Function>
auto difference(const Function& f, const Eigen::VectorXd& x, Eigen::Index k, double h) {
  const auto at = [&](double steps) {
    Eigen::VectorXd y = x;
    y[k] += steps * h;
    return f(y);
  };
  using Value = std::decay_t<decltype(f(x))>;
  const Value a = at(-2), b = at(-1), c = at(1), d = at(2);
  return Value((8.0 * (c - b) - (d - a)) / (12.0 * h));
}

}  // namespace designs
