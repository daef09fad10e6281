#include "problem/constraints/constraint.hpp"

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
  return form() == Form::plain ? limit_.low : 1.0;
}

double Constraint::item_margin(const DesignState& v, Side side, int item) const {
  const double now = value(v, side, item), limit = bound(side), sign = side == Side::high ? 1.0 : -1.0;
  switch (form()) {
    case Form::logarithm: return sign * std::log(limit / now);
    case Form::linear: return sign * (1.0 - now / limit);
    case Form::plain: return now - limit;
  }
  return 0.0;
}

double Constraint::value_at(Side side, double margin) const {
  const double away = side == Side::high ? -margin : margin;
  switch (form()) {
    case Form::logarithm: return bound(side) * std::exp(away);
    case Form::linear: return bound(side) * (1.0 + away);
    case Form::plain: return bound(side) + margin;
  }
  return 0.0;
}

void Constraint::add_item_gradient(const DesignState& v, Side side, int item, Row out) const {
  const double now = value(v, side, item), limit = bound(side), sign = side == Side::high ? 1.0 : -1.0;
  switch (form()) {
    case Form::logarithm:
      if (now > 0.0) add_value_gradient(v, side, item, -sign / now, out);
      return;
    case Form::linear: return add_value_gradient(v, side, item, -sign / limit, out);
    case Form::plain: return add_value_gradient(v, side, item, 1.0, out);
  }
}

double Constraint::unit(const DesignState& v, int body) const {
  switch (limit_.of) {
    case Unit::length: return 1.0;
    case Unit::zp: return v.blueprint.zp;
    case Unit::radius: return joint_radius(v, widest_joint(v, body));
  }
  return 1.0;
}

void Constraint::add_unit_gradient(const DesignState& v, double scale, Row out, int body) const {
  if (limit_.of == Unit::zp) v.add_zp(scale, out);
  if (limit_.of == Unit::radius) add_joint_radius(v, widest_joint(v, body), scale, out);
}

double joint_radius(const DesignState& v, int joint) {
  return v.blueprint.joint[at_index(joint)].head<2>().norm();
}

int widest_joint(const DesignState& v, int body) {
  const int begin = body < 0 ? 0 : body, end = body < 0 ? 12 : body + 6;
  int widest = begin;
  double most = -1.0;
  for (int k = begin; k < end; ++k) {
    const double squared = v.blueprint.joint[at_index(k)].head<2>().squaredNorm();
    if (squared <= most) continue;
    most = squared;
    widest = k;
  }
  return widest;
}

void add_joint_radius(const DesignState& v, int joint, double scale, Row out) {
  const Vec3& at = v.blueprint.joint[at_index(joint)];
  const double radius = at.head<2>().norm();
  if (radius > 0.0) v.add_joint(joint, scale * Vec3(at.x() / radius, at.y() / radius, 0.0), out);
}

}  // namespace ninedof
