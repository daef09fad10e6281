/// Declared in workspace/measures/summary.hpp.

#include <algorithm>
#include <cmath>

#include "workspace/measures/summary.hpp"

namespace ninedof {
namespace {

constexpr int finest = 64;  // cells along each side of the raster; the time grows with its fourth power

/// A raster of cells of one size, with those that are entirely allowed.
class CellRaster {
 public:
  CellRaster(const std::vector<Leaf>& leaves, bool first_piece_alone, int resolution) {
    while ((resolution << (level_ + 1)) <= finest) ++level_;
    side_ = resolution << level_;
    std::vector<double> share(at_index(side_) * at_index(side_ * side_), 0.0);
    for (const Leaf& leaf : leaves) {
      if (leaf.inside != 255 || leaf.state != CellState::inside || (first_piece_alone && leaf.piece != 0)) continue;
      const int up = leaf.cell.level - level_;
      const int width = up < 0 ? 1 << -up : 1;
      const auto low = [&](std::uint32_t n) { return static_cast<int>(up < 0 ? n << -up : n >> up); };
      const double part = up > 0 ? std::ldexp(1.0, -3 * up) : 1.0;
      for (int k = low(leaf.cell.k); k < low(leaf.cell.k) + width; ++k)
        for (int j = low(leaf.cell.j); j < low(leaf.cell.j) + width; ++j)
          for (int i = low(leaf.cell.i); i < low(leaf.cell.i) + width; ++i) share[at(i, j, k)] += part;
    }
    for (const double s : share) full_.push_back(s == 1.0);
  }
  int side() const { return side_; }
  int level() const { return level_; }
  bool full(int i, int j, int k) const { return full_[at(i, j, k)] != 0; }

 private:
  std::size_t at(int i, int j, int k) const { return at_index((k * side_ + j) * side_ + i); }
  int level_ = 0, side_ = 0;
  std::vector<char> full_;
};

struct CellBox {
  int low[3], high[3];
  double volume = 0.0;
};

/// For each range of layers the largest rectangle of columns that are full in all of them (by the histogram method).
CellBox largest_of_cells(const CellRaster& r, const Vec3& size) {
  const int n = r.side();
  const auto width = at_index(n);
  CellBox best{};
  std::vector<char> column(width * width);
  std::vector<int> height(width + 1), open(width + 1);
  for (int k0 = 0; k0 < n; ++k0) {
    std::fill(column.begin(), column.end(), 1);
    for (int k1 = k0; k1 < n; ++k1) {
      std::fill(height.begin(), height.end(), 0);
      for (int j = 0; j < n; ++j) {
        std::size_t depth = 0;
        for (int i = 0; i <= n; ++i) {
          const auto x = at_index(i);
          if (i < n) {
            char& c = column[at_index(j) * width + x];
            c = c != 0 && r.full(i, j, k1);
            height[x] = c != 0 ? height[x] + 1 : 0;
          } else {
            height[x] = 0;
          }
          // `open` holds columns of rising height; a lower one ends the rectangles of the higher.
          while (depth > 0 && height[at_index(open[depth - 1])] >= height[x]) {
            const int tall = height[at_index(open[--depth])];
            const int from = depth == 0 ? 0 : open[depth - 1] + 1;
            const double volume = size.prod() * (i - from) * tall * (k1 - k0 + 1);
            if (tall > 0 && volume > best.volume) best = {{from, j - tall + 1, k0}, {i, j + 1, k1 + 1}, volume};
          }
          open[depth++] = i;
        }
      }
    }
  }
  return best;
}

/// Moves one face outwards until it meets the surface or a face of the chart.
void extend(InscribedBox& box, int axis, bool far, const std::vector<Vec3>& surface, const Chart& chart) {
  double reach = far ? chart.high()[axis] : chart.low()[axis];
  const int b = (axis + 1) % 3, c = (axis + 2) % 3;
  for (const Vec3& x : surface) {
    if (!(x[b] > box.low[b] && x[b] < box.high[b] && x[c] > box.low[c] && x[c] < box.high[c])) continue;
    if (far && x[axis] >= box.high[axis]) reach = std::min(reach, x[axis]);
    if (!far && x[axis] <= box.low[axis]) reach = std::max(reach, x[axis]);
  }
  (far ? box.high : box.low)[axis] = reach;
}

double volume(const InscribedBox& box) {
  return (box.high - box.low).prod();
}

/// Moves one face inwards and then all faces outwards, another one first, while the volume grows.
InscribedBox varied(InscribedBox box, const std::vector<Vec3>& surface, const Chart& chart) {
  for (int face = 0; face < 6; ++face) extend(box, face / 2, face % 2 != 0, surface, chart);
  const Vec3 start = box.high - box.low;
  for (double step = 0.125; step > 1e-3; step *= 0.5)
    for (bool moved = true; moved;) {
      moved = false;
      for (int trade = 0; trade < 36; ++trade) {
        const int give = trade / 6, first = trade % 6, axis = give / 2;
        if (first == give) continue;
        InscribedBox now = box;
        if (give % 2 != 0) now.high[axis] -= step * start[axis];
        else now.low[axis] += step * start[axis];
        if (now.high[axis] <= now.low[axis]) continue;
        for (int n = 0; n < 6; ++n) extend(now, (first + n) % 6 / 2, (first + n) % 2 != 0, surface, chart);
        if (volume(now) <= volume(box) * (1.0 + 1e-9)) continue;
        box = now;
        moved = true;
      }
    }
  return box;
}

}  // namespace

std::optional<InscribedBox> largest_box(const std::vector<Leaf>& leaves, const CellLattice& lattice,
                                        const std::vector<Vec3>& surface, const Chart& chart, bool first_piece_alone,
                                        int resolution, bool vary) {
  const CellRaster raster(leaves, first_piece_alone, resolution);
  const Vec3 size = lattice.size(raster.level());
  const CellBox cells = largest_of_cells(raster, size);
  if (!(cells.volume > 0.0)) return {};
  const auto corner = [&](const int (&n)[3]) -> Vec3 {
    return chart.low() + size.cwiseProduct(Vec3(n[0], n[1], n[2]));
  };
  const InscribedBox whole{corner(cells.low), corner(cells.high)};
  return vary ? varied(whole, surface, chart) : whole;
}

}  // namespace ninedof
