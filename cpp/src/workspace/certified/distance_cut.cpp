/// Where two legs keep a distance. Declared in workspace/certified/pose_cuts.hpp.

#include <algorithm>
#include <cmath>

#include "workspace/certified/pose_cuts.hpp"

namespace ninedof::certified {
namespace {

Vec3 centre_of(const FormVector& v) {
  return {v.x.c, v.y.c, v.z.c};
}

/// The direction of the shortest connection, from the first leg to the second, as it turns with the pose: across the legs
/// that it meets between their ends. So the distances of all ends along it differ by the square of the box only.
FormVector connection(const FormEnds& one, const FormEnds& two, const Nearest& near) {
  const auto between_ends = [](double part) { return 0.0 < part && part < 1.0; };
  const bool first = between_ends(near.s), second = between_ends(near.t);
  const FormVector u = one.to - one.from, v = two.to - two.from;
  const FormVector from = near.s < 0.5 ? one.from : one.to, to = near.t < 0.5 ? two.from : two.to;
  const auto across = [](const FormVector& w, const FormVector& leg) { return dot(leg, leg) * w - dot(w, leg) * leg; };
  FormVector m;
  if (first && second) m = cross(u, v);
  else if (first) m = across(to - one.from, u);
  else if (second) m = across(two.from - from, v);
  else m = to - from;
  return centre_of(m).dot(near.apart) > 0.0 ? -1.0 * m : m;  // `apart` is from the second to the first
}

FormVector unit_of(const FormVector& m) {
  return inverse_root(dot(m, m)) * m;
}

}  // namespace

DistanceCut distance_cut(const FormEnds& one, const FormEnds& two, double distance) {
  DistanceCut out;
  const Nearest near = nearest(centre_of(one.from), centre_of(one.to), centre_of(two.from), centre_of(two.to));
  const FormVector x = one.from + PoseForm(near.s) * (one.to - one.from),
                   y = two.from + PoseForm(near.t) * (two.to - two.from);
  out.lack = PoseForm::of(square(Interval(distance))) - dot(x - y, x - y);
  const double apart = near.apart.norm();
  if (!(apart > 0.0)) return out;
  FormVector n = unit_of(connection(one, two, near));
  // Legs that are parallel somewhere in the box: a fixed direction of at most unit length.
  if (!is_known(n.x)) n = constant<PoseForm>(near.apart / (-apart * (1.0 + 0x1p-48)));
  // The distance is at least the least of four numbers; each is above a plane of one slope, that of the least of them.
  std::array<PoseForm, 4> spare;
  std::size_t lowest = 0, k = 0;
  for (const FormVector* a : {&one.from, &one.to})
    for (const FormVector* b : {&two.from, &two.to}) {
      spare[k] = dot(n, *b - *a) - PoseForm(distance);
      if (!is_known(spare[k])) return out;
      if (lower(spare[k]) < lower(spare[lowest])) lowest = k;
      ++k;
    }
  if (lower(spare[lowest]) > 0.0) {
    out.everywhere = true;
    return out;
  }
  double level = -std::numeric_limits<double>::infinity();
  for (const PoseForm& one_spare : spare) {
    if (lower(one_spare) > 0.0) continue;
    PoseForm rest = one_spare;
    for (std::size_t i = 0; i < 3; ++i) {
      out.slope[i] = spare[lowest].a[i];
      rest.a[i] -= out.slope[i];
      rest.r += 0x1p-52 * std::abs(rest.a[i]);
    }
    level = std::max(level, -lower(rest));
  }
  out.allowed = ninedof::detail::above(level);
  return out;
}

}  // namespace ninedof::certified
