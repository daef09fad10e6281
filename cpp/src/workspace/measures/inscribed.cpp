/// Declared in workspace/measures/summary.hpp.

#include <algorithm>
#include <cmath>

#include "math/numbers.hpp"
#include "workspace/measures/near_points.hpp"
#include "workspace/measures/summary.hpp"

namespace ninedof {
namespace {

constexpr int rays = 500;  // directions in which a ball is checked
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

/// The greatest scale from `low` to `high`, by bisection, at which all points that `sample` gives are allowed.
template <class Sample>
double fitting_scale(const Margins& margins, const Control& control, double low, double high, const Sample& sample) {
  const auto fits = [&](double scale) {
    const std::vector<Vec3> x = sample(scale);
    std::vector<PointMargins> out(x.size());
    margins.evaluate(x.data(), static_cast<long>(x.size()), out.data(), control.stop);
    return std::ranges::all_of(out, [&](const PointMargins& m) { return m.allowed(margins.groups()); });
  };
  if (fits(high)) return high;
  for (int k = 0; k < 12; ++k) (fits(0.5 * (low + high)) ? low : high) = 0.5 * (low + high);
  return low;
}

/// Evenly spread points of the unit sphere (Fibonacci lattice).
Vec3 ray(int n) {
  constexpr double golden = 2.399963229728653;
  const double z = 1.0 - (2.0 * n + 1.0) / rays, r = std::sqrt(1.0 - z * z);
  return {r * std::cos(golden * n), r * std::sin(golden * n), z};
}

/// Shrinks a ball until sampled points of its surface are allowed.
void shrink(InscribedBall& ball, const Margins& margins, const Control& control) {
  ball.radius = fitting_scale(margins, control, 0.9 * ball.radius, ball.radius, [&](double radius) {
    std::vector<Vec3> x;
    for (int n = 0; n < rays; ++n) x.push_back(ball.centre + radius * ray(n));
    return x;
  });
}

/// Shrinks a box until sampled points of its faces are allowed.
void shrink(InscribedBox& box, const Margins& margins, const Control& control) {
  constexpr int steps = 9;
  const Vec3 middle = 0.5 * (box.low + box.high), half = 0.5 * (box.high - box.low);
  const double scale = fitting_scale(margins, control, 0.9, 1.0, [&](double tried) {
    std::vector<Vec3> x;
    for (int axis = 0; axis < 3; ++axis)
      for (int n = 0; n < 2 * steps * steps; ++n) {
        Vec3 at;
        at[axis] = n % 2 == 0 ? -1.0 : 1.0;
        at[(axis + 1) % 3] = 2.0 * (n / 2 % steps) / (steps - 1) - 1.0;
        at[(axis + 2) % 3] = 2.0 * (n / 2 / steps) / (steps - 1) - 1.0;
        x.push_back(middle + tried * at.cwiseProduct(half));
      }
    return x;
  });
  if (scale < 1.0) box = {middle - scale * half, middle + scale * half};
}

}  // namespace

void inscribe(const std::vector<Leaf>& leaves, const CellLattice& lattice, const Margins& margins,
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
  if (const auto box = largest_box(leaves, lattice, points, margins.chart(), first_piece_alone, map.resolution))
    map.box = *box;
  if (!margins.cheap()) return;
  if (map.ball.radius > 0.0) shrink(map.ball, margins, control);
  if (!map.box.low.hasNaN()) shrink(map.box, margins, control);
}

}  // namespace ninedof
