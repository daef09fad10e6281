#include "design/constraints/spread.hpp"

#include <cmath>

namespace ninedof {

Spread::Spread(const Limit& limit, Measure measure, int groups, int count, Purpose purpose)
    : Constraint(limit),
      measure_(measure),
      groups_(groups),
      count_(count),
      way_(purpose == Purpose::evaluate || count < 2 ? Way::ruling
           : count <= few                            ? Way::pairs
                                                     : Way::auxiliary) {}

int Spread::each() const {
  switch (way_) {
    case Way::pairs: return count_ * (count_ - 1);
    case Way::auxiliary: return 2 * count_;
    case Way::ruling: return 1;
  }
  return 0;
}

int Spread::items(Side side) const {
  // At least: only the longest and the shortest leg count.
  return side == Side::high ? groups_ * each() : groups_;
}

double Spread::price_factor(int row) const {
  const auto [side, item] = item_of(row);
  return way_ == Way::auxiliary && side == Side::high && item % each() < count_ ? 0.0 : 1.0;
}

double Spread::violation_factor(int row) const {
  return way_ == Way::auxiliary && item_of(row).first == Side::high ? 2.0 : 1.0;
}

double Spread::room() const {
  return measure_ == Measure::ratio ? std::log(limit().high) : 1.0;
}

double Spread::phi(const DesignState& v, const LegExtreme& l) const {
  if (measure_ == Measure::ratio) return std::log(v.length(l) / v.unit);
  return v.length(l) / (limit().high * unit(v));
}

void Spread::add_phi(const DesignState& v, const LegExtreme& l, double scale, Row out) const {
  const double length = v.length(l);
  if (measure_ == Measure::ratio) {
    if (length > 0.0) v.add_leg(l.pose, l.leg, scale / length, out);
    return;
  }
  const double size = limit().high * unit(v);
  v.add_leg(l.pose, l.leg, scale / size, out);
  add_unit_gradient(v, -scale * length * limit().high / (size * size), out);
}

double Spread::auxiliary_value(const DesignState& v, int group) const {
  // In the middle between the bounds of h, whether they leave room or not.
  return 0.5 * (phi(v, shortest(v, group)) + phi(v, longest(v, group)) - room());
}

std::pair<LegExtreme, LegExtreme> Spread::pair(const DesignState& v, int group, int item) const {
  if (way_ == Way::ruling) return {longest(v, group), shortest(v, group)};
  const int a = item / (count_ - 1), b = item % (count_ - 1);
  return {leg(v, group, a), leg(v, group, b < a ? b : b + 1)};
}

double Spread::item_margin(const DesignState& v, Side side, int item) const {
  if (side == Side::low) return phi(v, longest(v, item)) - phi(v, shortest(v, item)) - std::log(limit().low);
  const int group = item / each(), k = item % each();
  if (way_ != Way::auxiliary) {
    const auto [a, b] = pair(v, group, k);
    return room() - (phi(v, a) - phi(v, b));
  }
  const double h = v.x[auxiliary_variable() + group];
  return k < count_ ? phi(v, leg(v, group, k)) - h : room() + h - phi(v, leg(v, group, k - count_));
}

void Spread::add_item_gradient(const DesignState& v, Side side, int item, Row out) const {
  if (side == Side::low) {
    add_phi(v, longest(v, item), 1.0, out);
    add_phi(v, shortest(v, item), -1.0, out);
    return;
  }
  const int group = item / each(), k = item % each();
  if (way_ != Way::auxiliary) {
    const auto [a, b] = pair(v, group, k);
    add_phi(v, a, -1.0, out);
    add_phi(v, b, 1.0, out);
    return;
  }
  const double sign = k < count_ ? 1.0 : -1.0;
  add_phi(v, leg(v, group, k % count_), sign, out);
  out[auxiliary_coordinate() + group] -= sign;
}

}  // namespace ninedof
