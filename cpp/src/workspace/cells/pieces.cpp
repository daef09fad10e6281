/// Declared in workspace/cells/leaf.hpp.

#include <algorithm>
#include <numeric>

#include "math/sort_by.hpp"
#include "math/stop_at_times.hpp"
#include "workspace/cells/leaf.hpp"

namespace ninedof {
namespace {

/// Disjoint sets with path halving; the least member represents a set.
class Sets {
 public:
  explicit Sets(std::size_t count) : leader_(count) { std::iota(leader_.begin(), leader_.end(), std::size_t{0}); }
  std::size_t of(std::size_t n) {
    while (leader_[n] != n) n = leader_[n] = leader_[leader_[n]];
    return n;
  }
  void join(std::size_t a, std::size_t b) {
    a = of(a);
    b = of(b);
    leader_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<std::size_t> leader_;
};

std::uint64_t key_of(const Cell& c) {
  constexpr int bits = 20;  // a cell of the deepest level still fits: resolution <= 512
  return (std::uint64_t{c.level} << (3 * bits)) | (std::uint64_t{c.k} << (2 * bits)) | (std::uint64_t{c.j} << bits) |
         c.i;
}

/// Corners of a cell on its face: across axis `axis`, on the far side or the near one.
std::uint8_t face(int axis, bool far) {
  std::uint8_t out = 0;
  for (int n = 0; n < 8; ++n)
    if ((((n >> axis) & 1) != 0) == far) out = static_cast<std::uint8_t>(out | (1 << n));
  return out;
}

std::uint32_t& index(Cell& c, int axis) {
  return axis == 0 ? c.i : axis == 1 ? c.j : c.k;
}

void join_neighbours(const std::vector<Leaf>& leaves, int resolution, Sets& sets, const std::stop_token& stop) {
  KeyTable table;
  std::vector<std::size_t> leaf_of;
  for (std::size_t n = 0; n < leaves.size(); ++n) {
    stop_at_times(static_cast<long>(n), stop);
    if (leaves[n].inside == 0) continue;
    table.add(key_of(leaves[n].cell));
    leaf_of.push_back(n);
  }
  for (const std::size_t n : leaf_of) {
    stop_at_times(static_cast<long>(n), stop);
    for (int axis = 0; axis < 3; ++axis)
      for (const bool far : {false, true}) {
        if ((leaves[n].inside & face(axis, far)) == 0) continue;
        Cell next = leaves[n].cell;
        const std::uint32_t end = static_cast<std::uint32_t>(resolution) << next.level;
        if (index(next, axis) == (far ? end - 1 : 0)) continue;
        index(next, axis) += far ? 1 : ~std::uint32_t{0};
        // A neighbour of the same size, or a larger one; smaller ones find this cell from their side.
        for (;;) {
          const std::uint32_t found = table.find(key_of(next));
          if (found != KeyTable::absent) {
            sets.join(n, leaf_of[found]);
            break;
          }
          if (next.level == 0) break;
          next = {next.i / 2, next.j / 2, next.k / 2, static_cast<std::uint8_t>(next.level - 1)};
        }
      }
  }
}

bool holds(const Leaf& leaf, const Vec3& unit, int resolution) {
  const double n = resolution * static_cast<double>(1 << leaf.cell.level);
  const Vec3 at = unit * n - Vec3(leaf.cell.i, leaf.cell.j, leaf.cell.k);
  return leaf.inside != 0 && at.minCoeff() >= 0.0 && at.maxCoeff() <= 1.0;
}

}  // namespace

std::vector<double> find_pieces(std::vector<Leaf>& leaves, int resolution, const Chart& chart,
                                const std::optional<Vec3>& home, bool home_allowed, const std::stop_token& stop) {
  Sets sets(leaves.size());
  join_neighbours(leaves, resolution, sets, stop);
  std::vector<double> volume(leaves.size(), 0.0);
  std::vector<std::size_t> leaders;
  for (std::size_t n = 0; n < leaves.size(); ++n) {
    if (leaves[n].inside == 0) continue;
    volume[sets.of(n)] += leaves[n].fraction * leaves[n].measure;
    if (sets.of(n) == n) leaders.push_back(n);
  }
  sort_by(leaders, [&](std::size_t leader) { return -volume[leader]; });
  std::vector<double> out;
  if (home) {
    const Vec3 unit = (*home - chart.low()).cwiseQuotient(chart.high() - chart.low());
    const auto at =
        std::find_if(leaves.begin(), leaves.end(), [&](const Leaf& l) { return holds(l, unit, resolution); });
    if (!home_allowed || at == leaves.end()) {
      out.push_back(0.0);
    } else {
      const auto first = std::find(leaders.begin(), leaders.end(), sets.of(at_index(at - leaves.begin())));
      std::rotate(leaders.begin(), first, first + 1);
    }
  }
  std::vector<std::int32_t> number(leaves.size(), -1);
  for (const std::size_t n : leaders) {
    number[n] = static_cast<std::int32_t>(out.size());
    out.push_back(volume[n]);
  }
  for (std::size_t n = 0; n < leaves.size(); ++n) leaves[n].piece = leaves[n].inside == 0 ? -1 : number[sets.of(n)];
  return out;
}

}  // namespace ninedof
