#include "workspace/certified/home_piece.hpp"

#include <algorithm>
#include <numeric>

namespace ninedof::certified {
namespace {

bool touch(const PositionBox& a, const PositionBox& b) {
  return (a.low.array() <= b.high.array()).all() && (b.low.array() <= a.high.array()).all();
}

/// Sets of leaves: the one of leaf n by following `up`.
class Joined {
 public:
  explicit Joined(std::size_t count) : up_(count) { std::iota(up_.begin(), up_.end(), 0); }
  int root(int n) {
    while (at(n) != n) n = at(n) = at(at(n));
    return n;
  }
  void join(int a, int b) { at(root(a)) = root(b); }

 private:
  int& at(int n) { return up_[static_cast<std::size_t>(n)]; }
  std::vector<int> up_;
};

/// Finds leaves that touch, none of them outer.
class Neighbours {
 public:
  explicit Neighbours(const Tree& tree) : tree_(tree), near(tree.size()), proved(tree.size()), some_(tree.size()) {
    for (std::size_t n = tree.size(); n-- > 0;) {  // halves come after what was halved
      const Node& node = tree[n];
      const auto half = static_cast<std::size_t>(node.first_half);
      some_[n] = node.leaf() ? !node.seen.outer() : some_[half] || some_[half + 1];
    }
    within(0);
  }

 private:
  const Tree& tree_;

 public:
  Joined near, proved;

 private:
  void within(int n) {
    // An explicit stack: a tree may be deeper than the stack of a thread.
    std::vector<std::pair<int, int>> ahead{{n, n}};
    while (!ahead.empty()) {
      const auto [a, b] = ahead.back();
      ahead.pop_back();
      const Node &one = node(a), &two = node(b);
      if (!some(a) || !some(b)) continue;
      if (a == b) {
        if (one.leaf()) continue;
        const int half = one.first_half;
        ahead.insert(ahead.end(), {{half, half}, {half + 1, half + 1}, {half, half + 1}});
        continue;
      }
      if (!touch(one.box, two.box)) continue;
      if (one.leaf() && two.leaf()) {
        near.join(a, b);
        if (meet(one, two)) proved.join(a, b);
      } else if (two.leaf() || (!one.leaf() && longest(one.box) >= longest(two.box))) {
        ahead.insert(ahead.end(), {{one.first_half, b}, {one.first_half + 1, b}});
      } else {
        ahead.insert(ahead.end(), {{a, two.first_half}, {a, two.first_half + 1}});
      }
    }
  }
  static double longest(const PositionBox& box) { return (box.high - box.low).maxCoeff(); }
  /// Whether some point of both is proved to be allowed: the corners and the middle of what they share are tried. The
  /// proved part of a box is convex.
  static bool meet(const Node& one, const Node& two) {
    if (one.seen.inner() && two.seen.inner()) return true;
    if (one.seen.low == 0.0 || two.seen.low == 0.0) return false;
    const Vec3 low = one.box.low.cwiseMax(two.box.low), high = one.box.high.cwiseMin(two.box.high);
    const auto both = [&](const Vec3& x) { return proved_at(one, x) && proved_at(two, x); };
    for (int corner = 0; corner < 8; ++corner) {
      Vec3 x;
      for (int k = 0; k < 3; ++k) x[k] = (corner >> k) % 2 == 0 ? low[k] : high[k];
      if (both(x)) return true;
    }
    return both((0.5 * (low + high)).cwiseMax(low).cwiseMin(high));
  }
  const Node& node(int n) const { return tree_[static_cast<std::size_t>(n)]; }
  bool some(int n) const { return some_[static_cast<std::size_t>(n)]; }
  std::vector<bool> some_;
};

}  // namespace

VolumeBounds volume_of_leaves(const Tree& tree, const std::vector<int>& low, const std::vector<int>& high) {
  const auto sum = [&](const std::vector<int>& leaves, bool upper) {
    Interval out;
    for (const int n : leaves) {
      const Node& leaf = tree[static_cast<std::size_t>(n)];
      out += volume_of(leaf.box) * Interval(upper ? leaf.seen.high : leaf.seen.low);
    }
    return out;
  };
  return {std::max(sum(low, false).lo, 0.0), sum(high, true).hi};
}

HomePiece home_piece(const Tree& tree, const Vec3& home) {
  Neighbours found(tree);
  HomePiece out;
  std::vector<int> leaves, at_home;
  int start = -1;
  for (int n = 0; n < static_cast<int>(tree.size()); ++n) {
    const Node& node = tree[static_cast<std::size_t>(n)];
    if (!node.leaf() || node.seen.outer()) continue;
    leaves.push_back(n);
    if (!touch({home, home}, node.box)) continue;
    at_home.push_back(n);
    if (proved_at(node, home)) start = n;
  }
  out.inside = start >= 0;
  out.outside = at_home.empty();
  if (out.outside) return out;
  std::vector<int> low, high;
  for (const int n : leaves) {
    if (out.inside && found.proved.root(n) == found.proved.root(start)) low.push_back(n);
    if (found.near.root(n) == found.near.root(at_home.front())) high.push_back(n);
  }
  out.volume = volume_of_leaves(tree, low, high);
  return out;
}

}  // namespace ninedof::certified
