#include "proof/optimum/box_bound.hpp"

namespace ninedof::proof {

double middle_of(const Box& box, std::size_t k) {
  return std::clamp(std::sqrt(box[k].lo) * std::sqrt(box[k].hi), box[k].lo, box[k].hi);
}

namespace {

bool legs_too_different(const AxisPieces<Interval>& p, double log_leg_ratio) {
  if (log_leg_ratio == infinity) return false;
  const double most = std::max({p.external2.lo, p.upper2.lo, p.lower2.lo});
  const double least = std::min({p.external2.hi, p.upper2.hi, p.lower2.hi});
  return (0.5 * log(Interval(most) / least)).lo > log_leg_ratio;
}

/// Of the sizes those limits that designs of the box break and others keep, with their rows.
RowLimits limits_in(const Box& box, const Box& point, const Chart& chart, const RowLimits& all, Values& at_middle,
                    std::array<Slopes, rows>& slopes) {
  constexpr double wide = 4.0;  // of wider boxes the slopes say too little for any weight
  RowLimits out;
  out.log_leg_ratio = all.log_leg_ratio;
  const Sizes whole = axis_sizes(box, chart);
  for (std::size_t i = 0; i < sizes_of(chart); ++i) {
    const Interval size = box[at_size] * whole[i], &bounds = all.size[i];
    if ((bounds.lo <= size.lo && size.hi <= bounds.hi) || size.hi > wide * size.lo) continue;
    const std::size_t row = first_size + i;
    const Slopes slope = axis_size_slopes(box, chart, row);
    if (!std::isfinite(magnitude(slope[at_share]))) continue;
    slopes[row] = slope;
    at_middle[row] = log(point[at_size] * axis_sizes(point, chart)[i]);
    if (size.lo < bounds.lo) out.size[i].lo = bounds.lo;
    if (size.hi > bounds.hi) out.size[i].hi = bounds.hi;
  }
  return out;
}

}  // namespace

Box middle_of(const Box& box, const Chart& chart) {
  Box point = box;
  for (std::size_t k = 0; k < coordinates; ++k) point[k] = middle_of(box, k);
  if (chart.length) point[at_size] = size_of(point, chart);
  return point;
}

BoxBound bound_box(const Box& box, const Chart& chart, double target, const RowLimits& limits) {
  BoxBound out;
  const std::size_t dimension = chart.dimension;
  const AxisPieces<Interval> pieces = axis_pieces(box, chart);
  out.condition_number = legs_too_different(pieces, limits.log_leg_ratio) ? infinity : natural_bound(pieces);
  if (out.condition_number >= target) return out;

  const Box point = middle_of(box, chart);
  Radii radius{};
  for (std::size_t k = 0; k < coordinates; ++k) {
    const double m = point[k].lo;
    radius[k] = std::max(log(Interval(box[k].hi) / m).hi, log(m / Interval(box[k].lo)).hi);
  }
  Box whole = box;
  if (chart.length) {  // it moves with the others, and so do the slopes, also where the domain has no design
    radius[at_size] = 0.0;
    whole[at_size] = size_of(box, chart);
  }
  Values at_middle = axis_values(axis_pieces(point, chart));
  const double greatest = std::max(at_middle[axial_max].hi, at_middle[transverse_max].hi);
  const double least = std::min(at_middle[axial_min].lo, at_middle[transverse_min].lo);
  out.at_middle = exp(Interval(greatest) - least).hi;
  std::array<Slopes, rows> slopes = axis_slopes(whole, chart.length ? axis_pieces(whole, chart) : pieces, chart);

  // The coordinate whose change matters most to the singular values. Slopes are fractions: a larger one comes from a
  // denominator that is not known yet, and says nothing.
  constexpr double sensible = 4.0;
  double most = -1.0;
  bool finite = true;
  const std::size_t used = limits.log_leg_ratio == infinity ? external_leg : first_size;
  for (std::size_t k = 0; k < dimension; ++k) {
    double slope = 0.0;
    for (std::size_t i = 0; i < used; ++i) {
      finite = finite && std::isfinite(slopes[i][k].lo) && std::isfinite(slopes[i][k].hi);
      slope = std::max(slope, magnitude(slopes[i][k]));
    }
    const double change = std::min(slope, sensible) * radius[k];
    if (change > most) most = change, out.cut = k;
  }
  if (!finite) return out;

  const RowLimits held = limits_in(box, point, chart, limits, at_middle, slopes);
  const Combination best = best_combination(at_middle, slopes, radius, dimension, held);
  const double bound = exp(combined(best, at_middle, slopes, radius, dimension, held)).lo;
  if (bound > out.condition_number) {
    out.condition_number = bound;
    out.reason = Reason::combination;
    out.combination = best;
  }
  return out;
}

}  // namespace ninedof::proof
