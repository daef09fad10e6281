#include "proof/checker/lines.hpp"

namespace ninedof::checker::lines {
namespace {

/// f(x) for f convex, or concave, on the range of x: along its chord, between the ends and the tangent at `touch`,
/// which only has to be near the one parallel to the chord, of the slope m.
template <class Value, class Slope, class Touch>
Linear along_chord(bool convex, const Linear& x, const Value& value, const Slope& slope, const Touch& touch) {
  const double low = lower_end(x), high = upper_end(x);
  if (!(low <= high) || !std::isfinite(high - low)) return unknown_number();
  const Range at_low = value(low), at_high = value(high);
  const double m = low < high ? (at_high.a - at_low.a) / (high - low) : 0.0;
  const double guess = touch(low, high, m), t = guess > low && guess < high ? guess : 0.5 * (low + high);
  const Range tilt = Range(-1.0, 1.0) * (slope(t) - m) * (Range(high) - low), at = value(t) - m * Range(t) + tilt;
  const Range a = at_low - m * Range(low), b = at_high - m * Range(high);
  const Range rest = convex ? Range(at.a, std::max(a.b, b.b)) : Range(std::min(a.a, b.a), at.b);
  if (!std::isfinite(m) || !std::isfinite(rest.b - rest.a)) return unknown_number();
  return m * x + Linear(0.5 * (rest.a + rest.b), up(0.5 * (rest.b - rest.a)) + 0x1p-50 * size(rest));
}
/// Of numbers that are not negative. Without a slope where x may be 0: the chord would leave the range of the root.
Linear root_of(const Linear& x) {
  if (lower_end(x) > 0.0)
    return along_chord(
        false, x, [](double v) { return root(v); }, [](double v) { return 0.5 / root(v); },
        [](double, double, double m) { return 0.25 / (m * m); });
  const double most = root(Range(upper_end(x))).b;
  return most < inf ? Linear(0.5 * most, 0.5 * most * grain::up) : unknown_number();
}
Linear reciprocal(const Linear& x) {
  if (!(lower_end(x) > 0.0)) return unknown_number();
  return along_chord(
      true, x, [](double v) { return Range(1.0) / v; }, [](double v) { return -1.0 / square(v); },
      [](double low, double high, double) { return std::sqrt(low * high); });
}
/// The tangent is found by Newton's method from above, where it converges.
Linear reciprocal_square(const Linear& x) {
  if (!(lower_end(x) > 0.0)) return unknown_number();
  return along_chord(
      true, x, [](double v) { return 1.0 / square(v); }, [](double v) { return -2.0 / (Range(v) * square(v)); },
      [](double, double high, double m) {
        double t = high;
        for (double next = t; (next = (2.0 * t - 2.0 / (m * t * t)) / 3.0) < t;) t = next;
        return t;
      });
}
/// Of angles from 0 to 90 degrees.
Linear cosine_of(const Linear& x) {
  return along_chord(
      false, x, [](double v) { return sine_cosine(v).cosine; }, [](double v) { return -sine_cosine(v).sine; },
      [](double, double, double m) { return angle_of(root(1.0 - square(m)), -m).a; });
}
Linear sine_of(const Linear& x) {
  return along_chord(
      false, x, [](double v) { return sine_cosine(v).sine; }, [](double v) { return sine_cosine(v).cosine; },
      [](double, double, double m) { return angle_of(m, root(1.0 - square(m))).a; });
}
/// x + max(0, d) for d = y - x, and max(0, d) - m d is from 0 to its value at an end for every m from 0 to 1.
Linear larger(const Linear& x, const Linear& y) {
  const Linear d = y - x;
  const double low = lower_end(d), high = upper_end(d);
  if (low >= 0.0) return y;
  if (high <= 0.0) return x;
  const double m = high / (high - low), most = std::max(((1.0 - Range(m)) * high).b, (Range(m) * -low).b);
  return m >= 0.0 && most < inf ? x + m * d + Linear(0.5 * most, 0.5 * most * grain::up) : unknown_number();
}
Linear square_of(const Linear& x) {
  return x * x;
}

/// A box in numbers that are linear over it.
struct Forms {
  explicit Forms(const Box& box) {
    for (std::size_t k = 0; k < coordinates; ++k) x[k] = along(box[k].a, box[k].b, k);
    c = cosine_of(x[epsilon]);
    s = sine_of(x[epsilon]);
  }
  std::array<Linear, coordinates> x;
  Linear c, s;
};

/// The entries of lemma 13.
std::array<Linear, 7> entries_of(const Forms& f) {
  const auto& x = f.x;
  const Linear along_z = reciprocal(2.0 + square_of(x[upper]) + square_of(x[lower]));
  const Linear across = reciprocal(2.0 + reciprocal_square(x[upper]) + reciprocal_square(x[lower]));
  const Linear dc = x[delta] * f.c, ds = x[delta] * f.s, lever = x[drop] * across, mixed = dc * f.s;
  return {3.0 * square_of(dc),
          3.0 * mixed,
          3.0 * (square_of(f.s) + along_z),
          1.5 * (square_of(x[eta]) + square_of(ds) + x[drop] * lever),
          -1.5 * mixed,
          1.5 * (lever - x[eta] * f.c),
          1.5 * (square_of(f.c) + across)};
}

/// Numbers that are not positive where the limits are kept.
std::vector<Linear> limits_of(const Study& s, const Forms& f, Sides sides) {
  const auto& x = f.x;
  std::vector<Linear> out;
  out.reserve(64);
  const auto most = [&](const Linear& value, double bound, const Linear& unit) {
    if (bound < inf) out.push_back(value - bound * unit);
  };
  const auto within = [&](const Linear& value, Range range, const Linear& unit) {
    if (range.a > -inf) out.push_back(range.a * unit - value);
    most(value, range.b, unit);
  };
  const Linear d2 = square_of(x[delta]);
  const std::array<Linear, 4> radius{root_of(d2 + square_of(x[x_a])), x[lower] * x[lower_up],
                                     root_of(d2 + square_of(x[x_b])), x[upper] * x[upper_up]};
  for (std::size_t k = 0; k < 4; ++k) within(radius[k], s.radius[k], 1.0);
  const Linear base = larger(radius[0], radius[1]), platform = larger(radius[2], radius[3]);
  within(base, {s.radius_ratio.a > 0.0 ? s.radius_ratio.a : -inf, s.radius_ratio.b}, platform);

  const Linear zs = x[zp] - x[drop];
  within(zs, s.zs, 1.0);
  within(zs, s.fraction, x[zp]);
  const Linear widest = larger(base, platform), tilted = f.c * widest;
  const std::array<Linear, 4> height{f.c * x[zp] + x[eta] + x[x_a] * f.s, zs - sides.lower * x[lower_up],
                                     x[eta] + x[x_b] * f.s, sides.upper * x[upper_up] - x[drop]};
  for (std::size_t k = 0; k < 4; ++k) {
    const Linear unit = k % 2 == 0 ? f.c : Linear(1.0);
    within(height[k], s.height[k], unit);
    for (const double way : {1.0, -1.0}) {
      most(way * height[k], s.joint_height, unit);
      most(way * height[k], s.joint_height_in_radius, k % 2 == 0 ? tilted : widest);
    }
  }
  // Of external legs times the cosine.
  const Linear between = x[x_b] - x[x_a], span = larger(between, -between);
  const Linear up_leg = x[upper_up] * root_of(1.0 + square_of(x[upper]));
  const Linear low_leg = x[lower_up] * root_of(1.0 + square_of(x[lower])), flat_zp = f.c * x[zp];
  const std::array<Linear, 3> leg{span, up_leg, low_leg};
  for (std::size_t k = 0; k < 3; ++k) {
    within(leg[k], s.length[k], k == 0 ? f.c : Linear(1.0));
    within(leg[k], s.length_in_zp[k], k == 0 ? flat_zp : x[zp]);
  }
  for (const Linear& internal : {f.c * up_leg, f.c * low_leg}) {
    most(span, s.leg_ratio, internal);
    most(internal, s.leg_ratio, span);
  }
  most(up_leg, s.leg_ratio, low_leg);
  most(low_leg, s.leg_ratio, up_leg);
  return out;
}

/// Keeps the part of -1 .. 1 of each coordinate where a number may be at most 0. False where nothing is left.
bool keep(const Linear& g, Box& part) {
  const double least = lower_end(g);
  if (least > 0.0) return false;
  for (std::size_t k = 0; k < coordinates; ++k) {
    const double slope = std::abs(g.a[k]);
    if (!(slope > 0.0)) continue;
    const double far = (Range(-least) / slope - 1.0).b;  // least + slope (1 + t) <= 0, or 1 - t where it falls
    if (!(far < 1.0)) continue;
    if (g.a[k] > 0.0) part[k].b = std::min(part[k].b, far);
    else part[k].a = std::max(part[k].a, -far);
  }
  return !empty(part);
}

}  // namespace

bool narrow(const Study& study, Box& box, Sides sides, const Mixture* by) {
  const Forms forms(box);
  const std::vector<Linear> all = limits_of(study, forms, sides);
  Box part;
  part.fill({-1.0, 1.0});
  for (const Linear& g : all)
    if (!keep(g, part)) return false;
  if (by) {
    const std::array<Linear, 7> m = entries_of(forms);
    Linear sum;
    for (std::size_t k = 0; k < m.size(); ++k) sum = sum + by->entry[k] * m[k];
    for (const auto& [k, weight] : by->limits) {
      if (k >= all.size()) refuse("a weight of a limit that the study does not have");
      sum = sum + weight * all[k];
    }
    if (!keep(sum, part)) return false;
  }
  for (std::size_t k = 0; k < coordinates; ++k) {
    const Linear& x = forms.x[k];
    if (part[k].b < 1.0) box[k].b = std::min(box[k].b, (x.c + Range(x.a[k]) * part[k].b).b);
    if (part[k].a > -1.0) box[k].a = std::max(box[k].a, (x.c + Range(x.a[k]) * part[k].a).a);
  }
  return !empty(box);
}

}  // namespace ninedof::checker::lines
