#include "workspace/cells/leaf.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "workspace/cells/tetrahedra.hpp"
#include "workspace/criteria/limits.hpp"

namespace ninedof {
namespace {

// The curvature of a margin between the nine points is taken to be at most this times what they show.
constexpr double curvature_factor = 2.0;

/// Volume and conditioning from the corners and the centre. Trapezium and midpoint rule together are exact for cubics.
void integrate(const NinePoints& points, const CellLattice& lattice, const LimitsAtPoints& margins, Leaf& leaf) {
  const Chart& chart = margins.chart();
  const double volume = lattice.size(leaf.cell.level).prod();
  double corner_density = 0.0, corner_sum = 0.0, corner_weight = 0.0;
  const auto inverse = [](double kappa) { return std::isnan(kappa) ? 0.0 : 1.0 / kappa; };
  for (std::size_t n = 0; n < 9; ++n) {
    const PointMargins& at = lattice.margins(points[n]);
    const double density = chart.positional() ? 1.0 : chart.density(lattice.point(points[n]));
    const bool allowed = at.allowed(margins.groups());
    if (allowed && at.condition_number > leaf.worst) {
      leaf.worst = at.condition_number;
      leaf.worst_point = points[n];
    }
    if (n == 8) {
      leaf.measure = volume * (2.0 * density + corner_density) / 3.0;
      const double centre = allowed ? density * inverse(at.condition_number) : 0.0;
      const double mean = corner_weight > 0.0 ? corner_sum / corner_weight : centre / density;
      leaf.conditioning_coarse = leaf.fraction * leaf.measure * mean;
      leaf.conditioning = leaf.inside == 255 && allowed
                              ? volume * (2.0 * centre + corner_sum / 8.0) / 3.0 * leaf.fraction
                              : leaf.conditioning_coarse;
      break;
    }
    corner_density += 0.125 * density;
    if (!allowed) continue;
    corner_sum += density * inverse(at.condition_number);
    corner_weight += density;
  }
}

}  // namespace

Leaf leaf_of(const Cell& cell, const NinePoints& points, const CellLattice& lattice, const LimitsAtPoints& margins) {
  Leaf leaf;
  leaf.cell = cell;
  const int groups = margins.groups();
  Corners corners;
  for (std::size_t n = 0; n < 8; ++n) corners[n] = &lattice.margins(points[n]);
  const PointMargins& centre = lattice.margins(points[8]);
  CutCell cut(corners, groups);
  leaf.inside = static_cast<std::uint8_t>(cut.inside());
  leaf.fraction = cut.fraction();
  leaf.condition_number = centre.condition_number;

  // A group that has bounds is decided by them alone; any other by the nine points.
  const Proof proof = margins.bounds().over(lattice.centre(cell), 0.5 * lattice.size(cell.level));
  bool all_in = leaf.inside == 255, all_out = proof.outside;
  for (int g = 0; g < groups; ++g) {
    const auto k = at_index(g);
    if (margins.bounded(g)) {
      all_in = all_in && proof.inside;
      continue;
    }
    double least = centre.margin[k], most = least, mean = 0.0;
    for (const PointMargins* corner : corners) {
      least = std::min(least, corner->margin[k]);
      most = std::max(most, corner->margin[k]);
      mean += 0.125 * corner->margin[k];
    }
    const double curve = std::isfinite(mean) ? curvature_factor * std::abs(mean - centre.margin[k]) : 0.0;
    if (!(least >= curve)) all_in = false;
    if (most < -curve) all_out = true;
  }
  leaf.proved = proof.outside || ((all_in || all_out) && margins.all_bounded());
  if (proof.outside) {
    all_in = false;
    leaf.inside = 0;
    leaf.fraction = 0.0;
  }
  leaf.state = all_in ? CellState::inside : all_out ? CellState::outside : CellState::boundary;
  if (leaf.state == CellState::boundary && leaf.inside != 0 && leaf.inside != 255) {
    std::vector<CutCell::Piece> pieces;
    cut.boundary(Vec3::Ones(), pieces);
    std::vector<double> area(at_index(limit::count()));
    for (const CutCell::Piece& piece : pieces) area[at_index(piece.limit)] += piece.area;
    leaf.limit = static_cast<std::int16_t>(std::max_element(area.begin(), area.end()) - area.begin());
  } else if (leaf.state != CellState::inside) {
    leaf.limit = static_cast<std::int16_t>(margins.violated(centre));
  }
  integrate(points, lattice, margins, leaf);
  return leaf;
}

}  // namespace ninedof
