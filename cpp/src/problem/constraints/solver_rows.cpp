#include "problem/constraints/solver_rows.hpp"

#include <algorithm>
#include <cmath>

namespace ninedof {

std::pair<Side, int> SolverRows::item_of(int row) const {
  const int high = has_high() ? items(Side::high) : 0;
  if (row < high) return {Side::high, row};
  return {Side::low, row - high};
}

double SolverRows::margin(const DesignState& v, int row) const {
  const auto [side, item] = item_of(row);
  return item_margin(v, side, item);
}

void SolverRows::add_gradient(const DesignState& v, int row, Row out) const {
  const auto [side, item] = item_of(row);
  add_item_gradient(v, side, item, out);
}

double SolverRows::price_factor(int) const {
  return form_ == SolverMargin::plain ? limit_.low : 1.0;
}

void SolverRows::add_item_gradient(const DesignState& v, Side side, int item, Row out) const {
  const double slope = margin_slope(side, value(v, side, item));
  if (slope != 0.0) add_value_gradient(v, side, item, slope, out);
}

double SolverRows::unit(const DesignState& v, int body) const {
  switch (limit_.of) {
    case Unit::length: return 1.0;
    case Unit::zp: return v.blueprint.zp;
    case Unit::radius: return v.blueprint.joint[at_index(widest_joint(v.blueprint.joint, body))].head<2>().norm();
  }
  return 1.0;
}

void SolverRows::add_unit_gradient(const DesignState& v, double scale, Row out, int body) const {
  if (limit_.of == Unit::zp) v.add_zp(scale, out);
  if (limit_.of != Unit::radius) return;
  const int joint = widest_joint(v.blueprint.joint, body);
  const Vec3& at = v.blueprint.joint[at_index(joint)];
  const double radius = unit(v, body);
  if (radius > 0.0) v.add_joint(joint, scale * Vec3(at.x() / radius, at.y() / radius, 0.0), out);
}

std::unique_ptr<SolverRows> make_solver_rows(const Limit& limit, int poses, Purpose purpose,
                                             const std::array<bool, leg_pairs>& exempt) {
  const LimitRow& row = limit_row(limit.name);
  const int where = limit.at == LimitAt::neutral ? 0 : poses;
  return row.pose != nullptr     ? make_pose_limit(limit, row, where, exempt)
         : row.design != nullptr ? make_design_limit(limit, row)
                                 : make_spread(limit, row, where, purpose);
}

}  // namespace ninedof
