#include "workspace/certified/search.hpp"

#include <algorithm>
#include <queue>

#include "ninedof/math/parallel.hpp"

namespace ninedof::certified {
namespace {

using End = CertifiedWorkspace::End;

/// Boxes looked at together: a part of those that are open, so that the order is nearly that of their gaps.
constexpr std::size_t least_together = 16, most_together = 1024, part_together = 8;

struct Gap {
  double volume;
  int node;
  bool operator<(const Gap& other) const {
    return volume < other.volume || (volume == other.volume && node > other.node);
  }
};

double plain_volume(const PositionBox& box) {
  return (box.high - box.low).prod();
}

std::vector<Seen::Left> everything(const LimitsOverBox& cuts) {
  std::vector<Seen::Left> out;
  for (std::size_t r = 0; r < cuts.rotations(); ++r) out.push_back({static_cast<std::uint32_t>(r), cuts.all()});
  return out;
}

}  // namespace

std::vector<PositionBox> halves_of(const PositionBox& box) {
  Eigen::Index k = 0;
  (box.high - box.low).maxCoeff(&k);
  const double middle = 0.5 * (box.low[k] + box.high[k]);
  if (!(box.low[k] < middle && middle < box.high[k])) return {};
  std::vector<PositionBox> out(2, box);
  out[0].high[k] = out[1].low[k] = middle;
  return out;
}

Grown seed(const LimitsOverBox& cuts, const PositionBox& box, bool some) {
  Grown out;
  out.tree.push_back({box, seen_of(cuts, box, everything(cuts), some)});
  out.looked = 1;
  return out;
}

void grow(Grown& out, const LimitsOverBox& cuts, bool some, const CertifySettings& settings,
          const std::function<bool()>& time_is_over, const Control& control) {
  Tree& tree = out.tree;
  out.end = End::gap;
  std::priority_queue<Gap> open;
  const auto volume = [&](int n) { return plain_volume(tree[static_cast<std::size_t>(n)].box); };
  double low = 0.0, high = 0.0;
  const auto count = [&](int n, double sign) {
    const Seen& seen = tree[static_cast<std::size_t>(n)].seen;
    low += sign * seen.low * volume(n);
    high += sign * seen.high * volume(n);
  };
  const auto put = [&](int n) {
    const Seen& seen = tree[static_cast<std::size_t>(n)].seen;
    if (!seen.inner() && !seen.outer()) open.push({(seen.high - seen.low) * volume(n), n});
  };
  for (int n = 0; n < static_cast<int>(tree.size()); ++n)
    if (tree[static_cast<std::size_t>(n)].leaf()) {
      count(n, 1.0);
      put(n);
    }
  const auto over = [&] { return control.stop.stop_requested() || time_is_over(); };
  bool stuck = false;
  // Of sums that are no doubles nothing is known, and the gap is not reached.
  while (!open.empty() && !(high - low <= settings.gap * high)) {
    if (control.stop.stop_requested() || time_is_over() || out.looked >= settings.boxes) {
      out.end = control.stop.stop_requested() ? End::stopped : out.looked >= settings.boxes ? End::boxes : End::time;
      return;
    }
    struct Item {
      int node;
      std::vector<PositionBox> half;
      std::array<Seen, 2> seen;
    };
    std::vector<Item> items;
    const std::size_t together = std::clamp(open.size() / part_together, least_together, most_together);
    while (!open.empty() && items.size() < together) {
      const int n = open.top().node;
      open.pop();
      Item item{n, halves_of(tree[static_cast<std::size_t>(n)].box), {}};
      if (item.half.empty()) stuck = true;  // stays as it is
      else items.push_back(std::move(item));
    }
    parallel_for(std::ssize(items), 4, settings.threads, [&](long first, long last) {
      for (long k = first; k < last; ++k) {
        Item& item = items[static_cast<std::size_t>(k)];
        const Seen& whole = tree[static_cast<std::size_t>(item.node)].seen;
        for (std::size_t h = 0; h < 2; ++h)
          if (!over()) item.seen[h] = seen_of(cuts, item.half[h], whole.left, some);
      }
    });
    for (Item& item : items) {
      if (!item.seen[0].looked || !item.seen[1].looked) {
        put(item.node);
        continue;
      }
      count(item.node, -1.0);
      const int first = static_cast<int>(tree.size());
      Node& whole = tree[static_cast<std::size_t>(item.node)];
      whole.first_half = first;
      whole.seen = {};
      for (std::size_t h = 0; h < 2; ++h) tree.push_back({item.half[h], std::move(item.seen[h])});
      for (const int n : {first, first + 1}) {
        count(n, 1.0);
        put(n);
      }
      out.looked += 2;
    }
    if (control.progress) control.progress(out.looked, 0, std::max(low, 0.0));
  }
  if (stuck && !(high - low <= settings.gap * high)) out.end = End::smallest;
}

CertifiedWorkspace::Beyond anything_in(const LimitsOverBox& cuts, const PositionBox& box, bool some, long looks,
                                       const std::function<bool()>& over) {
  using Beyond = CertifiedWorkspace::Beyond;
  struct Part {
    PositionBox box;
    std::vector<Seen::Left> left;
  };
  std::queue<Part> ahead;  // the largest first
  ahead.push({box, everything(cuts)});
  for (; !ahead.empty() && looks > 0 && !over(); --looks) {
    const Part part = std::move(ahead.front());
    ahead.pop();
    const Seen seen = seen_of(cuts, part.box, part.left, some);
    if (seen.outer()) continue;
    if (seen.low > 0.0) return Beyond::something;
    const std::vector<PositionBox> halves = halves_of(part.box);
    if (halves.empty()) return Beyond::unknown;
    for (const PositionBox& half : halves) ahead.push({half, seen.left});
  }
  return ahead.empty() ? Beyond::nothing : Beyond::unknown;
}

}  // namespace ninedof::certified
