#pragma once
/// An axis design as a list of 14 numbers and a spectrum as a list of 7: what tests perturb and compare.

#include <array>

#include "ninedof/conditioning/symmetric.hpp"

namespace axis {

constexpr int coordinates = 14;
using Flat = std::array<double, coordinates>;

template <class T>
ninedof::AxisDesign<T> design_of(const std::array<T, coordinates>& x) {
  return {{x[0], x[1], x[2]}, {x[3], x[4], x[5]}, {x[6], x[7], x[8]}, {x[9], x[10], x[11]}, x[12], x[13]};
}

template <class T>
std::array<T, 7> values(const ninedof::AxisSpectrum<T>& s) {
  return {s.axial_max, s.axial_min, s.transverse_max, s.transverse_min, s.l, s.q, s.r};
}

inline Flat flat(const ninedof::AxisDesign<double>& d) {
  Flat x{};
  std::size_t k = 0;
  for (const auto* p : {&d.base_external, &d.base_internal, &d.platform_external, &d.platform_internal})
    for (const double value : {p->x, p->y, p->z}) x[k++] = value;
  x[12] = d.zp;
  x[13] = d.zs;
  return x;
}

}  // namespace axis
