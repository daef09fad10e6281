#include "proof/admissible/climb.hpp"

#include <algorithm>
#include <cmath>
#include <queue>

#include "math/numbers.hpp"

namespace ninedof::admissible {
namespace {

constexpr double most_boxes_of_item = 4000.0, most_boxes_of_condition = 40'000.0, boxes_of_whole = 500.0;
constexpr std::size_t most_cuts = 400;
/// A plane is taken where it is off by less than this part of what the number changes over the designs, or by this many
/// times what the designs alone leave open.
constexpr double part_of_change = 0.02, times_open = 4.0;
/// It is then moved down by this part of what it is off: its neighbours need no planes of their own.
constexpr double moved_down = 0.5;

struct Open {
  double least;
  Box box;
  Seen seen;
  bool operator<(const Open& other) const { return least > other.least; }
};

bool is_above(const Plane& x, const Plane& y) {
  Plane apart;
  for (std::size_t k = 0; k < apart.a.size(); ++k) apart.a[k] = x.a[k] - y.a[k];
  apart.c = x.c - y.c;
  return least_of(apart) >= 0.0;
}

/// The widest coordinate where forms say nothing.
int coordinate_to_divide(const Box& box, const std::vector<Box>& roots, const Seen& seen) {
  if (const int k = over_region::divided_coordinate(box, seen.moves.along); seen.known || k >= 0) return k;
  std::array<double, PoseForm::size> width{};
  for (const Box& root : roots)
    for (std::size_t k = 0; k < width.size(); ++k)
      if (root.piece == box.piece && root.high[k] > root.low[k])
        width[k] = (box.high[k] - box.low[k]) / (root.high[k] - root.low[k]);
  return over_region::divided_coordinate(box, width);
}

/// The loop that both searches share: boxes of poses, the least plane first, until `closed` says that no other matters.
template <class Number>
class Descent {
 public:
  Descent(const DesignsAt& designs, const Number& number, const std::vector<Box>& roots, long most, const Stop& stop)
      : designs_(designs), number_(number), most_(most + std::ssize(roots)), stop_(stop) {
    for (const Box& root : roots) add(root);
  }
  bool done() const { return open_.empty(); }
  bool spent() { return boxes_ >= most_ || (++turns_ % 32 == 0 && stop_()); }
  long boxes() const { return boxes_; }
  double least() const { return open_.top().least; }
  Open take() {
    Open out = open_.top();
    open_.pop();
    return out;
  }
  /// The pose of a box where the number is least in the middle of the designs, as far as its form says.
  Box worst_pose(const Open& one) const {
    const Domain& domain = designs_.poses().domain();
    return one.seen.known ? domain.towards(one.seen.slope, one.box) : domain.nearest(over_region::middle_of(one.box));
  }
  bool near_enough(const Seen& seen, const Met& met, double allowed) const {
    if (!seen.known || !std::isfinite(seen.kept.c)) return false;
    double off = met.most.c - seen.kept.c, change = 0.0;
    for (std::size_t k = 0; k < most_varied; ++k) {
      off += std::abs(met.most.a[k] - seen.kept.a[k]);
      change += std::abs(met.most.a[k]);
    }
    return off <= std::max({part_of_change * change, times_open * met.open, allowed});
  }
  bool divide(const Open& one) {
    const int k = coordinate_to_divide(one.box, designs_.poses().all(), one.seen);
    if (k < 0) return false;
    for (const Box& half : over_region::halves(one.box, k)) add(half);
    return true;
  }

 private:
  void add(const Box& box) {
    if (designs_.poses().domain().outside(box)) return;
    ++boxes_;
    Seen seen = designs_.look(number_, box);
    open_.push({seen.known ? least_of(seen.kept) : -infinity, box, seen});
  }

  const DesignsAt& designs_;
  const Number& number_;
  long most_;
  const Stop& stop_;
  std::priority_queue<Open> open_;
  long boxes_ = 0, turns_ = 0;
};

Plane lowered(const Plane& x, const Met& met) {
  Plane out = x;
  out.c -= moved_down * std::max(met.most.c - x.c, 0.0);
  return out;
}

bool covered(const Plane& x, const std::vector<Plane>& by) {
  return std::ranges::any_of(by, [&](const Plane& plane) { return is_above(x, plane); });
}

}  // namespace

Found climb(const DesignsAt& designs, const Item& item, const std::vector<Box>& roots, double width, const Stop& stop) {
  Found out;
  const auto lost = [&](const Met& met, const Box& at) {
    if (!met.known || least_of(met.most) >= 0.0) return false;
    out.losses.push_back({met.most, item.demand, at});
    return most_of(met.most) < 0.0;
  };
  const bool keeps_open = item.kind == Item::Kind::condition;
  const double most = std::min(keeps_open ? most_boxes_of_condition : most_boxes_of_item, boxes_of_whole / width);
  Descent<Item> descent(designs, item, roots, static_cast<long>(most), stop);
  const auto finish = [&](Found::Status status) {
    out.status = status;
    out.boxes = descent.boxes();
    while (keeps_open && !descent.done() && !(descent.least() > 0.0)) out.open.push_back(descent.take().box);
    return out;
  };
  while (!descent.done() && !(descent.least() > 0.0)) {
    if (descent.spent() || out.cuts.size() >= most_cuts) return finish(Found::Status::unknown);
    const Open one = descent.take();
    if (one.seen.known && covered(one.seen.kept, out.cuts)) {
      if (keeps_open) out.open.push_back(one.box);
      continue;
    }
    const Box at = descent.worst_pose(one);
    const Met met = designs.meet(item, at);
    if (!met.known) {
      if (keeps_open) out.open.push_back(one.box);
      return finish(Found::Status::unknown);
    }
    if (lost(met, at)) return finish(Found::Status::outside);
    if (!descent.near_enough(one.seen, met, 0.0) && descent.divide(one)) continue;
    if (keeps_open) out.open.push_back(one.box);
    if (!one.seen.known || !std::isfinite(one.seen.kept.c)) return finish(Found::Status::unknown);
    out.cuts.push_back(lowered(one.seen.kept, met));
  }
  return finish(out.cuts.empty() ? Found::Status::kept : Found::Status::cut);
}

Envelope envelope(const DesignsAt& designs, const Length& length, const std::vector<Box>& roots, double allowed,
                  const Stop& stop) {
  Envelope out;
  Descent<Length> descent(designs, length, roots, static_cast<long>(most_boxes_of_item), stop);
  while (!descent.done()) {
    const Open one = descent.take();
    out.boxes = descent.boxes();
    if (descent.spent()) return out;
    if (one.seen.known && covered(one.seen.kept, out.least)) continue;
    const Box at = descent.worst_pose(one);
    const Met met = designs.meet(length, at);
    if (!met.known) return out;
    if (!descent.near_enough(one.seen, met, allowed) && descent.divide(one)) continue;
    if (!one.seen.known) return out;
    out.least.push_back(lowered(one.seen.kept, met));
    out.met.push_back(met);
    out.at.push_back(at);
  }
  out.known = !out.least.empty();
  return out;
}

}  // namespace ninedof::admissible
