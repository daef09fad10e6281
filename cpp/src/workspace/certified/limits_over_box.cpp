#include "workspace/certified/limits_over_box.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "math/numbers.hpp"
#include "ninedof/limits/numbers.hpp"
#include "ninedof/math/error.hpp"
#include "robot/leg_pairs.hpp"

namespace ninedof::certified {
namespace {

/// What u has to keep for a number to be in a range; a limit of 0 needs no form.
std::vector<Edge> edges_of(const PoseRow& row, const Interval& range) {
  std::vector<Edge> out;
  const auto add = [&](bool least, double limit) {
    Edge edge{least != row.falls, {}};
    if (limit != 0.0 || row.numerator == nullptr) edge.at = PoseForm::of(row.smooth(Interval(limit)));
    out.push_back(edge);
  };
  if (range.lo > -infinity) add(true, range.lo);
  if (range.hi < infinity) add(false, range.hi);
  return out;
}

/// Positive where the edge is kept.
PoseForm kept(const Edge& edge, const PoseForm& u) {
  return !edge.at ? u : edge.least ? u - *edge.at : *edge.at - u;
}

FormVector centroid_of(const Triple& t) {
  const PoseForm third = PoseForm::of(Interval(1.0) / 3.0);
  return third * (constant<PoseForm>(t[0]) + constant<PoseForm>(t[1]) + constant<PoseForm>(t[2]));
}

}  // namespace

LimitsOverBox::LimitsOverBox(const Geometry& g, const WorkspaceDomain& domain, const InternalPointRule& rule,
                             const WorkspaceCriteria& criteria, const Configuration& home)
    : geometry_(g), criteria_(criteria), rule_(rule), some_(domain.archetype == Archetype::reachable) {
  for (const Mat3& q : domain.rotations) rotations_.push_back(rotation_columns(q));
  if (criteria.legs) {
    std::vector<Interval> ranges;
    for (int k = 0; k < 9; ++k)
      ranges.emplace_back(criteria.legs->low[k] > 0.0 ? criteria.legs->low[k] : -infinity, criteria.legs->high[k]);
    add(*leg_length_limit().pose, FormHome(g, home, {}), ranges);
  }
  const std::array<bool, leg_pairs> exempt = pairs_sharing_a_joint(g, criteria.exempt);
  for (const bool pairs : {false, true})
    for (const PoseCriterion& c : criteria_besides_legs(criteria)) {
      const PoseRow* row = c.row->pose;
      if (row == nullptr || row->pairs != pairs) continue;
      if (row->first_locked >= 0) {
        for (int item = 0; item < row->items; ++item)
          conditions_.push_back({add_bit(), row->first_locked + item, c.high});
        continue;
      }
      const bool no_limit = c.row->info.kind == LimitKind::angle && c.high >= std::numbers::pi;  // none is greater
      std::vector<Interval> ranges(at_index(row->items), Interval(c.low, no_limit ? infinity : c.high));
      for (int item = 0; pairs && item < row->items; ++item)
        if (exempt[at_index(item)]) ranges[at_index(item)] = Interval::whole();
      add(*row, FormHome(g, home, c.options), ranges);
      if (row->on_the_way) require_kept(rows_.back(), home, c.row->info.name);
    }
  if (criteria.condition_number) conditions_.push_back({add_bit(), -1, *criteria.condition_number});
}

int LimitsOverBox::add_bit() {
  all_.set(at_index(bits_));
  return bits_++;
}

void LimitsOverBox::add(const PoseRow& row, const FormHome& home, const std::vector<Interval>& ranges) {
  rows_.push_back({&row, home, {}});
  for (const Interval& range : ranges) {
    const bool open = range.lo == -infinity && range.hi == infinity;
    rows_.back().items.push_back(
        {open ? -1 : add_bit(), range.lo, row.pairs ? std::vector<Edge>{} : edges_of(row, range)});
  }
}

void LimitsOverBox::require_kept(const RowCuts& cuts, const Configuration& home, const std::string& name) const {
  const FormPose at_home = form_pose(home);
  const AsBuilt machine{geometry_};
  const FormLook look(machine, at_home, cuts.home);
  for (int item = 0; item < cuts.row->items; ++item)
    for (const Edge& edge : cuts.items[at_index(item)].edges)
      if (!(lower(kept(edge, u_of(cuts, look, item))) > 0.0))
        throw InvalidArgument("home",
                              edge.at ? "a configuration that passes a limit of " + name
                                      : "a configuration that rounding cannot tell from a singular one",
                              edge.at ? "one that keeps it" : "a regular one with " + name);
}

PoseForm LimitsOverBox::u_of(const RowCuts& cuts, const FormLook& look, int item) {
  const bool whole = cuts.items[at_index(item)].edges.front().at.has_value();
  return whole ? cuts.row->form(look, item) : cuts.row->numerator(look, item);
}

FormPose LimitsOverBox::pose(const PositionBox& box, std::size_t rotation) const {
  const auto coordinate = [&](Eigen::Index k) { return PoseForm::coordinate(box.low[k], box.high[k], at_index(k)); };
  FormPose out{{coordinate(0), coordinate(1), coordinate(2)}, {}, rotations_[rotation]};
  using Kind = InternalPointRule::Kind;
  if (rule_.kind == Kind::fixed) {
    out.s = constant<PoseForm>(rule_.point);
  } else if (rule_.kind == Kind::platform) {
    out.s = out.p + turned(out, rule_.point);
  } else {
    const FormVector lower = centroid_of(geometry_.base_internal()), arm = centroid_of(geometry_.platform_internal());
    const FormVector upper = out.p + (arm.x * out.q[0] + arm.y * out.q[1] + arm.z * out.q[2]);
    out.s = lower + PoseForm(rule_.fraction) * (upper - lower);
  }
  return out;
}

bool LimitsOverBox::decided(const PoseForm& f, Found& found) {
  if (!is_known(f)) {
    found.cuts.emplace_back();
    return false;
  }
  if (lower(f) > 0.0) return true;
  if (upper(f) < 0.0) {
    found.violated = true;
    return true;
  }
  found.cuts.push_back(
      {{f.a[0], f.a[1], f.a[2]}, ninedof::detail::above(f.r - f.c), ninedof::detail::below(-f.r - f.c)});
  return false;
}

void LimitsOverBox::look_at(const RowCuts& cuts, const FormPose& pose, Found& found) const {
  const AsBuilt machine{geometry_};
  const FormLook look(machine, pose, cuts.home);
  for (int item = 0; item < cuts.row->items && !found.violated; ++item) {
    const auto& [place, low, edges] = cuts.items[at_index(item)];
    if (place < 0 || !found.open[at_index(place)]) continue;
    bool all = !cuts.row->pairs || look_at_pair(leg_pair_forms(look, item), low, found);
    if (!edges.empty()) {
      const PoseForm u = u_of(cuts, look, item);
      for (const Edge& edge : edges) all = decided(kept(edge, u), found) && all;
    }
    if (all && !found.violated) found.open.reset(at_index(place));
  }
}

bool LimitsOverBox::look_at_pair(const LegPairForms& legs, double distance, Found& found) {
  Cut apart;
  if (all_apart(legs, distance, apart)) return true;
  found.cuts.push_back(apart);
  const PoseForm lack = PoseForm::of(square(Interval(distance))) - squared_distance_above(legs);
  if (!is_known(lack)) return false;
  if (lower(lack) > 0.0) found.violated = true;
  // Less than the distance apart where lack > 0: slope . t below.
  else found.cuts.push_back({{-lack.a[0], -lack.a[1], -lack.a[2]}, -infinity, ninedof::detail::below(lack.c - lack.r)});
  return false;
}

bool LimitsOverBox::all_apart(const LegPairForms& legs, double distance, Cut& apart) {
  // The row has no form: what the least of four forms is above is known by planes, not by a form.
  FormVector direction = turning_direction(legs);
  if (!is_known(direction.x)) direction = fixed_direction(legs);
  // The distance is at least the least of four numbers; each is above a plane of one slope, that of the least of them.
  std::array<PoseForm, 4> spare = end_distances(legs, direction).along;
  std::size_t lowest = 0;
  for (std::size_t k = 0; k < spare.size(); ++k) {
    spare[k] = spare[k] - PoseForm(distance);
    if (!is_known(spare[k])) return false;
    if (lower(spare[k]) < lower(spare[lowest])) lowest = k;
  }
  if (lower(spare[lowest]) > 0.0) return true;
  double level = -infinity;
  for (PoseForm rest : spare) {
    if (lower(rest) > 0.0) continue;
    for (std::size_t i = 0; i < 3; ++i) {
      apart.slope[i] = spare[lowest].a[i];
      rest.a[i] -= apart.slope[i];
      rest.r += 0x1p-52 * std::abs(rest.a[i]);
    }
    level = std::max(level, -lower(rest));
  }
  apart.allowed = ninedof::detail::above(level);
  return false;
}

void LimitsOverBox::look_at(const ConditionLimit& limit, const FormPose& pose, Found& found) const {
  if (!found.open[at_index(limit.bit)]) return;
  Moves unused;
  const forms::ConditionSplit split = forms::split_by_condition(
      forms::split_gram(AsBuilt{geometry_}, criteria_.characteristic_length, pose, unused, limit.locked), limit.high);
  if (split.everywhere) {
    found.open.reset(at_index(limit.bit));
    return;
  }
  if (!is_known(split.excess)) {
    found.cuts.emplace_back();
    return;
  }
  if (lower(split.excess) > 0.0) {
    found.violated = true;
    return;
  }
  found.cuts.push_back({split.slope, split.level, ninedof::detail::below(split.excess.c - split.excess.r)});
}

LimitsOverBox::Found LimitsOverBox::look(const PositionBox& box, std::size_t rotation, Criteria open,
                                         bool cheap_ones) const {
  const FormPose at = pose(box, rotation);
  Found found{open, false, {}};
  for (const RowCuts& row : rows_)
    if (!found.violated) look_at(row, at, found);
  for (const ConditionLimit& limit : conditions_)
    if (!found.violated && !cheap_ones) look_at(limit, at, found);
  return found;
}

PositionBox LimitsOverBox::reached_with(std::size_t rotation) const {
  PositionBox out{Vec3::Constant(-infinity), Vec3::Constant(infinity)};
  if (!criteria_.legs) return out;
  // A leg is k p + what it is at p = 0: solved for p, which a form over a box of p cannot be.
  const FormPose zero = pose({Vec3::Zero(), Vec3::Zero()}, rotation);
  using Kind = InternalPointRule::Kind;
  const Interval share = rule_.kind == Kind::fixed ? 0.0 : rule_.kind == Kind::platform ? 1.0 : rule_.fraction;
  for (int leg = 0; leg < 9; ++leg) {
    const Interval k = leg < 3 ? Interval(1.0) : leg < 6 ? share - 1.0 : share, high(criteria_.legs->high[leg]);
    if (!std::isfinite(high.hi) || (k.lo <= 0.0 && k.hi >= 0.0)) continue;
    const FormEnds e = ends_of(geometry_, zero, leg);
    const FormVector at = e.to - e.from;
    const std::array<const PoseForm*, 3> parts{&at.x, &at.y, &at.z};
    for (int i = 0; i < 3; ++i) {
      const Interval start(lower(*parts[at_index(i)]), upper(*parts[at_index(i)]));
      const Interval one = (-start - high) / k, other = (high - start) / k;
      out.low[i] = std::max(out.low[i], std::min(one.lo, other.lo));
      out.high[i] = std::min(out.high[i], std::max(one.hi, other.hi));
    }
  }
  return out;
}

PositionBox LimitsOverBox::reached() const {
  PositionBox out = reached_with(0);
  for (std::size_t r = 1; r < rotations_.size(); ++r) {
    const PositionBox one = reached_with(r);
    // Every rotation is wanted, or one is enough.
    out.low = some_ ? Vec3(out.low.cwiseMin(one.low)) : Vec3(out.low.cwiseMax(one.low));
    out.high = some_ ? Vec3(out.high.cwiseMax(one.high)) : Vec3(out.high.cwiseMin(one.high));
  }
  return out;
}

}  // namespace ninedof::certified
