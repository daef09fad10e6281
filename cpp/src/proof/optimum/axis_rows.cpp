#include "proof/optimum/axis_rows.hpp"

namespace ninedof::proof {
namespace {

/// sigma_max from |g|, f^2 and |w|.
Interval greatest(double g, double f2, double w) {
  return 0.5 * (sqrt(square(Interval(g) + w) + f2) + sqrt(square(Interval(g) - w) + f2));
}

/// What is known to lie from 0 to 1.
Interval fraction(const Interval& x) {
  return {std::clamp(x.lo, 0.0, 1.0), std::clamp(x.hi, 0.0, 1.0)};
}

/// How the logarithms of the singular values follow those of g, f and w. With A, B = hypot(g +- w, f),
/// p = f^2 / (A B) and d = (g^2 - w^2) / (A B):
///   d log sigma_max = (1 - p + d)/2 d log g + (1 - p - d)/2 d log w + p d log f
///   d log sigma_min = (1 + p - d)/2 d log g + (1 + p + d)/2 d log w - p d log f
struct Weights {
  Interval max_g, max_w, min_g, min_w, f;
};

Weights weights(const Block<Interval>& b) {
  const Interval g = sqrt(b.g2), w = sqrt(b.w2);
  const Interval sum2 = square(g + w), difference2 = square(g - w);
  // p grows with f and falls as g + w or |g - w| grows.
  const auto share_of_f = [](double f2, double s2, double d2) {
    return f2 > 0.0 ? 1.0 / sqrt((1.0 + Interval(s2) / f2) * (1.0 + Interval(d2) / f2)) : Interval(0.0);
  };
  const Interval p =
      fraction({share_of_f(b.f2.lo, sum2.hi, difference2.hi).lo, share_of_f(b.f2.hi, sum2.lo, difference2.lo).hi});
  // d grows with g and falls with w; as f grows it moves towards 0.
  const auto balance = [](double g1, double w1, double f2) {
    const Interval s = Interval(g1) + w1, d = Interval(g1) - w1;
    return s * d / (sqrt(square(s) + f2) * sqrt(square(d) + f2));
  };
  const Interval d{std::max(std::min(balance(g.lo, w.hi, b.f2.lo).lo, balance(g.lo, w.hi, b.f2.hi).lo), -1.0),
                   std::min(std::max(balance(g.hi, w.lo, b.f2.lo).hi, balance(g.hi, w.lo, b.f2.hi).hi), 1.0)};
  return {fraction(0.5 * (1.0 - p + d)), fraction(0.5 * (1.0 - p - d)), fraction(0.5 * (1.0 + p - d)),
          fraction(0.5 * (1.0 + p + d)), p};
}

}  // namespace

Pair singular_values(const Block<Interval>& b) {
  const Interval g = sqrt(b.g2), w = sqrt(b.w2);
  const double least_max = greatest(g.lo, b.f2.lo, w.lo).lo, most_max = greatest(g.hi, b.f2.hi, w.hi).hi;
  // sigma_min = g w / sigma_max
  const Interval least_min = Interval(g.lo) * w.lo / greatest(g.lo, b.f2.hi, w.lo);
  const Interval most_min = Interval(g.hi) * w.hi / greatest(g.hi, b.f2.lo, w.hi);
  return {{std::max(least_max, 0.0), most_max}, {std::max(least_min.lo, 0.0), most_min.hi}};
}

double natural_bound(const AxisPieces<Interval>& p) {
  double bound = 1.0;
  for (const Block<Interval>& b : {p.axial, p.transverse}) {
    // kappa + 1/kappa = g/w + w/g + f^2/(g w)
    const Interval g = sqrt(b.g2), w = sqrt(b.w2), r = g / w;
    double sum = r.lo > 1.0   ? (Interval(r.lo) + 1.0 / Interval(r.lo)).lo
                 : r.hi < 1.0 ? (Interval(r.hi) + 1.0 / Interval(r.hi)).lo
                              : 2.0;
    sum = (sum + b.f2.lo / (Interval(g.hi) * w.hi)).lo;
    if (sum > 2.0) bound = std::max(bound, (0.5 * (sum + sqrt(square(Interval(sum)) - 4.0))).lo);
  }
  const Pair a = singular_values(p.axial), t = singular_values(p.transverse);
  return std::max({bound, (Interval(a.max.lo) / t.min.hi).lo, (Interval(t.max.lo) / a.min.hi).lo});
}

std::array<Interval, rows> axis_values(const AxisPieces<Interval>& p) {
  const Pair a = singular_values(p.axial), t = singular_values(p.transverse);
  return {log(a.max),          log(a.min),         log(t.max), log(t.min), 0.5 * log(p.external2),
          0.5 * log(p.upper2), 0.5 * log(p.lower2)};
}

Interval axis_share(const Box& b, const Chart& chart) {
  return chart.slopes ? not_negative(b[at_share] - 1.0) : 1.0 / (1.0 + 1.0 / b[at_share]);
}

Sizes axis_sizes(const Box& b, const Chart& chart) {
  const Interval t = axis_share(b, chart);
  const Interval lower = chart.slopes ? b[at_lower] * t : b[at_lower];
  const Interval upper = chart.slopes ? b[at_upper] * not_negative(2.0 - b[at_share]) : b[at_upper];
  return {b[at_ratio], b[at_height], b[at_height] * t, lower, upper};
}

Slopes axis_size_slopes(const Box& b, const Chart& chart, std::size_t row) {
  constexpr std::array<Coordinate, sizes> own{at_ratio, at_height, at_height, at_lower, at_upper};
  Slopes out{};
  out[at_size] = out[own[row - first_size]] = 1.0;
  const Interval& o = b[at_share];
  if (row == internal_size && !chart.slopes) out[at_share] = 1.0 / (1.0 + o);
  if (!chart.slopes) return out;
  if (row == internal_size || row == lower_size) out[at_share] = o / not_negative(o - 1.0);
  if (row == upper_size) out[at_share] = -(o / not_negative(2.0 - o));
  return out;
}

namespace {

/// Of log (U / l_c) along the others, where l_c is of a kind.
Slopes size_slopes(const Box& box, const AxisPieces<Interval>& p, const Chart& chart, const std::array<Slopes, 3>& legs,
                   const Slopes& axial, const Slopes& radial) {
  Slopes out{};
  const Interval drop = chart.slopes ? box[at_share] / p.q : p.t;  // of -log q along the coordinate of the share
  if (chart.length == LengthKind::platform_radius) {
    const Interval z2 = square(box[at_upper]) * (chart.slopes ? square(p.q) : Interval(1.0));
    const Interval counts{z2.lo > 1.0 ? 1.0 : 0.0, z2.hi >= 1.0 ? 1.0 : 0.0};
    out[at_upper] = -counts;
    if (chart.slopes) out[at_share] = counts * drop;
    return out;
  }
  if (chart.length == LengthKind::mean_leg) {
    const std::array<Interval, 3> length{sqrt(p.external2), sqrt(p.upper2), sqrt(p.lower2)};
    const Interval sum = length[0] + length[1] + length[2];
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t k = 0; k < coordinates; ++k) out[k] -= fraction(length[i] / sum) * legs[i][k];
    if (chart.slopes) {  // of q and t themselves, whose logarithms have no slope where they vanish
      const Interval eta2 = square(box[at_height]), upper = sqrt(square(box[at_upper]) + eta2);
      out[at_share] = box[at_share] * (upper - sqrt(square(box[at_lower]) + eta2)) / sum;
    }
    return out;
  }
  const Interval shift = 1.0 + p.axial_share + p.radial_share, flat2 = square(box[at_ratio]) * p.sine2;
  const Interval eta2 = square(box[at_height]), moment = (flat2 + eta2) / p.external2;
  const Interval lever = square(p.q) * eta2 * p.radial_share, turn = moment + lever;
  const Interval by_moment = fraction(moment / turn), by_lever = fraction(lever / turn);
  for (std::size_t k = 0; k < coordinates; ++k)
    out[k] =
        p.axial_share / shift * axial[k] + (p.radial_share / shift - by_lever) * radial[k] + by_moment * legs[0][k];
  const Interval flat = fraction(flat2 / (flat2 + eta2));
  out[at_ratio] -= by_moment * flat;
  out[at_angle] -= by_moment * flat * p.cosine;
  out[at_height] -= by_moment * fraction(1.0 - flat) + by_lever;
  out[at_share] += eta2 * p.radial_share / turn * p.q * (chart.slopes ? box[at_share] : p.q * p.t);
  return out;
}

}  // namespace

std::array<std::array<Interval, coordinates>, rows> axis_slopes(const Box& box, const AxisPieces<Interval>& p,
                                                                const Chart& chart) {
  const Interval &x = box[at_ratio], &c = p.cosine;
  // Halves of the slopes of log N, log S^2, log(upper vertical part)^2 and the like; all are fractions.
  const Interval n_x = x * (x - c) / p.external2, n_angle = x * p.sine2 / p.external2;
  const Interval n_eta = 1.0 / (1.0 + p.plan2 / square(box[at_height]));
  const Interval stretch = fraction(1.0 - 1.0 / (1.0 + p.lever2));

  Slopes axial_g{}, axial_f{}, axial_w{};
  axial_g[at_size] = 1.0;
  axial_g[at_ratio] = 1.0 - n_x;
  axial_g[at_height] = -n_eta;
  axial_g[at_angle] = c - n_angle;
  axial_f[at_ratio] = -n_x;
  axial_f[at_height] = fraction(1.0 - n_eta);
  axial_f[at_angle] = -n_angle;
  const Interval upper_w = fraction(p.upper_flat2 * p.axial_share), lower_w = fraction(p.lower_flat2 * p.axial_share);
  axial_w[at_height] = fraction(1.0 - 2.0 * p.axial_share);
  axial_w[at_share] = lower_w * p.q - upper_w * p.t;
  axial_w[at_lower] = -lower_w;
  axial_w[at_upper] = -upper_w;

  Slopes transverse_g{}, transverse_f{}, transverse_w{};
  const Interval qx = p.q * x;
  const Interval arm_x = qx * (qx + p.t * c) / p.arm2;  // half the slope of log h^2
  transverse_g[at_size] = 1.0 - stretch;
  transverse_g[at_ratio] = arm_x - n_x;
  transverse_g[at_height] = 1.0 - n_eta - stretch;
  transverse_g[at_share] = 1.0 - arm_x - p.t + stretch * p.t;
  transverse_g[at_angle] = -(p.t * qx * p.sine2 / p.arm2) - n_angle;
  const Interval lift = p.offset * (p.q * square(box[at_height] * box[at_size])) / p.slant2;
  transverse_f[at_size] = 2.0 * lift - stretch;
  transverse_f[at_ratio] = (square(x) * p.sine2 - p.offset * c * x) / p.slant2 - n_x;
  transverse_f[at_height] = 2.0 * lift - n_eta - stretch;
  transverse_f[at_share] = (stretch - lift) * p.t;
  transverse_f[at_angle] = (p.offset + x * c) * x * p.sine2 / p.slant2 - n_angle;
  const Interval upper_s = fraction(p.radial_share / p.upper_flat2), lower_s = fraction(p.radial_share / p.lower_flat2);
  transverse_w[at_size] = stretch;
  transverse_w[at_height] = stretch - fraction(1.0 - 2.0 * p.radial_share);
  transverse_w[at_share] = (upper_s - stretch) * p.t - lower_s * p.q;
  transverse_w[at_lower] = lower_s;
  transverse_w[at_upper] = upper_s;

  // Of an internal leg, the share of its length that is vertical.
  Slopes external{}, upper{}, lower{};
  external[at_ratio] = n_x;
  external[at_height] = n_eta;
  external[at_angle] = n_angle;
  const Interval upper_up = 1.0 / (1.0 + p.upper_flat2), lower_up = 1.0 / (1.0 + p.lower_flat2);
  upper[at_height] = upper_up;
  upper[at_share] = -(upper_up * p.t);
  upper[at_upper] = fraction(1.0 - upper_up);
  lower[at_height] = lower_up;
  lower[at_share] = lower_up * p.q;
  lower[at_lower] = fraction(1.0 - lower_up);

  Slopes radial = transverse_w;  // of W1 alone, without S
  radial[at_size] = 0.0;
  radial[at_height] = -fraction(1.0 - 2.0 * p.radial_share);
  radial[at_share] = upper_s * p.t - lower_s * p.q;
  if (chart.slopes) {
    const Interval &v = box[at_share], spin2 = square(box[at_height] * box[at_size]), level = 1.0 - x * c;
    const Interval stretch_t = -(p.q * spin2 / (1.0 + p.lever2));  // of log S along t
    transverse_g[at_share] = v * (((p.t + qx * c) * level - qx * x * p.sine2) / p.arm2 - stretch_t);
    transverse_f[at_share] = v * (-(p.offset * spin2 / p.slant2) - stretch_t);
    transverse_w[at_share] = v * stretch_t;
    axial_w[at_share] = radial[at_share] = 0.0;
    upper[at_share] = -(v / p.q);
    lower[at_share] = v / p.t;
  }
  if (chart.hexagonal())
    for (Slopes* s : {&axial_w, &transverse_w, &lower, &radial}) (*s)[at_ratio] += (*s)[at_lower];  // y = x

  std::array<Slopes, rows> out;
  const auto combine = [&](const Block<Interval>& b, const Slopes& g, const Slopes& f, const Slopes& w, Slopes& max,
                           Slopes& min) {
    const Weights by = weights(b);
    for (std::size_t k = 0; k < chart.dimension; ++k) {
      max[k] = by.max_g * g[k] + by.max_w * w[k] + by.f * f[k];
      min[k] = by.min_g * g[k] + by.min_w * w[k] - by.f * f[k];
    }
  };
  combine(p.axial, axial_g, axial_f, axial_w, out[axial_max], out[axial_min]);
  combine(p.transverse, transverse_g, transverse_f, transverse_w, out[transverse_max], out[transverse_min]);
  out[external_leg] = external;
  out[upper_leg] = upper;
  out[lower_leg] = lower;
  if (chart.length) {
    const Slopes size = size_slopes(box, p, chart, {external, upper, lower}, axial_w, radial);
    for (std::size_t i = 0; i < external_leg; ++i) {
      for (std::size_t k = at_ratio; k < chart.dimension; ++k) out[i][k] += out[i][at_size] * size[k];
      out[i][at_size] = 0.0;
    }
  }
  return out;
}

Interval size_of(const Box& box, const Chart& chart) {
  const AxisPieces<Interval> p = axis_pieces(box, chart);
  if (chart.length == LengthKind::platform_radius)
    return 1.0 / max(Interval(1.0), chart.slopes ? box[at_upper] * p.q : box[at_upper]);
  if (chart.length == LengthKind::mean_leg) return 3.0 / (sqrt(p.external2) + sqrt(p.upper2) + sqrt(p.lower2));
  const Interval eta2 = square(box[at_height]);
  const Interval turn = (square(box[at_ratio]) * p.sine2 + eta2) / p.external2 + square(p.q) * eta2 * p.radial_share;
  return sqrt((1.0 + p.axial_share + p.radial_share) / turn);
}

void settle(Box& box, const Chart& chart) {
  if (chart.hexagonal()) box[at_lower] = box[at_ratio];
  if (!chart.length) return;
  const Interval size = size_of(box, chart);
  box[at_size] = {std::max(box[at_size].lo, size.lo), std::min(box[at_size].hi, size.hi)};
}

}  // namespace ninedof::proof
