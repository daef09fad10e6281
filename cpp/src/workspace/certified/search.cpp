#include "workspace/certified/search.hpp"

#include <algorithm>

#include "domains/bound.hpp"

namespace ninedof::certified {
namespace {

using End = CertifiedWorkspace::End;

/// Boxes looked at together: a part of those that are open, so that the order is nearly that of their gaps.
constexpr std::size_t least_together = 16, most_together = 1024, part_together = 8;

struct Gap {
  double volume = 0.0;
  int node = 0;
  bool operator<(const Gap& other) const {
    return volume < other.volume || (volume == other.volume && node > other.node);
  }
};

double plain_volume(const PositionBox& box) {
  return (box.high - box.low).prod();
}

/// Halves leaves of a tree, the one with the largest gap next.
class GapSearch : public BoxSearch {
 public:
  GapSearch(Tree& tree, const LimitsOverBox& cuts, bool some, const CertifySettings& settings)
      : tree_(tree), cuts_(cuts), some_(some), settings_(settings) {
    for (int n = 0; n < static_cast<int>(tree_.size()); ++n)
      if (node(n).leaf()) add(n);
  }
  End end(const Control& control) const {
    if (reached() || open.empty()) return stuck_ && !reached() ? End::smallest : End::gap;
    return control.stop.stop_requested() ? End::stopped : looked >= settings_.boxes ? End::boxes : End::time;
  }

  struct Halves {
    std::vector<PositionBox> box;
    std::array<Seen, 2> seen;
  };
  OpenHeap<Gap> open;
  std::size_t together() const { return std::clamp(open.size() / part_together, least_together, most_together); }
  bool enough() const { return reached() || looked >= settings_.boxes; }
  std::optional<Halves> look(const Gap& one, const std::stop_token& stop) const {
    Halves out{halves_of(node(one.node).box), {}};
    for (std::size_t h = 0; h < out.box.size(); ++h) {
      if (stop.stop_requested()) return {};
      out.seen[h] = seen_of(cuts_, out.box[h], node(one.node).seen.left, some_);
    }
    return out;
  }
  void merge(const Gap& one, Halves halves) {
    if (halves.box.empty()) {  // stays as it is
      stuck_ = true;
      return;
    }
    count(one.node, -1.0);
    const int first = static_cast<int>(tree_.size());
    node(one.node).first_half = first;
    node(one.node).seen = {};
    for (std::size_t h = 0; h < 2; ++h) tree_.push_back({halves.box[h], std::move(halves.seen[h])});
    for (const int n : {first, first + 1}) add(n);
    looked += 2;
  }
  double value() const { return std::max(low_, 0.0); }

 private:
  Node& node(int n) const { return tree_[static_cast<std::size_t>(n)]; }
  /// Of sums that are no doubles nothing is known, and the gap is not reached.
  bool reached() const { return high_ - low_ <= settings_.gap * high_; }
  void count(int n, double sign) {
    const double volume = plain_volume(node(n).box);
    low_ += sign * node(n).seen.low * volume;
    high_ += sign * node(n).seen.high * volume;
  }
  void add(int n) {
    count(n, 1.0);
    const Seen& seen = node(n).seen;
    if (!seen.inner() && !seen.outer()) open.push({(seen.high - seen.low) * plain_volume(node(n).box), n});
  }

  Tree& tree_;
  const LimitsOverBox& cuts_;
  bool some_;
  const CertifySettings& settings_;
  double low_ = 0.0, high_ = 0.0;
  bool stuck_ = false;
};

/// Parts of a box, the largest next, until one holds allowed poses.
class BeyondSearch : public BoxSearch {
 public:
  using Beyond = CertifiedWorkspace::Beyond;
  struct Part {
    long number;  ///< in the order in which they were opened
    PositionBox box;
    std::vector<Seen::Left> left;
    bool operator<(const Part& other) const { return number > other.number; }
  };
  BeyondSearch(const LimitsOverBox& cuts, bool some, long looks) : cuts_(cuts), some_(some), looks_(looks) {}
  Beyond end() const { return met_ == Beyond::nothing && !open.empty() ? Beyond::unknown : met_; }

  OpenHeap<Part> open;
  bool enough() const { return met_ != Beyond::nothing || looked >= looks_; }
  std::optional<Seen> look(const Part& part, const std::stop_token&) const {
    return seen_of(cuts_, part.box, part.left, some_);
  }
  void merge(const Part& part, const Seen& seen) {
    ++looked;
    if (seen.outer()) return;
    const std::vector<PositionBox> halves = halves_of(part.box);
    if (seen.low > 0.0) met_ = Beyond::something;
    else if (halves.empty()) met_ = Beyond::unknown;
    for (const PositionBox& half : halves) open.push({++opened_, half, seen.left});
  }

 private:
  const LimitsOverBox& cuts_;
  bool some_;
  long looks_, opened_ = 0;
  Beyond met_ = Beyond::nothing;
};

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
          const std::stop_token& stop, const Control& control) {
  GapSearch search(out.tree, cuts, some, settings);
  search.looked = out.looked;
  bound(search, {stop, control.progress}, settings.threads, 4);
  out.looked = search.looked;
  out.end = search.end(control);
}

CertifiedWorkspace::Beyond anything_in(const LimitsOverBox& cuts, const PositionBox& box, bool some, long looks,
                                       const std::stop_token& stop) {
  BeyondSearch search(cuts, some, looks);
  search.open.push({0, box, everything(cuts)});
  bound(search, {stop, {}});
  return search.end();
}

}  // namespace ninedof::certified
