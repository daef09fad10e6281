#include "proof/checker/blocks.hpp"

#include "proof/checker/curves.hpp"

namespace ninedof::checker {
namespace {

template <std::size_t n>
struct Block {
  Positive<n> g2, f2, w2;
};
template <std::size_t n>
struct Pieces {
  Block<n> axial, transverse;
  Positive<n> external2, upper2, lower2;
  Range size;  ///< U / l_c
};

template <std::size_t n>
Positive<n> coordinate(const Box& b, std::size_t k) {
  Positive<n> out{b[k], {}};
  if (k < n) out.log_slope[k] = 1.0;
  return out;
}

/// sin^2 theta = 4 / (tau + 1/tau)^2 grows up to tau = 1 and falls from there.
Range sine_squared(Range tau) {
  const auto at = [](Range t) { return square(2.0 / (t + 1.0 / t)); };
  const Range a = at(tau.a), b = at(tau.b);
  const double most = tau.a <= 1.0 && 1.0 <= tau.b ? 1.0 : std::max(a.b, b.b);
  return {std::min(a.a, b.a), std::min(most, 1.0)};
}

/// sigma_max of [[g, f], [0, w]].
Range greatest(double g, double f2, double w) {
  return (root(square(Range(g) + w) + f2) + root(square(Range(g) - w) + f2)) / 2.0;
}

struct Values {
  Range max, min;
};
template <std::size_t n>
Values values(const Block<n>& b) {
  const Range g = root(b.g2.value), f2 = meet(b.f2.value, {0.0, inf}), w = root(b.w2.value);
  return {{greatest(g.a, f2.a, w.a).a, greatest(g.b, f2.b, w.b).b},
          {(Range(g.a) * w.a / greatest(g.a, f2.b, w.a)).a, (Range(g.b) * w.b / greatest(g.b, f2.a, w.b)).b}};
}

/// Slopes of the logarithms of sigma_max and sigma_min, which weigh those of g, f and w.
template <std::size_t n>
void slopes(const Block<n>& b, Range max[], Range min[]) {
  const Range g = root(b.g2.value), w = root(b.w2.value), f2 = meet(b.f2.value, {0.0, inf});
  const Range unit{0.0, 1.0};
  // p = f^2 / (A B) and d = (g^2 - w^2) / (A B) at the corners where they are least and greatest.
  const Range sum2 = square(g + w), difference2 = square(g - w);
  const auto share = [](double f, double s, double t) {
    return f > 0.0 ? 1.0 / root((1.0 + Range(s) / f) * (1.0 + Range(t) / f)) : Range(0.0);
  };
  const Range p = meet({share(f2.a, sum2.b, difference2.b).a, share(f2.b, sum2.a, difference2.a).b}, unit);
  const auto balance = [&](double x, double y) {
    const Range s = Range(x) + y, t = Range(x) - y;
    const auto at = [&](double f) { return s * t / (root(square(s) + f) * root(square(t) + f)); };
    return cover(at(f2.a), at(f2.b));
  };
  const Range d = meet({balance(g.a, w.b).a, balance(g.b, w.a).b}, {-1.0, 1.0});
  const Range up_g = meet((1.0 - p + d) / 2.0, unit), up_w = meet((1.0 - p - d) / 2.0, unit);
  const Range low_g = meet((1.0 + p - d) / 2.0, unit), low_w = meet((1.0 + p + d) / 2.0, unit);
  for (std::size_t k = 0; k < n; ++k) {
    const Range log_g = b.g2.log_slope[k] / 2.0, log_w = b.w2.log_slope[k] / 2.0, log_f = b.f2.log_slope[k] / 2.0;
    max[k] = up_g * log_g + up_w * log_w + p * log_f;
    min[k] = low_g * log_g + low_w * log_w - p * log_f;
  }
}

/// a^2 + 2 a b c + b^2 = (a + b c)^2 + b^2 s^2 for c = cosine, s^2 = 1 - c^2: the first has the narrower slopes, the
/// second the narrower value.
template <std::size_t n>
Positive<n> third_side(const Positive<n>& a, const Positive<n>& b, const Signed<n>& cosine, const Positive<n>& sine2) {
  Positive<n> out{square(a.value + b.value * cosine.value) + square(b.value) * sine2.value, {}};
  if constexpr (n > 0) {
    const Signed<n> sum = plain(squared(a)) + cosine * (2.0 * (a * b)) + plain(squared(b));
    for (std::size_t k = 0; k < n; ++k) out.log_slope[k] = sum.slope[k] / out.value;
  }
  return out;
}

template <std::size_t n>
Positive<n> positive(const Signed<n>& x) {
  Positive<n> out{x.value, {}};
  for (std::size_t k = 0; k < n; ++k) out.log_slope[k] = x.slope[k] / x.value;
  return out;
}

/// U / l_c where the other coordinates decide it; z is U_internal / U.
template <std::size_t n>
Positive<n> size_by(const Domain& d, const Pieces<n>& p, const Positive<n>& z, const Signed<n>& internal_legs,
                    const Positive<n>& shift, const Positive<n>& turn) {
  if (d.length == Length::mean_leg) return 3.0 * inverse(internal_legs + root(p.external2));
  if (d.length == Length::natural) return root(shift * inverse(turn));
  Positive<n> out{1.0 / Range(std::max(1.0, z.value.a), std::max(1.0, z.value.b)), {}};
  if (z.value.b >= 1.0)
    for (std::size_t k = 0; k < n; ++k) out.log_slope[k] = -(Range(z.value.a > 1.0 ? 1.0 : 0.0, 1.0) * z.log_slope[k]);
  return out;
}

/// The two blocks of M and the squares of the leg lengths over a box, with their slopes along the first n coordinates.
template <std::size_t n>
Pieces<n> pieces(const Box& b, const Domain& d) {
  using Number = Positive<n>;
  const bool hexagonal = d.dimension == 5;
  const Number x = coordinate<n>(b, 1), eta = coordinate<n>(b, 2), o = coordinate<n>(b, 3);
  const Number tau = coordinate<n>(b, 4), y = hexagonal ? x : coordinate<n>(b, 5);
  const Number z = hexagonal ? Number{1.0, {}} : coordinate<n>(b, 6), eta2 = squared(eta);
  const Number z2 = hexagonal ? z : squared(z);
  const Number versed = 2.0 * inverse(plus(1.0, inverse(squared(tau))));  // 1 - cos theta
  const Signed<n> cosine = plus(1.0, -plain(versed));
  Number sine2{sine_squared(tau.value), {}};
  if constexpr (n > 4) sine2.log_slope[4] = 2.0 * cosine.value;
  const Signed<n> plan2 = squared(plus(-1.0, plain(x))) + plain(2.0 * (x * versed));
  const Number N = plan2 + eta2;
  Pieces<n> p;
  p.external2 = N;

  Signed<n> part, rest;  // t and q, where they may vanish
  Number q, t, up2, Z, Y;
  if (d.slopes) {
    part = plus(-1.0, plain(o)), rest = plus(2.0, -plain(o));
    part.value = meet(part.value, {0.0, 1.0}), rest.value = meet(rest.value, {0.0, 1.0});
    Z = z2 * inverse(eta2), Y = squared(y) * inverse(eta2);
    p.upper2 = positive(squared(rest) * (z2 + eta2));
    p.lower2 = positive(squared(part) * (squared(y) + eta2));
  } else {
    q = inverse(plus(1.0, o)), t = inverse(plus(1.0, inverse(o)));
    up2 = squared(q * eta);
    const Number low2 = squared(t * eta);
    Z = z2 * inverse(up2), Y = squared(y) * inverse(low2);
    p.upper2 = z2 + up2;
    p.lower2 = squared(y) + low2;
  }
  const Number axial = inverse(plus(2.0, Z + Y)), radial = inverse(plus(2.0, inverse(Z) + inverse(Y)));

  Number U = coordinate<n>(b, 0);
  if (d.length != Length::free) {
    const Number flat2 = squared(x) * sine2, lever = up2 * radial;
    Number moment = (flat2 + eta2) * inverse(N);  // at most 1, as N = (1 - x c)^2 + x^2 s^2 + eta^2
    moment.value = 1.0 / (1.0 + square(1.0 - x.value * cosine.value) / (flat2.value + eta2.value));
    const Number turn = d.slopes ? squared(rest) * (eta2 * radial) + moment : lever + moment;
    const Signed<n> legs = d.slopes ? rest * root(z2 + eta2) + part * root(squared(y) + eta2)
                                    : plain(root(p.upper2)) + plain(root(p.lower2));
    U = size_by(d, p, d.slopes ? positive(rest * z) : z, legs, plus(1.0, axial + radial), turn);
    if (n == 0) U.value = meet(b[0], U.value);  // slopes are those of the whole way to a design, which may lie beyond
  }
  p.size = U.value;
  const Number U2 = squared(U);
  Number stretch2, arm2, lift;
  if (d.slopes) {
    const Number one{1.0, {}};
    stretch2 = squared(rest) * (eta2 * U2) + one;
    lift = rest * (eta2 * U2) + one;
    const Range qx = rest.value * x.value;
    arm2 = {square(part.value + qx * cosine.value) + square(qx) * sine2.value, {}};
    const Signed<n> sum = squared(part) + squared(rest) * squared(x) + part * rest * cosine * (2.0 * x);
    for (std::size_t k = 0; k < n; ++k) arm2.log_slope[k] = sum.slope[k] / arm2.value;
    up2.value = square(rest.value) * eta2.value;
  } else {
    stretch2 = plus(1.0, up2 * U2);
    lift = plus(1.0, q * (eta2 * U2));
    arm2 = third_side(t, q * x, cosine, sine2);
  }
  const Number slant2 = third_side(lift, x, -cosine, sine2);
  p.axial.g2 = 3.0 * (U2 * squared(x) * sine2 * inverse(N));
  p.axial.f2 = 3.0 * (eta2 * inverse(N));
  p.axial.w2 = 3.0 * axial;
  p.transverse.g2 = 1.5 * (arm2 * eta2 * U2 * inverse(N) * inverse(stretch2));
  p.transverse.f2 = 1.5 * (slant2 * inverse(N) * inverse(stretch2));
  p.transverse.w2 = 1.5 * (stretch2 * radial);
  p.axial.f2.value = 3.0 / (1.0 + plan2.value / eta2.value);  // each of eta, U and their like once: a narrower range
  p.axial.g2.value = 3.0 * U2.value * sine2.value /
                     (square(1.0 - cosine.value / x.value) + (sine2.value + eta2.value) / square(x.value));
  p.transverse.g2.value = 1.5 * (arm2.value / ((1.0 + plan2.value / eta2.value) * (1.0 / U2.value + up2.value)));
  return p;
}

/// The sizes that limits are about, in l_c, where U / l_c is a coordinate.
template <std::size_t n>
std::array<Positive<n>, 5> sizes(const Box& b, const Domain& d) {
  const Positive<n> U = coordinate<n>(b, 0), R = U * coordinate<n>(b, 1), zp = U * coordinate<n>(b, 2);
  const Positive<n> o = coordinate<n>(b, 3);
  if (d.dimension == 5) return {R, zp, zp * inverse(plus(1.0, inverse(o))), R, U};
  const Positive<n> lower = U * coordinate<n>(b, 5), upper = U * coordinate<n>(b, 6);
  if (!d.slopes) return {R, zp, zp * inverse(plus(1.0, inverse(o))), lower, upper};
  const Positive<n> t = positive(plus(-1.0, plain(o))), q = positive(plus(2.0, -plain(o)));
  return {R, zp, zp * t, lower * t, upper * q};
}

/// By the mean value theorem, along all n coordinates.
template <std::size_t n>
bool combined(const Box& box, const Domain& d, const Weights& by) {
  Box middle = box;
  std::array<double, n> reach{};
  for (std::size_t k = 0; k < n; ++k) {
    const double m = std::clamp(std::sqrt(box[k].a) * std::sqrt(box[k].b), box[k].a, box[k].b);
    middle[k] = m;
    reach[k] = std::max(logarithm(Range(box[k].b) / m).b, logarithm(m / Range(box[k].a)).b);
  }
  if (n == 5) middle[5] = middle[1];
  if (d.length != Length::free) {  // U moves with the others
    middle[0] = {0.0, inf};
    reach[0] = 0.0;
  }
  const Range a = double(by.max), b = double(by.min), e = double(by.limits[0]), u = double(by.limits[1]), l = -(e + u);
  const Pieces<0> at = pieces<0>(middle, d);
  const Pieces<n> p = pieces<n>(box, d);
  const Values axial = values(at.axial), transverse = values(at.transverse);
  Range sum = (1.0 - a) * logarithm(axial.max) + a * logarithm(transverse.max) - (1.0 - b) * logarithm(axial.min) -
              b * logarithm(transverse.min);
  const bool legs = by.limits[0] != 0.0F || by.limits[1] != 0.0F;
  if (legs) {
    const auto plus = [](Range x) { return Range(std::max(x.a, 0.0), std::max(x.b, 0.0)); };
    sum = sum +
          (e * logarithm(at.external2.value) + u * logarithm(at.upper2.value) + l * logarithm(at.lower2.value)) / 2.0 -
          (plus(e) + plus(u) + plus(l)) * logarithm(d.leg_ratio);
  }
  std::array<Range, n> by_sizes{};
  if (std::any_of(by.limits.begin() + 2, by.limits.end(), [](float w) { return w != 0.0F; })) {
    const auto there = sizes<0>(middle, d);
    const auto over = sizes<n>(box, d);
    for (std::size_t i = 2; i < by.limits.size(); ++i) {
      if (by.limits[i] == 0.0F) continue;
      const Range w = double(by.limits[i]);
      sum = sum + w * logarithm(there[i - 2].value / bound_of(d, i, by.limits[i]));
      for (std::size_t k = 0; k < n; ++k) by_sizes[k] = by_sizes[k] + w * over[i - 2].log_slope[k];
    }
  }
  Range axial_max[n], axial_min[n], transverse_max[n], transverse_min[n];
  slopes(p.axial, axial_max, axial_min);
  slopes(p.transverse, transverse_max, transverse_min);
  for (std::size_t k = 0; k < n; ++k) {
    Range slope = by_sizes[k] + (1.0 - a) * axial_max[k] + a * transverse_max[k] - (1.0 - b) * axial_min[k] -
                  b * transverse_min[k];
    if (legs)
      slope = slope + (e * p.external2.log_slope[k] + u * p.upper2.log_slope[k] + l * p.lower2.log_slope[k]) / 2.0;
    sum = sum - Range(0.0, (Range(size(slope)) * reach[k]).b);
  }
  return sum.a >= logarithm(d.target).b;
}

}  // namespace

void settle(Box& box, const Domain& d) {
  if (d.dimension == 5) box[5] = box[1];
  if (d.length == Length::free) return;
  box[0] = meet(box[0], pieces<0>(box, d).size);
}

bool by_ranges(const Box& box, const Domain& d) {
  const Pieces<0> p = pieces<0>(box, d);
  if (d.leg_ratio < inf) {
    const double most = std::max({p.external2.value.a, p.upper2.value.a, p.lower2.value.a});
    const double least = std::min({p.external2.value.b, p.upper2.value.b, p.lower2.value.b});
    if ((Range(most) / least).a > square(Range(d.leg_ratio)).b) return true;
  }
  const Range K = d.target;
  for (const Block<0>* b : {&p.axial, &p.transverse}) {
    // kappa + 1/kappa = g/w + w/g + f^2 / (g w)
    const Range g = root(b->g2.value), w = root(b->w2.value), r = g / w;
    const double nearest = r.a > 1.0 ? r.a : r.b < 1.0 ? r.b : 1.0;
    if (!(nearest > 0.0)) continue;
    const Range sum = Range(nearest) + 1.0 / Range(nearest) + Range(std::max(b->f2.value.a, 0.0)) / (Range(g.b) * w.b);
    if (sum.a >= (K + 1.0 / K).b) return true;
  }
  const Values a = values(p.axial), t = values(p.transverse);
  return (Range(a.max.a) / t.min.b).a >= d.target || (Range(t.max.a) / a.min.b).a >= d.target;
}

double bound_of(const Domain& d, std::size_t limit, float weight) {
  if (d.length != Length::free) return 0.0;
  const Range bounds = std::array{d.R, d.zp, d.zs, d.R_internal, d.U_internal}[limit - 2] / d.scale;
  return weight < 0.0F ? bounds.a : bounds.b < inf ? bounds.b : 0.0;
}

bool by_combination(const Box& box, const Domain& d, const Weights& by) {
  return d.dimension == 5 ? combined<5>(box, d, by) : combined<coordinates>(box, d, by);
}

}  // namespace ninedof::checker
