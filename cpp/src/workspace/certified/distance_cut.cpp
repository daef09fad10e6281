/// Where two legs keep a distance. Declared in workspace/certified/pose_cuts.hpp.

#include <algorithm>
#include <cmath>

#include "workspace/certified/pose_cuts.hpp"

namespace ninedof::certified {
namespace {

using over_region::Ends;

Vec3 centre_of(const Vector& v) {
  return {v.x.c, v.y.c, v.z.c};
}

/// The direction of the shortest connection, from the first leg to the second, as it turns with the pose: across the legs
/// that it meets between their ends. So the distances of all ends along it differ by the square of the box only.
Vector connection(const Ends& one, const Ends& two, const Nearest& near) {
  const auto between_ends = [](double part) { return 0.0 < part && part < 1.0; };
  const bool first = between_ends(near.s), second = between_ends(near.t);
  const Vector u = one.to - one.from, v = two.to - two.from;
  const Vector from = near.s < 0.5 ? one.from : one.to, to = near.t < 0.5 ? two.from : two.to;
  const auto across = [](const Vector& w, const Vector& leg) { return dot(leg, leg) * w - dot(w, leg) * leg; };
  Vector m;
  if (first && second) m = cross(u, v);
  else if (first) m = across(to - one.from, u);
  else if (second) m = across(two.from - from, v);
  else m = to - from;
  return centre_of(m).dot(near.apart) > 0.0 ? -1.0 * m : m;  // `apart` is from the second to the first
}

Vector unit_of(const Vector& m) {
  return over_region::inverse_root(dot(m, m)) * m;
}

bool known(const Form& x) {
  return std::isfinite(over_region::radius(x)) && std::isfinite(x.c);
}

}  // namespace

DistanceCut distance_cut(const Ends& one, const Ends& two, double distance) {
  DistanceCut out;
  const Nearest near = nearest(centre_of(one.from), centre_of(one.to), centre_of(two.from), centre_of(two.to));
  const Vector x = one.from + Form(near.s) * (one.to - one.from), y = two.from + Form(near.t) * (two.to - two.from);
  out.lack = Form::of(square(Interval(distance))) - dot(x - y, x - y);
  const double apart = near.apart.norm();
  if (!(apart > 0.0)) return out;
  Vector n = unit_of(connection(one, two, near));
  // Legs that are parallel somewhere in the box: a fixed direction of at most unit length.
  if (!known(n.x)) n = over_region::fixed(near.apart / (-apart * (1.0 + 0x1p-48)));
  // The distance is at least the least of four numbers; each is above a plane of one slope, that of the least of them.
  std::array<Form, 4> spare;
  std::size_t lowest = 0, k = 0;
  for (const Vector* a : {&one.from, &one.to})
    for (const Vector* b : {&two.from, &two.to}) {
      spare[k] = dot(n, *b - *a) - Form(distance);
      if (!known(spare[k])) return out;
      if (lower(spare[k]) < lower(spare[lowest])) lowest = k;
      ++k;
    }
  if (lower(spare[lowest]) > 0.0) {
    out.everywhere = true;
    return out;
  }
  double level = -std::numeric_limits<double>::infinity();
  for (const Form& one_spare : spare) {
    if (lower(one_spare) > 0.0) continue;
    Form rest = one_spare;
    for (std::size_t i = 0; i < 3; ++i) {
      out.slope[i] = spare[lowest].a[i];
      rest.a[i] -= out.slope[i];
      rest.r += 0x1p-52 * std::abs(rest.a[i]);
    }
    level = std::max(level, -over_region::lower(rest));
  }
  out.allowed = ninedof::detail::above(level);
  return out;
}

}  // namespace ninedof::certified
