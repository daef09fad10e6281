#include "proof/admissible/climb.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include "domains/bound.hpp"
#include "math/numbers.hpp"

namespace ninedof::admissible {
namespace {

constexpr double most_boxes_of_item = 4000.0, most_boxes_of_condition = 40'000.0, boxes_of_whole = 500.0;
constexpr long boxes_for_losses = 50;  ///< where another item is not known to be kept: no box is proved then
constexpr std::size_t most_cuts = 400;
constexpr double part_around_middle = 1.0 / 16.0;
/// Errors grow with the square of both: at this ratio the boxes of five coordinates of poses and two of designs are
/// few.
constexpr double times_designs = 2.0;
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

Plane lowered(const Plane& x, const Met& met) {
  Plane out = x;
  out.c -= moved_down * std::max(met.most.c - x.c, 0.0);
  return out;
}

bool covered(const Plane& x, const std::vector<Plane>& by) {
  return std::ranges::any_of(by, [&](const Plane& plane) { return is_above(x, plane); });
}

double moves_of(const Seen& seen) {
  return std::accumulate(seen.moves.along.begin(), seen.moves.along.end(), 0.0);
}

/// A small box in a box: its slopes are known where those of the whole are not.
Box around_middle(const Box& box) {
  Box out = over_region::middle_of(box);
  for (std::size_t k = 0; k < PoseForm::size; ++k) {
    const double half = part_around_middle * 0.5 * (box.high[k] - box.low[k]);
    out.low[k] -= half;
    out.high[k] += half;
  }
  return out;
}

/// Boxes of poses, the least plane next, until planes are near the least of the number at all poses.
template <class Number>
struct PlaneSearch : BoxSearch {
  PlaneSearch(const DesignsAt& of_designs, const Number& of, const std::vector<Box>& roots, double at_most)
      : designs(of_designs), number(of), begun(std::ssize(roots)), most(static_cast<long>(at_most) + begun) {
    for (const Box& root : roots) add(root);
  }
  const DesignsAt& designs;
  const Number& number;
  long begun, most;
  /// Whether boxes may be looked at beyond `quick`, as long as all designs keep the number at the poses that are met.
  bool patient = false;
  double quick = infinity;
  std::size_t most_planes = std::numeric_limits<std::size_t>::max();
  double until = infinity;  ///< a least above which boxes do not matter
  double allowed = 0.0;
  OpenHeap<Open> open;
  std::vector<Plane> planes;
  std::vector<Met> met;
  std::vector<Box> at, closed;
  std::vector<Loss> losses;
  std::optional<Found::Status> end;

  bool over() const { return open.empty() || open.top().least > until; }
  bool enough() const { return end || over() || looked >= most || planes.size() >= most_planes; }
  void merge(const Open& one, Nothing) {
    if (one.seen.known && covered(one.seen.kept, planes)) return closed.push_back(one.box);
    const Box pose = worst_pose(one);
    const Met here = designs.meet(number, pose);
    if (here.known && lost(here, pose)) {
      end = Found::Status::outside;
      return;
    }
    const bool near = here.known && near_enough(one.seen, here);
    if (!patient || !(least_of(here.most) > 2.0 * here.open)) {
      most = std::min(most, static_cast<long>(std::min(quick, 1e9)) + begun);
    } else if (here.known && !near && moves_of(one.seen) < times_designs * designs.moves()) {
      end = Found::Status::unknown;  // all designs may keep it, and smaller ones need fewer poses
      closed.push_back(one.box);
      return;
    }
    if (here.known && !near && divide(one)) return;
    closed.push_back(one.box);
    if (!(here.known && one.seen.known && std::isfinite(one.seen.kept.c))) {
      end = Found::Status::unknown;
      return;
    }
    planes.push_back(lowered(one.seen.kept, here));
    met.push_back(here);
    at.push_back(pose);
  }

 private:
  void add(const Box& box) {
    if (designs.poses().domain().outside(box)) return;
    ++looked;
    Seen seen = designs.look(number, box);
    open.push({seen.known ? least_of(seen.kept) : -infinity, box, seen});
  }
  /// The pose of a box where the number is least in the middle of the designs, as far as its form says.
  Box worst_pose(const Open& one) const {
    const Domain& domain = designs.poses().domain();
    const Seen seen = one.seen.known || !patient ? one.seen : designs.look(number, around_middle(one.box));
    return seen.known ? domain.towards(seen.slope, one.box) : domain.nearest(over_region::middle_of(one.box));
  }
  bool lost(const Met& here, const Box& pose) {
    if constexpr (std::is_same_v<Number, Item>) {
      if (least_of(here.most) >= 0.0) return false;
      losses.push_back({here.most, number.demand, pose});
      return most_of(here.most) < 0.0;
    }
    return false;
  }
  bool near_enough(const Seen& seen, const Met& here) const {
    if (!seen.known || !std::isfinite(seen.kept.c)) return false;
    double off = here.most.c - seen.kept.c, change = 0.0;
    for (std::size_t k = 0; k < most_varied; ++k) {
      off += std::abs(here.most.a[k] - seen.kept.a[k]);
      change += std::abs(here.most.a[k]);
    }
    return off <= std::max({part_of_change * change, times_open * here.open, allowed});
  }
  bool divide(const Open& one) {
    const int k = coordinate_to_divide(one.box, designs.poses().all(), one.seen);
    if (k < 0) return false;
    for (const Box& half : over_region::halves(one.box, k)) add(half);
    return true;
  }
};

}  // namespace

Found climb(const DesignsAt& designs, const Item& item, const std::vector<Box>& roots, double width, bool may_be_inside,
            const std::stop_token& stop) {
  const bool of_condition = item.kind == Item::Kind::condition;
  const double most = of_condition ? most_boxes_of_condition : most_boxes_of_item;
  const bool patient = item.row != nullptr && item.row->design_forms != nullptr;
  PlaneSearch search(designs, item, roots, patient ? most : std::min(most, boxes_of_whole / width));
  search.patient = patient;
  search.quick = boxes_of_whole / width;
  if ((patient || of_condition) && !may_be_inside) search.most = boxes_for_losses + search.begun;
  search.most_planes = most_cuts;
  search.until = 0.0;
  bound(search, {stop, {}});
  if (!search.end && !search.over()) search.end = Found::Status::unknown;
  const Found::Status proved = search.planes.empty() ? Found::Status::kept : Found::Status::cut;
  Found out{search.end.value_or(proved), std::move(search.planes), std::move(search.losses), {}, search.looked};
  if (!of_condition && !patient) return out;
  out.open = std::move(search.closed);
  while (!search.over()) out.open.push_back(search.open.pop().box);
  return out;
}

Envelope envelope(const DesignsAt& designs, const Length& length, const std::vector<Box>& roots, double allowed,
                  const std::stop_token& stop) {
  PlaneSearch search(designs, length, roots, most_boxes_of_item);
  search.allowed = allowed;
  bound(search, {stop, {}});
  const bool known = !search.end && search.over() && !search.planes.empty();
  return {known, std::move(search.planes), std::move(search.met), std::move(search.at), search.looked};
}

}  // namespace ninedof::admissible
