#include "proof/checker/designs.hpp"

#include "proof/checker/curves.hpp"

namespace ninedof::checker {
namespace {

constexpr double pi = 3.14159265358979323846;
/// Of what a certificate may have: squares and most products stay among the doubles.
constexpr double smallest_number = 1e-100, largest_number = 1e100;

/// Radius of a hexagon with sides s1 and s2, and the angle of its first joint below the x axis.
Range radius(Range s1, Range s2) {
  return root((square(s1) + s1 * s2 + square(s2)) / 3.0);
}
Range below_x(Range s1, Range s2) {
  const auto angle = [](Range a, Range b) { return angle_of(3.0 * a, root(3.0) * (a + 2.0 * b)); };
  return {s1.b > 0.0 ? angle(s1.b, s2.a).a : down(pi / 2.0), s2.b > 0.0 ? angle(s1.a, s2.b).b : up(pi / 6.0)};
}

/// tan(theta/2), theta folded into [0, pi]: an angle counts modulo 2 pi and without its sign.
Range half_tangent(Range theta) {
  constexpr double turn = 2.0 * pi, most = 40.0 * turn,
                   blur = 1e-13;  // blur: far more than the rounding of forty turns
  if (!(theta.b - theta.a < turn - blur) || !(size(theta) < most)) return {0.0, inf};
  const Range wide{theta.a - blur, theta.b + blur};
  const auto meets = [&](double angle) {
    return std::floor((wide.b - angle) / turn) != std::floor((wide.a - angle) / turn);
  };
  const auto folded = [](double x) { return std::abs(x - turn * std::floor(x / turn + 0.5)); };
  const double a = folded(theta.a), b = folded(theta.b);
  const double near = meets(0.0) ? 0.0 : std::min(a, b) - blur, far = meets(pi) ? pi : std::max(a, b) + blur;
  const auto tangent = [](double x) {
    const OnCircle at = sine_cosine(x);
    return at.sine / at.cosine;
  };
  return {std::max(tangent(std::max(near, 0.0) / 2.0).a, 0.0), far < pi - 1e-9 ? tangent(far / 2.0).b : inf};
}

bool disjoint(Range x, Range y) {
  return x.b < y.a || y.b < x.a;
}

}  // namespace

Domain domain_of(const Certificate& c) {
  using Names = std::vector<std::string>;
  const Names hexagon{"a1", "a2", "b1", "b2", "zp", "zs", "theta_z"};
  const Names plates{"base_external_radius",
                     "base_internal_radius",
                     "base_internal_angle",
                     "platform_external_radius",
                     "platform_external_angle",
                     "platform_internal_radius",
                     "platform_internal_angle",
                     "zp",
                     "zs"};
  const bool hexagonal = c.family == "hexagonal";
  if (!hexagonal && c.family != "symmetric") refuse("the family is neither hexagonal nor symmetric");
  const Names& names = hexagonal ? hexagon : plates;
  if (c.variables.size() != names.size()) refuse("the variables are not those of the family");
  for (std::size_t k = 0; k < names.size(); ++k)
    if (c.variables[k].name != names[k]) refuse("variable " + names[k] + " is missing");
  if (!(c.target > 1.0) || !(c.target < inf)) refuse("the target is not a finite number above 1");
  if (!(c.length > 0.0) || !(c.length < inf)) refuse("the characteristic length is not positive and finite");
  const auto ordinary = [](double x) {
    return x == 0.0 || std::isinf(x) || (std::abs(x) >= smallest_number && std::abs(x) <= largest_number);
  };
  for (const std::vector<Bound>& bounds : {c.variables, c.limits})
    for (const auto& [name, range] : bounds)
      if (!ordinary(range.a) || !ordinary(range.b)) refuse("a bound of " + name + " is not from 1e-100 to 1e100");
  if (!ordinary(c.target) || !ordinary(c.length)) refuse("the target or the length is not from 1e-100 to 1e100");
  Domain d;
  d.target = c.target;
  Range angle;
  const auto size_of = [&](Range x) { return meet(x / c.length, {0.0, inf}); };
  const auto variable = [&](std::size_t k) { return c.variables[k].range; };
  const auto positive = [&](std::size_t k) {
    if (!(variable(k).a > 0.0) || !(variable(k).b < inf))
      refuse("the bounds of " + names[k] + " are not positive and finite");
    return size_of(variable(k));
  };
  if (hexagonal) {
    const Range a1 = variable(0), a2 = variable(1), b1 = variable(2), b2 = variable(3);
    for (const Range side : {a1, a2, b1, b2})
      if (!(side.a >= 0.0) || !(side.b < inf)) refuse("the bounds of a side are negative or infinite");
    d.R = d.R_internal = size_of(radius(a1, a2));
    d.U = d.U_internal = size_of(radius(b1, b2));
    d.zp = positive(4);
    d.zs = variable(5);
    angle = variable(6) + below_x(a1, a2) - below_x(b1, b2);
  } else {
    d.dimension = 7;
    d.R = positive(0);
    d.R_internal = positive(1);
    d.U = positive(3);
    d.U_internal = positive(5);
    angle = variable(4);
    d.zp = positive(7);
    d.zs = variable(8);
  }
  if (!(d.zs.a >= 0.0)) refuse("the bounds of zs are negative");
  d.zs = size_of(d.zs);
  for (const auto& [name, range] : c.limits) {
    if (name == "zs_fraction") d.fraction = meet(d.fraction, range);
    else if (name == "radius_ratio") d.radius_ratio = meet(d.radius_ratio, range);
    else if (name == "leg_ratio") d.leg_ratio = std::min(d.leg_ratio, range.b);
    else refuse("the proof knows no limit " + name);
  }

  // Below the target: R U sin(theta) >= zp / target, and 1/q and y/t at most target * sqrt(N).
  const Range area = Range(d.zp.a) / d.target;
  Range& U = d.box[0];
  U = meet(d.U, {(area / d.R.b).a, inf});
  const Range R = meet(d.R, {(area / U.b).a, inf});
  d.box[6] = hexagonal ? Range(1.0) : d.U_internal / U;
  d.box[1] = R / U;
  if (d.radius_ratio.b < inf) d.box[1].b = std::min(d.box[1].b, (d.radius_ratio * std::max(1.0, d.box[6].b)).b);
  if (hexagonal) d.box[1].a = std::max(d.box[1].a, d.radius_ratio.a);
  d.box[5] = hexagonal ? d.box[1] : d.R_internal / U;
  d.box[2] = d.zp / U;
  const double sine = (area / (Range(R.b) * U.b)).a;
  // Where the least sine is lost in rounding, nothing is known of the angle.
  d.box[4] = meet(half_tangent(angle), sine > 0.0 ? Range{0.5 * sine, (2.0 / Range(sine)).b} : Range{0.0, inf});
  const Range room = Range(d.target) * root(square(1.0 + Range(d.box[1].b)) + square(d.box[2].b));
  Range t = meet(d.fraction, d.zs / d.zp);
  t = meet(t, {(d.box[5].a / room).a, (1.0 - d.box[6].a / room).b});
  d.box[3] = {(Range(t.a) / (1.0 - Range(t.a))).a, (Range(t.b) / (1.0 - Range(t.b))).b};
  return d;
}

bool empty(const Box& box) {
  for (const Range& r : box)
    if (r.a > r.b) return true;
  return false;
}

bool outside(const Domain& d, const Box& b) {
  const Range height = b[0] * b[2], t = 1.0 / (1.0 + 1.0 / b[3]);
  if (disjoint(b[0] * b[1], d.R) || disjoint(height, d.zp) || disjoint(height * t, d.zs) || disjoint(t, d.fraction))
    return true;
  if (d.dimension == 5) return false;
  if (disjoint(b[0] * b[5], d.R_internal) || disjoint(b[0] * b[6], d.U_internal)) return true;
  const Range base{std::max(b[1].a, b[5].a), std::max(b[1].b, b[5].b)};
  return disjoint(base / Range(std::max(1.0, b[6].a), std::max(1.0, b[6].b)), d.radius_ratio);
}

Box narrowed(const Domain& d, Box b) {
  const bool seven = d.dimension == 7;
  for (int turn = 0; turn < 2; ++turn) {
    Range& U = b[0];
    const auto product = [&](Range& x, Range bounds) {  // U x is within the bounds
      x = meet(x, bounds / U);
      if (x.sound()) U = meet(U, bounds / x);
      return x.sound() && U.sound();
    };
    if (!product(b[1], d.R) || !product(b[2], d.zp)) return b;
    if (seven && (!product(b[5], d.R_internal) || !product(b[6], d.U_internal))) return b;
    const Range t = meet(meet(1.0 / (1.0 + 1.0 / b[3]), d.fraction), d.zs / (U * b[2]));
    if (!t.sound()) {
      U = {1.0, 0.0};
      return b;
    }
    if (!product(b[2], d.zs / t)) return b;
    const double most = t.b < 1.0 ? (Range(t.b) / (1.0 - Range(t.b))).b : inf;
    b[3] = meet(b[3], {(Range(std::max(t.a, 0.0)) / (1.0 - Range(t.a))).a, most});
    if (!b[3].sound()) return b;
  }
  if (!seven) b[5] = b[1];
  return b;
}

}  // namespace ninedof::checker
