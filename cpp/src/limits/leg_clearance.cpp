/// leg_clearance: distance of the axes of every two legs that can be apart. The internal legs all end in O, so that one
/// of every two is external. Pairs whose joints coincide are exempt; which those are is for whoever looks.

#include "limits/leg_clearance.hpp"

#include <cmath>

#include "limits/rows.hpp"

namespace ninedof {
namespace {

struct LegClearances {
  static constexpr int items = leg_pairs;
  static constexpr bool at_home = false, pairs = true;
  static constexpr double width = 0.03;

  static std::string part(int item) {
    const auto [a, b] = leg_pair(item);
    return std::string(leg_name(a)) + "-" + leg_name(b);
  }
  static std::array<int, 4> touched(int item) {
    const auto [a, b] = leg_pair(item);
    const LegEnds one = leg_ends(a), two = leg_ends(b);
    return {one.from, one.to, two.from, two.to};
  }
  static double slopes(const PointLook& look, int item, PointSlopes& out) {
    return slopes_of<LegClearances, 4>(look, item, touched(item), out);
  }
  /// The squared distance with the nearest points held on their legs, which has the slopes of the squared distance.
  template <class Look>
  static auto u(const Look& look, int item) {
    const auto [a, b] = leg_pair(item);
    const Nearest near = nearest(look.here().at, item);
    const auto apart = look.on_leg(a, near.s) - look.on_leg(b, near.t);
    return dot(apart, apart);
  }
  static double number(const PointLook& look, int item) { return nearest(look.here().at, item).apart.norm(); }
  static double number_of(double squared, const PointLook&, int) { return std::sqrt(squared); }
  static double slope(double distance) { return distance > 0.0 ? 0.5 / distance : 0.0; }
};

}  // namespace

template <class T, class Robot>
LegPairOf<T> leg_pair_forms(const FormLookOf<T, Robot>& look, int pair) {
  const auto [a, b] = leg_pair(pair);
  const Ends<T> one = look.ends(a), two = look.ends(b);
  return {one, two, nearest(centre(one.from), centre(one.to), centre(two.from), centre(two.to))};
}

template <class T>
T squared_distance_above(const LegPairOf<T>& legs) {
  const Xyz<T> x = legs.one.from + T(legs.middle.s) * (legs.one.to - legs.one.from),
               y = legs.two.from + T(legs.middle.t) * (legs.two.to - legs.two.from);
  return dot(x - y, x - y);
}

template <class T>
Xyz<T> fixed_direction(const LegPairOf<T>& legs) {
  const double distance = legs.middle.apart.norm();
  if (!(distance > 0.0)) return {T::unknown(), T::unknown(), T::unknown()};
  return constant<T>(legs.middle.apart / (-distance * (1.0 + 0x1p-48)));
}

/// Across the legs that the shortest connection meets between their ends.
template <class T>
Xyz<T> turning_direction(const LegPairOf<T>& legs) {
  const auto between_ends = [](double part) { return 0.0 < part && part < 1.0; };
  const auto& [one, two, near] = legs;
  const bool first = between_ends(near.s), second = between_ends(near.t);
  const Xyz<T> u = one.to - one.from, v = two.to - two.from;
  const Xyz<T> from = near.s < 0.5 ? one.from : one.to, to = near.t < 0.5 ? two.from : two.to;
  const auto across = [](const Xyz<T>& w, const Xyz<T>& leg) { return dot(leg, leg) * w - dot(w, leg) * leg; };
  Xyz<T> m;
  if (first && second) m = cross(u, v);
  else if (first) m = across(to - one.from, u);
  else if (second) m = across(two.from - from, v);
  else m = to - from;
  return unit(centre(m).dot(near.apart) > 0.0 ? -1.0 * m : m);  // `apart` is from the second to the first
}

template <class T>
EndDistancesOf<T> end_distances(const LegPairOf<T>& legs, const Xyz<T>& direction) {
  EndDistancesOf<T> out;
  std::size_t k = 0;
  for (const Xyz<T>* a : {&legs.one.from, &legs.one.to})
    for (const Xyz<T>* b : {&legs.two.from, &legs.two.to}) {
      out.between[k] = *b - *a;
      out.along[k] = dot(direction, out.between[k]);
      ++k;
    }
  return out;
}

template LegPairOf<PoseForm> leg_pair_forms(const FormLook&, int);
template PoseForm squared_distance_above(const LegPairOf<PoseForm>&);
template Xyz<PoseForm> fixed_direction(const LegPairOf<PoseForm>&);
template Xyz<PoseForm> turning_direction(const LegPairOf<PoseForm>&);
template EndDistancesOf<PoseForm> end_distances(const LegPairOf<PoseForm>&, const Xyz<PoseForm>&);
template LegPairOf<DesignForm> leg_pair_forms(const DesignLook&, int);
template DesignForm squared_distance_above(const LegPairOf<DesignForm>&);
template Xyz<DesignForm> fixed_direction(const LegPairOf<DesignForm>&);
template Xyz<DesignForm> turning_direction(const LegPairOf<DesignForm>&);
template EndDistancesOf<DesignForm> end_distances(const LegPairOf<DesignForm>&, const Xyz<DesignForm>&);

constinit const PoseRow leg_clearance_row = pose_row_of<LegClearances>();

}  // namespace ninedof
