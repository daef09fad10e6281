#pragma once
/// Forces on a machine at rest, over every number type: what leg forces balance, and what moves the legs. A wrench is
/// both, as the rate of a leg is the power of its unit force.

#include <array>

#include "limits/look.hpp"
#include "ninedof/limits/duty.hpp"

namespace ninedof {

/// A moment about p, a force on the platform, a force on O.
template <class T>
struct Wrench {
  Xyz<T> moment{}, force{}, at_o{};
};
template <class T>
Wrench<T> operator+(const Wrench<T>& a, const Wrench<T>& b) {
  return {a.moment + b.moment, a.force + b.force, a.at_o + b.at_o};
}
template <class T>
Wrench<T> operator*(double k, const Wrench<T>& w) {
  return {k * w.moment, k * w.force, k * w.at_o};
}

template <class T>
T along(const Vec3& v, const Xyz<T>& x) {
  return v.x() * x.x + v.y() * x.y + v.z() * x.z;
}
/// The power of a wrench in a motion (omega, pdot, sdot).
template <class T>
T power_of(const Wrench<T>& w, const Vec9& motion) {
  return along(Vec3(motion.head<3>()), w.moment) + along(Vec3(motion.segment<3>(3)), w.force) +
         along(Vec3(motion.tail<3>()), w.at_o);
}

/// Adds a force at a point of the machine.
template <class Look, class T>
void push(const Look& look, int point, const Xyz<T>& force, Wrench<T>& out) {
  if (point == point_s) out.at_o = out.at_o + force;
  if (point < point_u || point == point_s) return;
  out.force = out.force + force;
  out.moment = out.moment + cross(look.at(point) - look.at(point_p), force);
}

/// A unit force of a leg, that pushes: a row of H, eqs. (24)-(26).
template <class Look, class T = typename Look::Number>
Wrench<T> unit_force(const Look& look, int leg) {
  const LegEnds ends = leg_ends(leg);
  const Xyz<T> e = look.direction(leg);
  Wrench<T> out;
  push(look, ends.to, e, out);
  push(look, ends.from, -1.0 * e, out);
  return out;
}

/// A wrench as nine numbers, its moment times `per_length`.
template <class T>
std::array<T, 9> row_of(const Wrench<T>& w, double per_length) {
  const Xyz<T> m = per_length * w.moment;
  return {m.x, m.y, m.z, w.force.x, w.force.y, w.force.z, w.at_o.x, w.at_o.y, w.at_o.z};
}

/// Of the platform's mass, from p.
template <class Look>
auto centre_of_mass(const Look& look) {
  const Vec3& c = look.duty().masses.centre;
  const auto& q = look.q();
  return c.x() * q[0] + c.y() * q[1] + c.z() * q[2];
}

/// The weights of all masses, for the platform's centre of mass seen from p: inertial_load at rest.
template <class Look, class T = typename Look::Number>
Wrench<T> weights(const Look& look, const Xyz<T>& arm) {
  const Masses& m = look.duty().masses;
  const auto weight = [&](double mass) { return constant<T>(mass * look.duty().gravity); };
  Wrench<T> out{cross(arm, weight(m.platform)), weight(m.platform), weight(m.internal_point)};
  for (int leg = 0; leg < 9; ++leg) {
    if (m.cylinder[leg] == 0.0 && m.rod[leg] == 0.0) continue;
    const LegEnds ends = leg_ends(leg);
    const Xyz<T> e = look.direction(leg), cylinder = weight(m.cylinder[leg]), rod = weight(m.rod[leg]);
    const Xyz<T> both = m.cylinder_centre[leg] * cylinder - m.rod_centre[leg] * rod;
    const T length = dot(e, look.at(ends.to) - look.at(ends.from));
    T per_length;
    if constexpr (requires { inverse(length); }) per_length = inverse(length);
    else per_length = 1.0 / length;
    const Xyz<T> turning = per_length * (both - dot(e, both) * e);
    push(look, ends.from, cylinder - turning, out);
    push(look, ends.to, rod + turning, out);
  }
  return out;
}

/// The rate of a leg as a.pdot + b.omega where the motion of O is that of the platform, or none.
template <class T>
struct RateOf {
  Xyz<T> a, b;
};
template <class T>
RateOf<T> rate_by_rule(const Wrench<T>& unit, InternalMotion internal, const Xyz<T>& arm_of_o) {
  if (internal == InternalMotion::shifted) return {unit.force + unit.at_o, unit.moment};
  if (internal == InternalMotion::carried) return {unit.force + unit.at_o, unit.moment + cross(arm_of_o, unit.at_o)};
  return {unit.force, unit.moment};
}

}  // namespace ninedof
