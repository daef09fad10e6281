/// Declared in redundancy/search/multi_start.hpp.

#include <algorithm>

#include "math/sort_by.hpp"
#include "redundancy/search/multi_start.hpp"
#include "redundancy/search/scan.hpp"

namespace ninedof {
namespace {

constexpr int divisions = 4;           // of a cell
constexpr std::size_t most_valleys = 4;
constexpr double next_cells = 0.6;  // of the diagonal of a cell
constexpr int points_of_way = 8;

/// Descends from the lowest cell where that is better than the best minimum.
void descend_from_lowest(const PoseObjective& objective, const Scan& scan, Reach& reach, Minima& minima) {
  std::vector<const ScanCell*> lower;
  for (const ScanCell& cell : scan.cells())
    if (cell.value < minima.best() - least_gain) lower.push_back(&cell);
  sort_by(lower, &ScanCell::value);
  for (const ScanCell* cell : lower) {
    if (!(cell->value < minima.best() - least_gain)) return;
    if (objective.allows(cell->x) && reach.reaches(cell->x)) minima.add(minimum_from(objective, cell->x));
  }
}

/// Whether the criterion falls all along the straight way from a place to a minimum, within the limits.
bool falls_to(const PoseObjective& objective, const ScanCell& cell, const LocalMinimum& end) {
  double before = cell.value;
  for (int k = 1; k < points_of_way; ++k) {
    const Vec3 x = cell.x + k * (end.x - cell.x) / points_of_way;
    const double value = objective.violation(x) <= limit_tolerance ? objective.exact(x) : infinity;
    if (!(value < before)) return false;
    before = value;
  }
  return true;
}

}  // namespace

void add_valleys(const PoseObjective& objective, int n, Reach& reach, Minima& minima) {
  Scan scan(objective, n);
  for (int k = 0; k < divisions; ++k) {
    scan.divide(minima.best());
    descend_from_lowest(objective, scan, reach, minima);
    // The first cells of another chamber are left out.
    if (k == 0) scan.keep(minima.best(), [&](const Vec3& x) { return reach.reaches(x); });
  }
  minima.examined &= scan.complete();
  // What is narrower than the last cells.
  std::size_t tried = 0;
  for (const ScanCell& cell : scan.valleys(minima.best())) {
    const auto is_of = [&](const LocalMinimum& m) {
      return (m.x - cell.x).norm() < next_cells * scan.diagonal() || falls_to(objective, cell, m);
    };
    if (!cell.may_hold(minima.best()) || std::ranges::any_of(minima.found, is_of) || !reach.reaches(cell.x)) continue;
    if (tried++ == most_valleys) break;
    Vec3 x = cell.x;
    // Within the limits it may still be within the clearance.
    if (objective.allows(x) || (enter_limits(objective, x, minima) && objective.allows(x)))
      minima.add(minimum_from(objective, x));
  }
}

}  // namespace ninedof
