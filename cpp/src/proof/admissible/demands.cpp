#include "proof/admissible/demands.hpp"

#include <algorithm>
#include <cmath>

#include "math/numbers.hpp"
#include "ninedof/math/error.hpp"
#include "robot/leg_pairs.hpp"

namespace ninedof::admissible {
namespace {

constexpr int legs = 9;
/// Lengths are first bounded up to this part of them; closely only where that does not do.
constexpr double part_of_length = 0.02;

int named(Demands& out, const std::string& limit, const std::string& part) {
  out.names.push_back({limit, part});
  return static_cast<int>(out.names.size()) - 1;
}

void add_poses(Demands& out, const LimitRow& row, Item item, const std::string& label,
               const std::array<bool, leg_pairs>& exempt) {
  item.row = row.pose;
  for (item.item = 0; item.item < row.pose->items; ++item.item) {
    if (row.pose->pairs && exempt[at_index(item.item)]) continue;
    if (row.pose->pairs) item.kind = Item::Kind::pair;
    if (row.pose->first_locked >= 0) {
      item.kind = Item::Kind::condition;
      item.locked = row.pose->first_locked + item.item;
    }
    item.demand = named(out, label, row.pose->part(item.item));
    out.items.push_back(item);
  }
}

void add_condition(Demands& out, double bound, const std::string& label, bool at_neutral) {
  if (!std::isfinite(bound)) return;
  Item item;
  item.kind = Item::Kind::condition;
  item.bound = bound;
  item.at_neutral = at_neutral;
  item.demand = named(out, label, "");
  out.items.push_back(item);
}

/// Whether no joint of the body is farther from z than joint `widest`, in no design but for 1e-9 of the distance. The
/// joints of an orbit are equally far; products of sums and differences know joints that are mirror images.
bool is_widest(const DesignForms& forms, int body, int widest) {
  const auto first = [&](int joint) { return forms.orbits ? joint - joint % 3 : joint; };
  const DesignVector& a = forms.plates[at_index(first(widest))];
  const double slack = 1e-9 * upper(a.x * a.x + a.y * a.y);
  const int begin = body < 0 ? 0 : body, end = body < 0 ? 12 : body + 6;
  for (int k = begin; k < end; ++k) {
    if (first(k) == first(widest)) continue;
    const DesignVector& b = forms.plates[at_index(first(k))];
    if (!(lower((a.x - b.x) * (a.x + b.x) + (a.y - b.y) * (a.y + b.y)) > -slack)) return false;
  }
  return true;
}

Found plane_found(const DesignForm& margin, int demand, bool loses, const Box& at) {
  Found out;
  if (!is_known(margin)) {
    out.status = Found::Status::unknown;
    return out;
  }
  Plane kept, most;
  std::copy(margin.a.begin() + PoseForm::size, margin.a.end(), kept.a.begin());
  most.a = kept.a;
  const double room = margin.r + 0x1p-46 * (std::abs(margin.c) + spread(margin));
  kept.c = margin.c - room;
  most.c = margin.c + room;
  if (least_of(kept) > 0.0) return out;
  out.status = Found::Status::cut;
  out.cuts.push_back(kept);
  if (!loses || least_of(most) >= 0.0) return out;
  out.losses.push_back({most, demand, at});
  if (most_of(most) < 0.0) out.status = Found::Status::outside;
  return out;
}

void add(Found& all, Found one) {
  using enum Found::Status;
  all.boxes += one.boxes;
  if (all.status == outside) return;
  all.losses.insert(all.losses.end(), one.losses.begin(), one.losses.end());
  all.cuts.insert(all.cuts.end(), one.cuts.begin(), one.cuts.end());
  if (one.status == outside || all.status == kept || (one.status == unknown && all.status == cut))
    all.status = one.status;
}

Box home_pose() {
  Box out;
  out.piece = -1;
  return out;
}

}  // namespace

std::array<bool, leg_pairs> pairs_that_may_meet(const DesignQuestion& question) {
  Problem asked = question.problem;
  for (std::size_t k = 0; k < question.at.size(); ++k) asked.variables[k] = {question.at[k], question.at[k]};
  for (std::size_t k = 0; k < question.varied.size(); ++k)
    asked.variables[at_index(question.varied[k])] = {question.low[k], question.high[k]};
  std::array<bool, leg_pairs> out = exempt_pairs(question.problem);
  const std::array<bool, leg_pairs> there = exempt_pairs(asked);
  for (std::size_t k = 0; k < out.size(); ++k) out[k] = out[k] && there[k];
  return out;
}

Demands::Demands(const DesignQuestion& question) {
  const std::array<bool, leg_pairs> exempt = pairs_that_may_meet(question);
  for (const LimitRow& row : limit_rows()) {
    if (row.info.kind != LimitKind::sign) continue;
    Item item;
    item.side = Side::low;
    item.with_neutral = true;
    add_poses(*this, row, item, "no singularity", exempt);
  }
  between_plates = named(*this, "zp > zs", "");
  const auto& limits = question.problem.limits;
  for (std::size_t n = 0; n < limits.size(); ++n) {
    const Limit& limit = limits[n];
    const LimitRow& row = limit_row(limit.name);
    for (const Side side : {Side::low, Side::high}) {
      const double given = side == Side::low ? limit.low : limit.high;
      if (!(given > 0.0) || !std::isfinite(given)) continue;
      if (row.pose != nullptr) {
        Item item;
        item.limit = static_cast<int>(n) + 1;
        item.side = side;
        item.bound = given;
        item.of_zp = limit.of == Unit::zp;
        item.at_neutral = limit.at == LimitAt::neutral;
        add_poses(*this, row, item, limit.label(), exempt);
      } else if (row.design != nullptr) {
        alone.push_back({row.design, side, given, limit.of, named(*this, limit.label(), "")});
      } else if (side == Side::high) {
        const int count = row.spread->each_leg ? legs : 1, first = static_cast<int>(names.size());
        for (int leg = 0; leg < count; ++leg) named(*this, limit.label(), count == 1 ? "" : leg_name(leg));
        spreads.push_back({row.spread, given, limit.of == Unit::zp, limit.at == LimitAt::neutral, first});
      }
    }
  }
  add_condition(*this, std::min(question.problem.objective.condition_limit, question.condition), "condition_number",
                false);
  add_condition(*this, question.problem.objective.neutral_condition_limit, "condition_number at neutral", true);
}

Spreads::Spreads(const DesignsAt& designs, const std::stop_token& stop) : designs_(designs), stop_(stop) {}

const Envelope& Spreads::of(const Spread& spread, int leg, double sign, bool closely) {
  Envelope& one = known_[spread.at_neutral][closely][sign > 0.0][at_index(leg)];
  if (one.boxes > 0) return one;
  const Met home = designs_.meet(Length{leg, 1.0}, home_pose());
  const double roughly = home.known ? part_of_length * home.most.c : 0.0;
  const Poses& poses = designs_.poses();
  one = envelope(designs_, {leg, sign}, spread.at_neutral ? poses.neutral() : poses.all(), closely ? 0.0 : roughly,
                 stop_);
  boxes_ += one.boxes;
  return one;
}

/// K shortest - longest, or S - (longest - shortest), of two legs.
Found Spreads::look_at(const Spread& spread, int longest, int shortest, bool closely) {
  Found out;
  const Envelope &l = of(spread, longest, -1.0, closely), &s = of(spread, shortest, 1.0, closely);
  if (!l.known || !s.known) {
    out.status = Found::Status::unknown;
    return out;
  }
  const int demand = spread.demand + (spread.row->each_leg ? longest : 0);
  for (std::size_t m = 0; m < l.least.size(); ++m)
    for (std::size_t n = 0; n < s.least.size(); ++n) {
      const Plane kept = margin(spread, l.least[m], s.least[n], false);
      if (least_of(kept) > 0.0) continue;
      Found one;
      one.status = Found::Status::cut;
      one.cuts.push_back(kept);
      const Plane most = margin(spread, l.met[m].most, s.met[n].most, true);
      if (least_of(most) < 0.0) one.losses.push_back({most, demand, l.at[m], longest, shortest, s.at[n]});
      if (most_of(most) < 0.0) one.status = Found::Status::outside;
      add(out, std::move(one));
      if (out.status == Found::Status::outside) return out;
    }
  return out;
}

Plane Spreads::margin(const Spread& spread, const Plane& less_longest, const Plane& shortest, bool above) const {
  const double k = spread.row->share(spread.high);
  Plane out = below_sum(less_longest, k, shortest);
  if (above) out.c += 2.0 * (less_longest.c + k * shortest.c - out.c);  // what rounding may take, upward
  if (spread.row->ratio) return out;
  // A share of zp changes with zp: its slope is left to the level.
  const DesignForm room = spread.of_zp ? spread.high * designs_.forms().zp : DesignForm(spread.high);
  out.c += above ? upper(room) : lower(room);
  return out;
}

Found Spreads::look_at(const Spread& spread) {
  Found out;
  const long before = boxes_;
  for (int i = 0; i < legs; ++i)
    for (int j = 0; j < legs; ++j) {
      if ((spread.row->each_leg && i != j) || out.status == Found::Status::outside) continue;
      Found one = look_at(spread, i, j, false);
      if (one.status != Found::Status::kept && one.status != Found::Status::outside) {
        Found closely = look_at(spread, i, j, true);
        if (closely.status != Found::Status::unknown) one = std::move(closely);
      }
      add(out, std::move(one));
    }
  out.boxes = boxes_ - before;
  return out;
}

Met Spreads::meet(const Spread& spread, const Loss& loss) const {
  const Met l = designs_.meet(Length{loss.longest, -1.0}, loss.at),
            s = designs_.meet(Length{loss.shortest, 1.0}, loss.other);
  if (!l.known || !s.known) return {};
  return {true, margin(spread, l.most, s.most, true), l.open + s.open};
}

Found look_at_heights(const DesignForms& forms, int demand) {
  Found out;
  for (const DesignForm& margin : {forms.zp - forms.zs, forms.zs})
    add(out, plane_found(margin, demand, true, home_pose()));
  return out;
}

Found look_at(const DesignForms& forms, const Alone& alone) {
  std::array<Vec3, 12> middle;
  for (std::size_t k = 0; k < middle.size(); ++k) middle[k] = centre(forms.plates[k]);
  const auto radius_of = [&](int joint) {
    const DesignVector& x = forms.plates[at_index(joint)];
    return sqrt(x.x * x.x + x.y * x.y);
  };
  Found out;
  for (int item = 0; item < alone.row->items(alone.side); ++item) {
    const auto [a, b] = alone.row->joints(middle, alone.side, item);
    DesignForm value =
        alone.row->form({forms.plates[at_index(a)], forms.plates[at_index(b)], forms.zp, forms.zs}, item);
    DesignForm bound = alone.bound;
    bool certain = true;
    if (alone.row->picks_widest) {
      const int widest = alone.side == Side::high && b >= point_u ? b : a;
      certain = is_widest(forms, widest < point_u ? 0 : point_u, widest);
      value.r += 1e-9 * (std::abs(value.c) + radius(value));
    }
    if (alone.of == Unit::zp) bound = alone.bound * forms.zp;
    if (alone.of == Unit::radius) {
      const int body = alone.row->body(item), widest = widest_joint(middle, body);
      if (!is_widest(forms, body, widest)) {
        out.status = Found::Status::unknown;
        return out;
      }
      bound = alone.bound * radius_of(widest);
      bound.r += 1e-9 * (std::abs(bound.c) + radius(bound));
    }
    add(out, plane_found(alone.side == Side::high ? bound - value : value - bound, alone.demand, certain, home_pose()));
    if (out.status == Found::Status::outside) return out;
  }
  return out;
}

}  // namespace ninedof::admissible
