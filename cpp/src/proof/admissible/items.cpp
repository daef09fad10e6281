#include "proof/admissible/items.hpp"

#include <algorithm>
#include <cmath>

#include "conditioning/forms/gram.hpp"
#include "limits/rows.hpp"
#include "math/numbers.hpp"

namespace ninedof::admissible {
namespace {

constexpr double plane_grain = 0x1p-46;
constexpr std::size_t most_kept = 20'000;  // forms of all items of a row, a kilobyte each

DesignForm form_of(const Item& item, const DesignLook& look) {
  return (item.bound == 0.0 ? item.row->design_numerator : item.row->design_form)(look, item.item);
}

/// At most the form at all poses of the box: the part of the poses goes to the level.
Plane below(const DesignForm& f, const Domain& domain, const Box& box) {
  PoseForm of_poses;
  for (std::size_t k = 0; k < PoseForm::size; ++k) of_poses.a[k] = -f.a[k];
  Plane out;
  std::copy(f.a.begin() + PoseForm::size, f.a.end(), out.a.begin());
  const double away = domain.greatest(of_poses, box);
  out.c = f.c - (away + f.r) * (1.0 + plane_grain) - plane_grain * (std::abs(f.c) + spread(f));
  return out;
}
/// At least the form, at one pose: what is not linear in the design goes to the level.
template <class T>
Plane above(const T& f) {
  Plane out;
  std::copy_n(f.a.end() - most_varied, most_varied, out.a.begin());
  double others = 0.0;
  for (std::size_t k = 0; k + most_varied < T::size; ++k) others += std::abs(f.a[k]);
  for (std::size_t k = 0, n = 0; n < f.q.size(); ++k, ++n) {
    for (std::size_t l = 0; l < k; ++l, ++n) others += std::abs(f.q[n]);
    others += std::max(f.q[n], 0.0);  // of a square
  }
  out.c = f.c + (others + f.r) * (1.0 + plane_grain) + plane_grain * (std::abs(f.c) + spread(f));
  return out;
}
template <class T>
Met met(const T& f) {
  if (!is_known(f)) return {};
  return {true, above(f), f.r};
}

/// As FormHome, over designs; the sides are those of the middle.
HomeOf<DesignForm> home_of(const DesignForms& forms, const LimitOptions& options) {
  HomeOf<DesignForm> out;
  out.duty = options.duty;
  set_axes(forms.joints, forms.home, options.axis, out);
  out.side.fill(1.0);
  const DesignLook look(forms.joints, forms.home, out);
  for (int k = 0; k < singularity_free_row.items; ++k)
    if (singularity_free_row.design_numerator(look, k).c < 0.0) out.side[at_index(k)] = -1.0;
  return out;
}

}  // namespace

double slopes_of(const Plane& p) {
  double sum = 0.0;
  for (const double slope : p.a) sum += std::abs(slope);
  return sum * (1.0 + plane_grain);
}

Plane below_sum(const Plane& x, double k, const Plane& y) {
  Plane out;
  for (std::size_t i = 0; i < out.a.size(); ++i) out.a[i] = x.a[i] + k * y.a[i];
  const double size = std::abs(x.c) + slopes_of(x) + k * (std::abs(y.c) + slopes_of(y));
  out.c = x.c + k * y.c - plane_grain * size;
  return out;
}

Poses::Poses(const DesignQuestion& question)
    : question_(question),
      machine_{Geometry::hexagonal(0.0, 2.0, 1.0, 0.0), {}, 1.0, question.region, {}, {}, {}},
      domain_([this]() -> const PosedRobot& {
        machine_.poses.assign(1 + question_.problem.objective.poses.size(), Configuration{});
        return machine_;
      }()) {
  const std::size_t listed = question.problem.objective.poses.size();
  for (const Box& root : domain_.roots())
    if (root.piece >= 0 || (root.piece == -1) == (listed == 0 && question.region.empty())) all_.push_back(root);
  Box neutral;
  neutral.piece = -1;
  neutral_.push_back(neutral);
}

template <class T>
PoseOf<T> Poses::pose(const Box& box, const DesignsOf<T>& designs) const {
  if (box.piece == -1) return designs.home;
  if (box.piece < 0) return listed_pose(question_.problem.objective.poses[at_index(-2 - box.piece)], designs);
  return domain_.moved<T>(box, designs.home, designs.zp);
}

template PoseOf<DesignForm> Poses::pose(const Box&, const DesignForms&) const;

DesignsAt::DesignsAt(const DesignQuestion& question, const Poses& poses, const DesignBox& box)
    : question_(question),
      poses_(poses),
      forms_(design_forms(question, box)),
      curved_(design_forms<CurvedForm>(question, box)) {
  homes_.push_back(home_of(forms_, {}));
  for (const Limit& limit : question.problem.limits) homes_.push_back(home_of(forms_, limit.options()));
  for (const auto& body : homes_.front().axis)
    for (const DesignVector& axis : body) known_ = known_ && is_known(axis.x);
  const DesignLook at_home(forms_.joints, forms_.home, homes_.front());
  std::array<double, most_varied> most{};
  for (int leg = 0; leg < 9; ++leg) {
    const auto [from, to] = at_home.ends(leg);
    const DesignVector v = to - from;
    const double length = std::max(centre(v).norm(), 1e-300);
    for (const DesignForm* x : {&v.x, &v.y, &v.z})
      for (std::size_t k = 0; k < most.size(); ++k)
        most[k] = std::max(most[k], std::abs(x->a[PoseForm::size + k]) / length);
  }
  for (const double one : most) moves_ += one;
  for (int k = 0; k < singularity_free_row.items; ++k)
    side_known_[at_index(k)] = lower(singularity_free_row.design_numerator(at_home, k)) > 0.0;
}

Seen DesignsAt::seen(const DesignForm& f, const Box& box) const {
  Seen out;
  std::copy_n(f.a.begin(), out.slope.size(), out.slope.begin());
  for (double& slope : out.slope) slope = -slope;
  out.known = is_known(f);
  if (out.known) out.kept = below(f, poses_.domain(), box);
  return out;
}

DesignForm DesignsAt::form_over(const Item& item, const DesignLook& look, const Box& box) const {
  const PoseRow& row = *item.row;
  if (row.design_forms == nullptr) return form_of(item, look);
  const std::tuple key(&row, homes_[at_index(item.limit)].duty.get(), box);
  auto at = of_rows_.find(key);
  if (at == of_rows_.end()) {
    std::array<DesignForm, 9> all;
    row.design_forms(look, all.data());
    if (of_rows_.size() >= most_kept) return all[at_index(item.item)];
    at = of_rows_.emplace(key, all).first;
  }
  return at->second[at_index(item.item)];
}

DesignForm DesignsAt::number(const Item& item, const DesignForm& u) const {
  if (item.bound == 0.0) return u;
  const PoseRow& row = *item.row;
  DesignForm bound;
  if (item.of_zp) {
    const DesignForm length = item.bound * forms_.zp;
    bound = length * length;
  } else {
    bound = DesignForm::of(row.smooth(Interval(item.bound)));
  }
  return (item.side == Side::high) != row.falls ? bound - u : u - bound;
}

/// The second direction takes as long: only where the first does not do.
Seen DesignsAt::pair_apart(const Item& item, const DesignLook& look, const Box& box) const {
  const auto legs = leg_pair_forms(look, item.item);
  const Seen one = apart_along(item, legs, fixed_direction(legs), box);
  if (one.known && least_of(one.kept) > 0.0) return one;
  const Seen other = apart_along(item, legs, turning_direction(legs), box);
  if (!other.known) return one;
  return one.known && least_of(one.kept) > least_of(other.kept) ? one : other;
}

/// The distance is at least the least of four numbers; each is above a plane of one slope, that of the least of them.
Seen DesignsAt::apart_along(const Item& item, const LegPairOf<DesignForm>& legs, const DesignVector& direction,
                            const Box& box) const {
  const auto ends = end_distances(legs, direction);
  const DesignForm distance = item.of_zp ? item.bound * forms_.zp : DesignForm(item.bound);
  std::array<Seen, 4> all;
  std::size_t lowest = 0;
  for (std::size_t k = 0; k < all.size(); ++k) {
    all[k] = seen(ends.along[k] - distance, box);
    if (!all[k].known) {
      Seen unknown;
      for (const auto* e : {&legs.one, &legs.two}) unknown.moves.add(e->to - e->from);
      return unknown;
    }
    if (least_of(all[k].kept) < least_of(all[lowest].kept)) lowest = k;
  }
  Seen out = all[lowest];
  out.moves.add(ends.between[lowest]);
  for (const auto* e : {&legs.one, &legs.two}) out.moves.add(e->to - e->from, 1e-3);
  double level = out.kept.c;
  for (const Seen& one : all) {
    Plane rest = one.kept;
    for (std::size_t k = 0; k < rest.a.size(); ++k) rest.a[k] -= out.kept.a[k];
    level = std::min(level, least_of(rest));
  }
  out.kept.c = level;
  return out;
}

Seen DesignsAt::look(const Item& item, const Box& box) const {
  const PoseOf<DesignForm> pose = poses_.pose(box, forms_);
  if (item.kind == Item::Kind::condition) {
    Seen out;
    const auto split = forms::split_by_condition(
        forms::split_gram(forms_.joints, question_.problem.characteristic_length.value, pose, out.moves, item.locked),
        item.bound);
    out.known = split.everywhere || is_known(split.excess);
    std::copy_n(split.excess.a.begin(), out.slope.size(), out.slope.begin());
    out.kept.a = split.slope;
    out.kept.c = split.everywhere ? infinity : -split.level;
    if (split.everywhere) out.kept.a = {};
    return out;
  }
  const DesignLook look(forms_.joints, pose, homes_[at_index(item.limit)]);
  if (item.kind == Item::Kind::pair) return pair_apart(item, look, box);
  Seen out = seen(number(item, form_over(item, look, box)), box);
  item.row->design_moves(look, item.item, out.moves);
  return out;
}

template <class T>
Met DesignsAt::condition(const DesignsOf<T>& designs, const Item& item, const Box& point) const {
  Moves unused;
  const double length = question_.problem.characteristic_length.value;
  const auto gram = forms::split_gram(designs.joints, length, poses_.pose(point, designs), unused, item.locked);
  return met(-forms::condition_excess(gram, item.bound));
}

Met DesignsAt::meet_closely(const Item& item, const Box& point) const {
  const bool curved = item.kind == Item::Kind::condition && point.low == point.high;
  return curved ? condition(curved_, item, point) : meet(item, point);
}

Met DesignsAt::meet(const Item& item, const Box& point) const {
  // A determinant breaks its limit on the side of each design's own home.
  if (item.kind == Item::Kind::number && item.row->on_the_way && !side_known_[at_index(item.item)]) return {};
  if (item.kind == Item::Kind::condition) return condition(forms_, item, point);
  const PoseOf<DesignForm> pose = poses_.pose(point, forms_);
  const DesignLook look(forms_.joints, pose, homes_[at_index(item.limit)]);
  if (item.kind == Item::Kind::number) return met(number(item, form_of(item, look)));
  const DesignForm distance = item.of_zp ? item.bound * forms_.zp : DesignForm(item.bound);
  // The difference of two distances, and not of their squares: its slopes are those of pair_apart.
  return met(sqrt(squared_distance_above(leg_pair_forms(look, item.item))) - distance);
}

Seen DesignsAt::look(const Length& length, const Box& box) const {
  const PoseOf<DesignForm> pose = poses_.pose(box, forms_);
  const auto [from, to] = ends_of(forms_.joints, pose, length.leg);
  const DesignVector leg = to - from;
  Seen out = seen(length.sign * sqrt(dot(leg, leg)), box);
  out.moves.add(leg);
  return out;
}

Met DesignsAt::meet(const Length& length, const Box& point) const {
  const PoseOf<DesignForm> pose = poses_.pose(point, forms_);
  const auto [from, to] = ends_of(forms_.joints, pose, length.leg);
  const DesignVector leg = to - from;
  return met(length.sign * sqrt(dot(leg, leg)));
}

}  // namespace ninedof::admissible
