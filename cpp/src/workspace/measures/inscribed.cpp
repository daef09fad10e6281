/// Declared in workspace/measures/summary.hpp.

#include <algorithm>
#include <cmath>

#include "math/numbers.hpp"
#include "workspace/measures/body.hpp"
#include "workspace/measures/near_points.hpp"
#include "workspace/measures/summary.hpp"

namespace ninedof {
namespace {

constexpr int candidates = 6;  // cells from which the centre of the ball is optimised
constexpr std::size_t most_points = 12'000;  // of the surface that are used

/// Every n-th point: beyond some thousands the error is small, since it is quadratic in their distance.
std::vector<Vec3> thinned(const std::vector<Vec3>& points) {
  const std::size_t stride = points.size() / most_points + 1;
  std::vector<Vec3> out;
  for (std::size_t n = 0; n < points.size(); n += stride) out.push_back(points[n]);
  return out;
}

/// Distance from the surface and from the faces of the chart.
class FreeDistance {
 public:
  FreeDistance(const Chart& chart, const std::vector<Vec3>& surface)
      : chart_(chart), near_(chart.low(), chart.high(), surface) {}
  double at(const Vec3& x) const {
    double wall = infinity;
    for (int axis = chart_.first_wall(); axis < 3; ++axis)
      wall = std::min({wall, x[axis] - chart_.low()[axis], chart_.high()[axis] - x[axis]});
    return wall <= 0.0 ? wall : std::min(wall, near_.distance(x));
  }

 private:
  const Chart& chart_;
  NearPoints near_;
};

/// Moves the centre while the radius grows, in ever smaller steps. It stays in its ball and cannot cross the surface.
InscribedBall maximised(const FreeDistance& distance, InscribedBall ball, double step) {
  const double least = 1e-5 * step;
  step = std::min(step, 0.5 * ball.radius);
  for (; step > least; step *= 0.5)
    for (bool moved = true; moved;) {
      moved = false;
      for (int n = 0; n < 27; ++n) {
        const Vec3 way(n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1);
        const Vec3 there = ball.centre + step * way;
        const double radius = distance.at(there);
        if (radius <= ball.radius * (1.0 + 1e-12)) continue;
        ball = {there, radius};
        moved = true;
      }
    }
  return ball;
}

/// Least distance of x from the cells that are not inside.
double distance_from_others(const std::vector<Leaf>& leaves, const CellLattice& lattice, const Vec3& x) {
  double least = infinity;
  for (const Leaf& leaf : leaves) {
    if (leaf.state == CellState::inside) continue;
    const Vec3 away = (x - lattice.centre(leaf.cell)).cwiseAbs() - 0.5 * lattice.size(leaf.cell.level);
    least = std::min(least, away.cwiseMax(0.0).norm());
  }
  return least;
}

}  // namespace

void inscribe(const std::vector<Leaf>& leaves, const CellLattice& lattice, const LimitsAtPoints& margins,
              const Surface& surface, bool first_piece_alone, const Control& control, WorkspaceMap& map) {
  const std::vector<Vec3> points = thinned(surface.points);
  const FreeDistance distance(margins.chart(), points);
  int coarsest = CellLattice::deepest;
  for (const Leaf& leaf : leaves)
    if (leaf.inside == 255 && leaf.counts(first_piece_alone)) coarsest = std::min<int>(coarsest, leaf.cell.level);
  std::vector<std::pair<double, std::size_t>> found;
  for (std::size_t n = 0; n < leaves.size(); ++n) {
    const Leaf& leaf = leaves[n];
    if (leaf.inside != 255 || !leaf.counts(first_piece_alone) || leaf.cell.level > coarsest + 1)
      continue;  // small cells are near the boundary
    const double radius = distance.at(lattice.centre(leaf.cell));
    if (radius > 0.0) found.emplace_back(radius, n);
  }
  const std::size_t few = std::min<std::size_t>(candidates, found.size());
  std::partial_sort(
      found.begin(), found.begin() + static_cast<std::ptrdiff_t>(few), found.end(),
      [](const auto& a, const auto& b) { return a.first != b.first ? a.first > b.first : a.second < b.second; });
  for (std::size_t n = 0; n < few; ++n) {
    const Cell& cell = leaves[found[n].second].cell;
    const InscribedBall ball = maximised(distance, {lattice.centre(cell), found[n].first}, lattice.size(0).maxCoeff());
    if (ball.radius > map.ball.radius) map.ball = ball;
  }
  if (const auto box =
          largest_box(leaves, lattice, points, margins.chart(), first_piece_alone, map.resolution, margins.cheap()))
    map.box = *box;
  if (!margins.cheap()) {
    // Each pose would be a search: the ball is that of whole cells, as the box is.
    if (map.ball.radius > 0.0)
      map.ball.radius = std::min(map.ball.radius, distance_from_others(leaves, lattice, map.ball.centre));
  } else {
    if (map.ball.radius > 0.0)
      map.ball.radius *= allowed_scale({map.ball.centre, Vec3::Constant(map.ball.radius), false}, margins, control);
    if (!map.box.low.hasNaN()) {
      const Vec3 middle = 0.5 * (map.box.low + map.box.high);
      const Vec3 half = 0.5 * (map.box.high - map.box.low);
      const double scale = allowed_scale({middle, half, true}, margins, control);
      if (!(scale > 0.0)) map.box = {};
      else if (scale < 1.0) map.box = {middle - scale * half, middle + scale * half};
    }
  }
  if (!(map.ball.radius > 0.0)) map.ball = {};
}

}  // namespace ninedof
