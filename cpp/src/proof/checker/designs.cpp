#include "proof/checker/designs.hpp"

#include <span>

#include "proof/checker/curves.hpp"
#include "proof/checker/designs_file.hpp"

namespace ninedof::checker {
namespace {

constexpr double pi = 3.14159265358979323846;

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

/// The unit of lengths, which l_c is not below but where nothing is known of it.
double unit_of(const Certificate& c, double least_height, Domain& d) {
  if (c.length_kind.empty()) {
    if (c.length.a != c.length.b) d.scale = {1.0, (c.length.b / Range(c.length.a)).b};
    return c.length.a;
  }
  d.scale = {0.0, inf};
  if (c.length_kind == "natural") d.length = Length::natural;
  if (c.length_kind == "platform_radius") d.length = Length::platform_radius;
  if (c.length_kind != "mean_leg") return 1.0;
  d.length = Length::mean_leg;  // three legs, the other two one after the other, from plate to plate
  const double least = (Range(least_height) * 2.0 / 3.0).a;
  if (!(least > 0.0)) return 1.0;
  d.scale.a = 1.0;
  return least;
}

/// zp / l_c of designs below the target, where the bounds of zp begin at 0.
double least_height(const Domain& d) {
  if (!(d.scale.a > 0.0) || d.slopes) refuse("the bounds of zp begin at 0");
  const Range K = d.target, most = std::max(d.R.b, d.U.b);
  const double least = std::min(d.R_internal.a, d.U_internal.a);
  const bool hexagonal = d.dimension == 5;
  const Range leg = hexagonal ? 1.0 / K : (Range(d.R_internal.a) + d.U_internal.a) / (K * most);
  const Range slope = hexagonal ? K * most : d.zp.b / Range(least);
  return (leg / (K * root(2.0 + square(slope)))).a;
}

/// R and U of designs below the target, where l_c may be anything.
void bound_radii(const Domain& d, Range& R, Range& U) {
  const Range K = d.target, flat2 = square(Range(R.b) + U.b);
  R.a = std::max(R.a, (square(Range(d.zp.a) / K) / root(flat2 + square(Range(d.zp.a)))).a);  // grows with zp
  if (d.dimension == 5) {
    if (d.radius_ratio.b < inf) U.a = std::max(U.a, (R.a / Range(d.radius_ratio.b)).a);
  } else if (!d.slopes) {
    const Range q = d.U_internal.a / (K * root(flat2 + square(Range(d.zp.b)))), z = d.zp.b / Range(d.U_internal.a);
    const Range l_c = d.zp.a / (K * root(2.0 / square(q) + square(z) + square(d.zp.b / (q * d.R_internal.a))));
    U.a = std::max(U.a, (d.zp.a * l_c / (K * R.b)).a);
  }
  if (!(U.a > 0.0)) refuse("with this characteristic length the platform may shrink to a point");
}

/// The last three coordinates where radii of internal joints begin at 0.
void take_slopes(Domain& d, Range U, Range room, Range t) {
  const Range eta = d.box[2].a, x = d.box[1].b, K = d.target;
  const Range leg2 = square(1.0 + x) + square(eta), spin2 = square(eta * d.box[0].b);
  const Range flat{(square(eta) * root(Range(2.0)) / (K * root(leg2 * (1.0 + spin2)))).a, room.b};
  if (d.leg_ratio < inf) {
    const double least = (1.0 / (Range(d.leg_ratio) * root(1.0 + square(Range(flat.b) / eta)))).a;
    t = meet(t, {least, (1.0 - Range(least)).b});
  }
  const auto over = [&](Range radius, Range part) {
    const double low = part.b > 0.0 ? (Range(radius.a) / U.b / part.b).a : 0.0;
    return meet(flat, {low, part.a > 0.0 ? (Range(radius.b) / U.a / part.a).b : inf});
  };
  d.box[5] = over(d.R_internal, t);
  d.box[6] = over(d.U_internal, meet(1.0 - t, {0.0, 1.0}));
  d.box[3] = meet(1.0 + t, {1.0, 2.0});
}

}  // namespace

Domain domain_of(const Certificate& c) {
  const bool hexagonal = c.family == "hexagonal";
  if (!hexagonal && c.family != "symmetric") refuse("the family is neither hexagonal nor symmetric");
  sets::require_variables(c.family, c.variables);
  if (!(c.target > 1.0) || !(c.target < inf)) refuse("the target is not a finite number above 1");
  if (c.length_kind.empty() && (!(c.length.a > 0.0) || !(c.length.b < inf) || !c.length.sound()))
    refuse("the characteristic length is not positive and finite");
  for (const std::vector<Bound>& bounds : {c.variables, c.limits})
    for (const auto& [name, range, of] : bounds)
      if (!of.empty()) refuse(name + " has a unit");
      else if (!ordinary(range.a) || !ordinary(range.b)) refuse("a bound of " + name + " is not from 1e-100 to 1e100");
  if (!ordinary(c.target) || !ordinary(c.length.a) || !ordinary(c.length.b))
    refuse("the target or the length is not from 1e-100 to 1e100");
  Domain d;
  d.target = c.target;
  Range angle;
  const auto variable = [&](std::size_t k) { return c.variables[k].range; };
  const double unit = unit_of(c, variable(hexagonal ? 4 : 7).a, d);
  const auto size_of = [&](Range x) { return meet(x / unit, {0.0, inf}); };
  const auto positive = [&](std::size_t k) {
    if (!(variable(k).a >= 0.0) || !(variable(k).b > 0.0) || !(variable(k).b < inf))
      refuse("the bounds of " + c.variables[k].name + " are not positive and finite");
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
    d.slopes = !(d.R_internal.a > 0.0 && d.U_internal.a > 0.0);
    angle = variable(4);
    d.zp = positive(7);
    d.zs = variable(8);
  }
  if (!(d.zs.a >= 0.0)) refuse("the bounds of zs are negative");
  d.zs = size_of(d.zs);
  for (const Bound& limit : c.limits)
    if (!d.take(limit)) refuse("the proof knows no limit " + limit.name);

  if (!(d.zp.a > 0.0)) d.zp.a = least_height(d);
  // Below the target: R U sin(theta) / l_c >= zp / target, and 1/q and y/t at most target * sqrt(N).
  const Range area = Range(d.zp.a) / d.target;
  Range U = d.U, R = d.R;
  if (d.scale.a > 0.0) {
    U = meet(U, {(area / R.b).a, inf});
    R = meet(R, {(area / U.b).a, inf});
  } else {
    bound_radii(d, R, U);
  }
  d.box[6] = hexagonal ? Range(1.0) : d.U_internal / U;
  d.box[1] = R / U;
  if (d.radius_ratio.b < inf) d.box[1].b = std::min(d.box[1].b, (d.radius_ratio * std::max(1.0, d.box[6].b)).b);
  if (hexagonal) d.box[1].a = std::max(d.box[1].a, d.radius_ratio.a);
  d.box[5] = hexagonal ? d.box[1] : d.R_internal / U;
  d.box[2] = d.zp / U;
  d.box[0] = U;
  if (d.scale.b > 1.0) {
    const Range slant = (Range(R.b) + U.b) / d.zp.a;  // zp / l_c is at most target * sqrt(N)
    const double most = (d.target * root(1.0 + square(slant))).b;
    d.box[0] = {std::max((Range(U.a) / d.scale.b).a, (area / R.b).a), d.scale.a > 0.0 ? std::min(U.b, most) : most};
  }
  const double sine = (area / (Range(R.b) * d.box[0].b)).a;
  // Where the least sine is lost in rounding, nothing is known of the angle.
  d.box[4] = meet(half_tangent(angle), sine > 0.0 ? Range{0.5 * sine, (2.0 / Range(sine)).b} : Range{0.0, inf});
  const Range room = Range(d.target) * root(square(1.0 + Range(d.box[1].b)) + square(d.box[2].b));
  Range t = meet(d.fraction, d.zs / d.zp);
  t = meet(t, {(d.box[5].a / room).a, (1.0 - d.box[6].a / room).b});
  if (d.slopes) take_slopes(d, U, room, t);
  else d.box[3] = {(Range(t.a) / (1.0 - Range(t.a))).a, (Range(t.b) / (1.0 - Range(t.b))).b};
  return d;
}

Range share(const Domain& d, const Box& b) {
  return d.slopes ? meet(b[3] - 1.0, {0.0, 1.0}) : 1.0 / (1.0 + 1.0 / b[3]);
}

bool empty(const Box& box) {
  for (const Range& r : box)
    if (r.a > r.b) return true;
  return false;
}

bool outside(const Domain& d, const Box& b) {
  if (b[0].a > b[0].b) return true;
  const Range t = share(d, b), y = d.slopes ? b[5] * t : b[5];
  const Range z = d.slopes ? b[6] * meet(2.0 - b[3], {0.0, 1.0}) : b[6];
  if (disjoint(t, d.fraction)) return true;
  const std::pair<Range, Range> sizes[] = {
      {b[1], d.R}, {b[2], d.zp}, {b[2] * t, d.zs}, {y, d.R_internal}, {z, d.U_internal}};
  const int count = d.dimension == 5 ? 3 : 5;
  Range U = d.scale.b > 1.0 ? d.U : b[0];  // of a free l_c, what the bounds leave of it
  for (const auto& [part, bounds] : std::span(sizes, static_cast<std::size_t>(count))) {
    if (disjoint(U * part, bounds)) return true;
    if (d.scale.b > 1.0 && part.a > 0.0) U = meet(U, bounds / part);
    if (U.a > U.b) return true;
  }
  if (d.scale.b > 1.0 && disjoint(U / b[0], d.scale)) return true;
  if (d.dimension == 5) return false;
  const Range base{std::max(b[1].a, y.a), std::max(b[1].b, y.b)};
  return disjoint(base / Range(std::max(1.0, z.a), std::max(1.0, z.b)), d.radius_ratio);
}

Box narrowed(const Domain& d, Box b) {
  const bool seven = d.dimension == 7, scaled = d.scale.b > 1.0;
  for (int turn = 0; turn < 2; ++turn) {
    Range U = scaled ? meet(d.U, b[0] * d.scale) : b[0];
    const auto product = [&](Range& x, Range bounds) {  // U x is within the bounds
      x = meet(x, bounds / U);
      if (x.sound()) U = meet(U, bounds / x);
      if (!U.sound()) b[0] = {1.0, 0.0};
      return x.sound() && U.sound();
    };
    if (!product(b[1], d.R) || !product(b[2], d.zp)) return b;
    if (seven && !d.slopes && (!product(b[5], d.R_internal) || !product(b[6], d.U_internal))) return b;
    const Range t = meet(meet(share(d, b), d.fraction), d.zs / (U * b[2]));
    if (!t.sound()) {
      b[0] = {1.0, 0.0};
      return b;
    }
    if (!product(b[2], d.zs / t)) return b;
    const double most = t.b < 1.0 ? (Range(t.b) / (1.0 - Range(t.b))).b : inf;
    b[3] = meet(b[3], d.slopes ? 1.0 + t : Range((Range(std::max(t.a, 0.0)) / (1.0 - Range(t.a))).a, most));
    b[0] = scaled ? meet(b[0], U / d.scale) : U;
    if (!b[3].sound() || !b[0].sound()) return b;
  }
  if (!seven) b[5] = b[1];
  return b;
}

}  // namespace ninedof::checker
