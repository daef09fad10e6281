#include "workspace/measures/summary.hpp"

#include <algorithm>
#include <cmath>

#include "math/numbers.hpp"
#include "math/stop_at_times.hpp"
#include "workspace/cells/tetrahedra.hpp"
#include "workspace/criteria/limits.hpp"

namespace ninedof {
namespace {

/// Allowed area of a leaf on the faces of the chart's box, by its corners there.
double face_area(const Leaf& leaf, const Vec3& size, int resolution, int first_axis) {
  const std::uint32_t end = (static_cast<std::uint32_t>(resolution) << leaf.cell.level) - 1;
  const std::uint32_t at[] = {leaf.cell.i, leaf.cell.j, leaf.cell.k};
  double sum = 0.0;
  for (int axis = first_axis; axis < 3; ++axis)
    for (const bool far : {false, true}) {
      if (at[axis] != (far ? end : 0)) continue;
      int corners = 0;
      for (int n = 0; n < 8; ++n)
        if ((((n >> axis) & 1) != 0) == far && ((leaf.inside >> n) & 1) != 0) ++corners;
      sum += 0.25 * corners * size.prod() / size[axis];
    }
  return sum;
}

/// Percentiles 0, 1, ..., 100 of values with weights; linear between the middles of the weights.
std::vector<double> percentiles(std::vector<std::pair<double, double>> values, const std::stop_token& stop) {
  std::vector<double> out(101, not_a_number);
  if (values.empty()) return out;
  long compared = 0;  // ten million values take seconds
  std::sort(values.begin(), values.end(), [&](const auto& a, const auto& b) {
    stop_at_times(++compared, stop);
    return a < b;
  });
  double total = 0.0;
  for (const auto& [value, weight] : values) total += weight;
  std::size_t n = 0;
  double before = 0.0;
  for (int percent = 0; percent <= 100; ++percent) {
    const double wanted = 0.01 * percent * total;
    while (n + 1 < values.size() && before + values[n].second + 0.5 * values[n + 1].second < wanted)
      before += values[n++].second;
    const double here = before + 0.5 * values[n].second;
    out[at_index(percent)] = values[n].first;
    if (n + 1 < values.size() && wanted > here) {
      const double next = before + values[n].second + 0.5 * values[n + 1].second;
      const double t = std::min(1.0, (wanted - here) / (next - here));
      out[at_index(percent)] = (1.0 - t) * values[n].first + t * values[n + 1].first;
    }
  }
  return out;
}

}  // namespace

Surface surface_of(const Octree& tree, CellLattice& lattice, const LimitsAtPoints& margins, bool first_piece_alone,
                   int resolution) {
  Surface out;
  out.area.assign(limit::count(), 0.0);
  std::vector<Cell> cut;
  for (const Leaf& leaf : tree.leaves) {
    if (!leaf.counts(first_piece_alone)) continue;
    if (leaf.inside != 255) cut.push_back(leaf.cell);
    const Chart& chart = margins.chart();
    // The ball of a rotation chart has its own margin; for tilt and torsion only the ends of the torsion are faces.
    out.area[limit::box()] += face_area(leaf, lattice.size(leaf.cell.level), resolution, chart.first_wall());
  }
  const std::vector<NinePoints> points = lattice.points_of(cut);
  std::vector<CutCell::Piece> pieces;
  std::vector<Vec3> crossings;
  for (std::size_t n = 0; n < cut.size(); ++n) {
    Corners corners;
    for (std::size_t k = 0; k < 8; ++k) corners[k] = &lattice.margins(points[n][k]);
    CutCell cell(corners, margins.groups());
    const Vec3 size = lattice.size(cut[n].level), low = lattice.centre(cut[n]) - 0.5 * size;
    pieces.clear();
    crossings.clear();
    cell.boundary(size, pieces);
    cell.crossings(crossings);
    for (const CutCell::Piece& piece : pieces) out.area[at_index(piece.limit)] += piece.area;
    for (const Vec3& at : crossings) out.points.push_back(low + at.cwiseProduct(size));
  }
  return out;
}

void summarize(const std::vector<Leaf>& leaves, const CellLattice& lattice, bool first_piece_alone, WorkspaceMap& map,
               const std::stop_token& stop) {
  std::vector<std::pair<double, double>> values;
  double held = 0.0, sum = 0.0, coarse = 0.0, worst = 0.0;
  WorkspaceCells& cells = map.cells;
  for (const Leaf& leaf : leaves) {
    stop_at_times(static_cast<long>(cells.centre.size()), stop);
    cells.centre.push_back(lattice.centre(leaf.cell));
    cells.level.push_back(leaf.cell.level);
    cells.state.push_back(leaf.state);
    cells.limit.push_back(leaf.limit);
    cells.fraction.push_back(leaf.fraction);
    cells.condition_number.push_back(leaf.condition_number);
    cells.piece.push_back(leaf.piece);
    const double weight = leaf.fraction * leaf.measure;
    if (!leaf.counts(first_piece_alone) || !(weight > 0.0)) continue;
    held += weight;
    sum += leaf.conditioning;
    coarse += leaf.conditioning_coarse;
    if (leaf.conditioning > 0.0) values.emplace_back(weight / leaf.conditioning, weight);
    if (leaf.worst > worst) {
      worst = leaf.worst;
      map.worst_at = leaf.worst_point == KeyTable::absent ? lattice.centre(leaf.cell) : lattice.point(leaf.worst_point);
    }
  }
  map.percentiles = percentiles(std::move(values), stop);
  if (!(held > 0.0)) return;
  map.conditioning_index = sum / held;
  map.conditioning_index_error = std::abs(sum - coarse) / held + map.error / held * map.conditioning_index;
  map.worst_condition_number = map.percentiles.back() = worst;
}

}  // namespace ninedof
