#include "position/length_unit.hpp"

#include <algorithm>
#include <cmath>

#include "ninedof/math/error.hpp"

namespace ninedof {
namespace {

constexpr double ordinary = 0x1p100;  // between 2^-100 and 2^100 no product of up to five lengths overflows

template <class Vector>
Vector times_power(Vector v, int exponent) {
  for (double& x : v) x = std::ldexp(x, exponent);
  return v;
}

Triple times_power(const Triple& t, int exponent) {
  return {times_power(t[0], exponent), times_power(t[1], exponent), times_power(t[2], exponent)};
}

}  // namespace

double largest_coordinate(const Geometry& g) {
  const auto largest = [](const Triple& t) { return Eigen::Map<const Vec9>(t[0].data()).lpNorm<Eigen::Infinity>(); };
  return std::max({largest(g.base_external()), largest(g.base_internal()), largest(g.platform_external()),
                   largest(g.platform_internal())});
}

int unit_exponent(double largest) {
  return largest < ordinary && largest > 1.0 / ordinary ? 0 : std::ilogb(largest);
}

std::optional<Geometry> scaled(const Geometry& g, int exponent) {
  try {
    return Geometry(times_power(g.base_external(), exponent), times_power(g.base_internal(), exponent),
                    times_power(g.platform_external(), exponent), times_power(g.platform_internal(), exponent));
  } catch (const InvalidArgument&) {
    return {};
  }
}

Vec9 scaled(const Vec9& lengths, int exponent) {
  return times_power(lengths, exponent);
}

Configuration scaled(const Configuration& c, int exponent) {
  return {times_power(c.position, exponent), c.rotation, times_power(c.internal_point, exponent)};
}

}  // namespace ninedof
