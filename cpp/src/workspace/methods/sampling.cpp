#include "workspace/methods/sampling.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

#include "math/numbers.hpp"
#include "math/stop_at_times.hpp"
#include "ninedof/math/error.hpp"
#include "ninedof/math/parallel.hpp"
#include "workspace/cells/best_points.hpp"
#include "workspace/criteria/limits.hpp"
#include "workspace/measures/summary.hpp"
#include "workspace/sequence.hpp"

namespace ninedof {
namespace {

/// Evaluates points in order, calls take(number, point, margins) for each and reports progress between pieces of work.
/// No more than a piece is held: memory for all margins of ten million points would take seconds to get.
template <class PointAt, class Take>
void evaluate_all(const LimitsAtPoints& m, long count, const PointAt& point_at, int threads, const Control& control,
                  long before, long total, const BestPoints* mapped, const Take& take) {
  const long piece = 64 * m.block();
  std::vector<Vec3> x;
  std::vector<PointMargins> found;
  for (long done = 0; done < count; done += piece) {
    const long now = std::min(piece, count - done);
    x.clear();
    for (long n = 0; n < now; ++n) x.push_back(point_at(done + n));
    found.assign(at_index(now), {});
    parallel_for(now, m.block(), threads, [&](long from, long to) {
      const auto first = at_index(done + from);
      BestAt best;
      if (mapped)
        best = [&](long k, std::size_t r, const PlatformPose& pose) {
          return mapped->at(first + at_index(k), r, pose);
        };
      m.evaluate(&x[at_index(from)], to - from, &found[at_index(from)], control.stop, best);
    });
    for (long n = 0; n < now; ++n) take(at_index(done + n), x[at_index(n)], found[at_index(n)]);
    if (control.progress) control.progress(before + done + now, total, not_a_number);
  }
}

/// Writes what follows from the volume and the number of points, of which all or none are allowed if they are `alike`.
void finish(const LimitsAtPoints& m, long count, bool alike, int resolution, WorkspaceMap& map) {
  // Rule of three: the volume missed by points spread evenly over the box, an upper bound at 95 % confidence. It may be
  // allowed where all points are forbidden, and forbidden where all are allowed.
  map.unseen = 3.0 * m.chart().box_volume() / static_cast<double>(count);
  if (alike) map.error = std::max(map.error, map.unseen);
  map.evaluations = count;
  map.status = map.volume > 0.0 ? WorkspaceStatus::converged : WorkspaceStatus::empty;
  map.resolution = resolution;
}

Leaf point_leaf(const PointMargins& at, const LimitsAtPoints& m, double measure) {
  Leaf leaf;
  const bool allowed = at.allowed(m.groups());
  leaf.state = allowed ? CellState::inside : CellState::outside;
  leaf.inside = allowed ? 255 : 0;
  leaf.fraction = allowed ? 1.0 : 0.0;
  leaf.limit = static_cast<std::int16_t>(allowed ? -1 : m.violated(at));
  leaf.measure = measure;
  leaf.condition_number = at.condition_number;
  if (allowed && !std::isnan(at.condition_number)) {
    leaf.conditioning = leaf.conditioning_coarse = measure / at.condition_number;
    leaf.worst = at.condition_number;
  }
  return leaf;
}

}  // namespace

void map_by_grid(const LimitsAtPoints& m, const WorkspaceSettings& settings, bool first_piece_alone,
                 const Control& control, WorkspaceMap& map) {
  const int n = settings.resolution;
  if (static_cast<double>(n) * n * n > static_cast<double>(settings.most_evaluations))
    throw InvalidArgument(
        "resolution", std::to_string(n),
        "a grid of at most most_evaluations = " + std::to_string(settings.most_evaluations) + " cells");
  CellLattice lattice(m, n, settings.threads);
  const std::vector<Cell> cells = lattice.roots();
  std::vector<Vec3> x;
  for (const Cell& cell : cells) {
    stop_at_times(static_cast<long>(x.size()), control.stop);
    x.push_back(lattice.centre(cell));
  }
  const Vec3 size = lattice.size(0);
  BestPoints best(m);
  if (best.needed()) {
    std::vector<std::size_t> numbers(x.size());
    std::iota(numbers.begin(), numbers.end(), std::size_t{0});
    best.reserve(x.size());
    const auto side = at_index(n);
    best.map(x, {side, side, side}, numbers, settings.threads, control.stop);
    map.internal_points = best.audit();
  }
  std::vector<Leaf> leaves;
  evaluate_all(
      m, static_cast<long>(x.size()), [&](long c) { return x[at_index(c)]; }, settings.threads, control, 0,
      static_cast<long>(x.size()), best.needed() ? &best : nullptr,
      [&](std::size_t c, const Vec3& at, const PointMargins& known) {
        leaves.push_back(point_leaf(known, m, size.prod() * m.chart().density(at)));
        leaves.back().cell = cells[c];
      });
  map.pieces = find_pieces(leaves, n, m.chart(), first_piece_alone ? std::optional(m.home()) : std::nullopt,
                           map.home_allowed, control.stop);

  Surface surface;
  surface.area.assign(limit::count(), 0.0);
  double undecided = 0.0;
  map.volume = 0.0;
  const std::size_t stride[] = {1, at_index(n), at_index(n) * at_index(n)};
  for (std::size_t c = 0; c < leaves.size(); ++c) {
    stop_at_times(static_cast<long>(c), control.stop);
    Leaf& leaf = leaves[c];
    if (!leaf.counts(first_piece_alone)) continue;
    map.volume += leaf.measure;
    const std::uint32_t at[] = {leaf.cell.i, leaf.cell.j, leaf.cell.k};
    for (int axis = 0; axis < 3; ++axis)
      for (const int way : {-1, 1}) {
        const double area = size.prod() / size[axis];
        if (at[axis] == (way < 0 ? 0U : static_cast<std::uint32_t>(n - 1))) {
          if (axis >= m.chart().first_wall()) surface.area[limit::box()] += area;
          continue;
        }
        Leaf& other = leaves[way < 0 ? c - stride[axis] : c + stride[axis]];
        if (other.counts(first_piece_alone)) continue;
        if (leaf.state != CellState::boundary) undecided += leaf.measure * leaf.measure;
        leaf.state = CellState::boundary;
        if (other.limit >= 0) {
          surface.area[at_index(other.limit)] += area;
          leaf.limit = other.limit;
        }
        surface.points.push_back(lattice.centre(leaf.cell) + 0.5 * way * size[axis] * Vec3::Unit(axis));
      }
  }
  // The error of a cell on the boundary is uniformly distributed. Errors of neighbours are correlated along a smooth
  // boundary: four standard errors of independent ones are taken.
  map.error = 4.0 * std::sqrt(undecided / 12.0);
  finish(m, static_cast<long>(x.size()), undecided == 0.0, n, map);
  map.limit_area = surface.area;
  summarize(leaves, lattice, first_piece_alone, map, control.stop);
  if (n <= 128) inscribe(leaves, lattice, m, surface, first_piece_alone, control, map);
}

void map_by_sample(const LimitsAtPoints& m, const WorkspaceSettings& settings, const Control& control,
                   WorkspaceMap& map) {
  const Chart& chart = m.chart();
  const Vec3 side = chart.high() - chart.low();
  const double measure = chart.box_volume() / static_cast<double>(settings.points);
  std::vector<double> volume, index;
  std::vector<Leaf> leaves;
  std::vector<Vec3> where;
  const long total = settings.points * settings.shifts;
  for (int shift = 0; shift < settings.shifts; ++shift) {
    const Vec3 from = sequence_shift(settings.seed, static_cast<std::uint64_t>(shift));
    double held = 0.0, conditioning = 0.0;
    evaluate_all(
        m, settings.points, [&](long n) -> Vec3 { return chart.low() + sequence_point(n, from).cwiseProduct(side); },
        settings.threads, control, shift* settings.points, total, nullptr,
        [&](std::size_t, const Vec3& at, const PointMargins& known) {
          leaves.push_back(point_leaf(known, m, measure / settings.shifts * chart.density(at)));
          held += leaves.back().fraction * leaves.back().measure * settings.shifts;
          conditioning += leaves.back().conditioning * settings.shifts;
          where.push_back(at);
        });
    volume.push_back(held);
    index.push_back(conditioning);
  }
  const auto mean_and_error = [&](const std::vector<double>& values) {
    double mean = 0.0, square = 0.0;
    for (const double v : values) mean += v / settings.shifts;
    for (const double v : values) square += (v - mean) * (v - mean);
    return std::pair(mean, std::sqrt(square / (settings.shifts - 1.0) / settings.shifts));
  };
  std::tie(map.volume, map.error) = mean_and_error(volume);
  const bool alike = std::ranges::all_of(leaves, [&](const Leaf& leaf) { return leaf.state == leaves.front().state; });
  finish(m, total, alike, 0, map);
  const CellLattice lattice(m, settings.resolution, settings.threads);
  summarize(leaves, lattice, false, map, control.stop);
  map.cells.centre = where;
  double worst = 0.0;
  for (std::size_t n = 0; n < leaves.size(); ++n) {
    if (!(leaves[n].worst > worst)) continue;
    worst = leaves[n].worst;
    map.worst_at = where[n];
  }
  if (!(map.volume > 0.0)) return;
  std::vector<double> ratio;
  for (std::size_t k = 0; k < volume.size(); ++k)
    ratio.push_back((index[k] - map.conditioning_index * volume[k]) / map.volume);
  map.conditioning_index_error = mean_and_error(ratio).second;
}

}  // namespace ninedof
