#include "problem/constraints/constraint.hpp"

#include <algorithm>
#include <cmath>

namespace ninedof {

ShownMargin share_of_limit(Side side, double logarithm) {
  const double sign = side == Side::high ? -1.0 : 1.0;
  return {sign * std::expm1(sign * logarithm), std::exp(sign * logarithm)};
}

std::pair<Side, int> Constraint::item_of(int row) const {
  const int high = has_high() ? items(Side::high) : 0;
  if (row < high) return {Side::high, row};
  return {Side::low, row - high};
}

double Constraint::margin(const DesignState& v, int row) const {
  const auto [side, item] = item_of(row);
  return item_margin(v, side, item);
}

void Constraint::add_gradient(const DesignState& v, int row, Row out) const {
  const auto [side, item] = item_of(row);
  add_item_gradient(v, side, item, out);
}

double Constraint::price_factor(int) const {
  return form() == SolverMargin::plain ? limit_.low : 1.0;
}

double Constraint::item_margin(const DesignState& v, Side side, int item) const {
  return margin_of(side, value(v, side, item));
}

double Constraint::margin_of(Side side, double now) const {
  const double limit = bound(side), sign = side == Side::high ? 1.0 : -1.0;
  switch (form()) {
    case SolverMargin::logarithm: return sign * std::log(limit / now);
    case SolverMargin::linear: return sign * (1.0 - now / limit);
    case SolverMargin::plain: return now - limit;
    case SolverMargin::mixed: return now > limit ? std::log(limit / now) : 1.0 - now / limit;
  }
  return 0.0;
}

double Constraint::value_at(Side side, double margin) const {
  const double away = side == Side::high ? -margin : margin;
  switch (form()) {
    case SolverMargin::logarithm: return bound(side) * std::exp(away);
    case SolverMargin::linear: return bound(side) * (1.0 + away);
    case SolverMargin::plain: return bound(side) + margin;
    case SolverMargin::mixed: return bound(side) * (margin < 0.0 ? std::exp(-margin) : 1.0 - margin);
  }
  return 0.0;
}

double Constraint::margin_slope(Side side, double now) const {
  const double limit = bound(side), sign = side == Side::high ? 1.0 : -1.0;
  switch (form()) {
    case SolverMargin::logarithm: return now > 0.0 ? -sign / now : 0.0;
    case SolverMargin::linear: return -sign / limit;
    case SolverMargin::plain: return 1.0;
    case SolverMargin::mixed: return -1.0 / std::max(now, limit);
  }
  return 0.0;
}

void Constraint::add_item_gradient(const DesignState& v, Side side, int item, Row out) const {
  const double slope = margin_slope(side, value(v, side, item));
  if (slope != 0.0) add_value_gradient(v, side, item, slope, out);
}

double Constraint::unit(const DesignState& v, int body) const {
  switch (limit_.of) {
    case Unit::length: return 1.0;
    case Unit::zp: return v.blueprint.zp;
    case Unit::radius: return v.blueprint.joint[at_index(widest_joint(v.blueprint.joint, body))].head<2>().norm();
  }
  return 1.0;
}

void Constraint::add_unit_gradient(const DesignState& v, double scale, Row out, int body) const {
  if (limit_.of == Unit::zp) v.add_zp(scale, out);
  if (limit_.of != Unit::radius) return;
  const int joint = widest_joint(v.blueprint.joint, body);
  const Vec3& at = v.blueprint.joint[at_index(joint)];
  const double radius = unit(v, body);
  if (radius > 0.0) v.add_joint(joint, scale * Vec3(at.x() / radius, at.y() / radius, 0.0), out);
}

std::unique_ptr<Constraint> make_constraint(const Limit& limit, int poses, Purpose purpose,
                                            const std::array<bool, leg_pairs>& exempt) {
  const LimitRow& row = limit_row(limit.name);
  const int where = limit.at == LimitAt::neutral ? 0 : poses;
  return row.pose != nullptr     ? make_pose_limit(limit, row, where, exempt)
         : row.design != nullptr ? make_design_limit(limit, row)
                                 : make_spread(limit, row, where, purpose);
}

}  // namespace ninedof
