/// What is proved of one box of positions. Declared in workspace/certified/box_tree.hpp.

#include <algorithm>
#include <cmath>

#include "workspace/certified/box_tree.hpp"

namespace ninedof::certified {
namespace {

using forms::hull_above;
using forms::reach;
using forms::share_below;

constexpr std::size_t most_compared = 8;

/// Whether poses that a cut does not prove to be allowed are among those of the other.
bool covered(const Cut& cut, const std::vector<Slope3>& hull_of_other) {
  const double room = 0x1p-48 * (reach(cut.slope) + std::abs(cut.allowed));
  return std::ranges::all_of(hull_of_other, [&](const Slope3& t) {
    return cut.slope[0] * t[0] + cut.slope[1] * t[1] + cut.slope[2] * t[2] >= cut.allowed + room;
  });
}

/// At least the share of the box where some cut does not prove that poses are allowed.
double share_not_proved(const std::vector<Cut>& cuts) {
  struct Part {
    const Cut* cut;
    double share;
  };
  std::vector<Part> parts;
  for (const Cut& cut : cuts)
    if (const double share = share_below(cut.slope, cut.allowed).hi; share > 0.0) parts.push_back({&cut, share});
  std::ranges::sort(parts, [](const Part& a, const Part& b) { return a.share > b.share; });
  std::vector<std::vector<Slope3>> kept;
  Interval sum;
  for (const Part& part : parts) {
    if (part.share >= 1.0) return 1.0;
    if (std::ranges::any_of(kept, [&](const auto& hull) { return covered(*part.cut, hull); })) continue;
    sum += part.share;
    if (sum.hi >= 1.0) return 1.0;
    if (kept.size() < most_compared) kept.push_back(hull_above(part.cut->slope, part.cut->allowed));
  }
  return sum.hi;
}

bool proves_nothing(const Cut& cut) {
  return !(cut.allowed < reach(cut.slope));
}

/// At most the share of the box where some cut proves that poses are not allowed.
double share_forbidden(const std::vector<Cut>& cuts) {
  double out = 0.0;
  for (const Cut& cut : cuts) out = std::max(out, share_below(cut.slope, cut.forbidden).lo);
  return out;
}

}  // namespace

Seen seen_of(const LimitsOverBox& cuts, const PositionBox& box, const std::vector<Seen::Left>& left, bool some) {
  Seen out{true, some ? 0.0 : 1.0, some ? 0.0 : 1.0, {}, {}};
  Interval sum;  // of shares that are allowed with some rotation
  // Where every rotation is wanted and one proves nothing in all of the box, the others matter only where they forbid
  // it.
  bool nothing_proved = false;
  for (const Seen::Left& one : left) {
    const LimitsOverBox::Found found = cuts.look(box, one.rotation, one.open, nothing_proved);
    if (found.violated) {
      if (some) continue;
      return {true, 0.0, 0.0, {}, {}};
    }
    if (found.open.none()) {
      if (!some) continue;
      return {true, 1.0, 1.0, {}, {}};
    }
    out.left.push_back({one.rotation, found.open});
    if (!some && !nothing_proved && std::ranges::any_of(found.cuts, proves_nothing)) {
      nothing_proved = true;
      std::swap(out.left.front(), out.left.back());  // first in the halves too
    }
    if (some) {
      out.low = std::max(out.low, (Interval(1.0) - share_not_proved(found.cuts)).lo);
      sum += (Interval(1.0) - share_forbidden(found.cuts)).hi;
    }
    out.cuts.insert(out.cuts.end(), found.cuts.begin(), found.cuts.end());
  }
  // What one rotation forbids another may allow: with several left nothing is known of single poses.
  if (some && out.left.size() > 1) out.cuts.assign(1, Cut{});
  if (out.left.empty()) return out;
  if (some) {
    out.high = std::min(sum.hi, 1.0);
  } else {
    out.low = (Interval(1.0) - share_not_proved(out.cuts)).lo;
    out.high = (Interval(1.0) - share_forbidden(out.cuts)).hi;
  }
  // Whole shares are kept for boxes without open criteria.
  out.low = std::clamp(out.low, 0.0, 1.0 - 0x1p-53);
  out.high = std::clamp(out.high, std::numeric_limits<double>::min(), 1.0);
  return out;
}

bool proved_at(const Node& leaf, const Vec3& x) {
  if (leaf.seen.inner()) return true;
  if (leaf.seen.outer() || leaf.seen.low == 0.0) return false;
  const PositionBox& box = leaf.box;
  Slope3 t, error;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto i = static_cast<Eigen::Index>(k);
    const double half = 0.5 * (box.high[i] - box.low[i]), middle = 0.5 * (box.low[i] + box.high[i]);
    t[k] = (x[i] - middle) / half;
    error[k] = 0x1p-49 * (1.0 + (std::abs(box.low[i]) + std::abs(box.high[i]) + std::abs(x[i])) / half);
  }
  return std::ranges::all_of(leaf.seen.cuts, [&](const Cut& cut) {
    double value = 0.0, room = 0x1p-48 * reach(cut.slope);
    for (std::size_t k = 0; k < 3; ++k) {
      value += cut.slope[k] * t[k];
      room += std::abs(cut.slope[k]) * error[k];
    }
    return value - room >= cut.allowed;
  });
}

}  // namespace ninedof::certified
