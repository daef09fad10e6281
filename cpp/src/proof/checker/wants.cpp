#include "proof/checker/wants.hpp"

#include <cmath>
#include <optional>

namespace ninedof::checker::sets {
namespace {

using About = Want::About;

/// The legs of a limit of lengths or angles, first and count; a base's internal legs are 6 to 8.
struct Legs {
  About about;
  bool platform;
  int first, count;
};
std::optional<Legs> legs_of(const std::string& name) {
  const bool platform = name.starts_with("platform_");
  for (int leg = 0; leg < 9; ++leg)
    if (name == name_of_leg(leg)) return Legs{About::length, false, leg, 1};
  if (name == "leg_length") return Legs{About::length, false, 0, 9};
  if (name == "external_length") return Legs{About::length, false, 0, 3};
  if (name == "upper_length") return Legs{About::length, false, 3, 3};
  if (name == "lower_length") return Legs{About::length, false, 6, 3};
  if (name == "base_cone" || name == "platform_cone") return Legs{About::cone, platform, 0, 6};
  if (name == "base_cone_external" || name == "platform_cone_external") return Legs{About::cone, platform, 0, 3};
  if (name == "base_cone_internal" || name == "platform_cone_internal") return Legs{About::cone, platform, 3, 3};
  return std::nullopt;
}

Linear squared(const Linear& x) {
  return x * x;
}
Linear from_z(const Arrow& joint) {
  return square_root(squared(joint.x) + squared(joint.y));
}
double largest(double x, double y) {
  return x > y ? x : y;
}

}  // namespace

std::vector<Want> wants_of(const DesignsFile& file, std::vector<std::string>& unknown) {
  std::vector<Want> out;
  const bool one_robot = file.space.present();
  const auto add_regular = [&] {
    for (int k = 0; k < 3; ++k) out.push_back({About::determinant, 0, k});
  };
  if (!one_robot) {
    add_regular();
    for (int k = 0; k < 2; ++k) out.push_back({About::height, 1, k});
  }
  for (int n = 0; n < static_cast<int>(file.limits.size()); ++n) {
    const LimitLine& one = file.limits[static_cast<std::size_t>(n)];
    const auto legs = legs_of(one.name);
    const bool of_zp = one.name == "leg_clearance" || one.name == "stroke" || (legs && legs->about == About::length);
    bool known =
        (one.of == "length" || (one.of == "zp" && of_zp) || (one.of == "radius" && one.name.starts_with("joint_"))) &&
        (one.axis == Triple{} || (legs && legs->about == About::cone));
    if (one_robot && one.name == "singularity_free") add_regular();
    for (const bool high : {false, true}) {
      const double bound = high ? one.range.b : one.range.a;
      if (!(bound > 0.0) || !(bound < inf)) continue;
      const auto add = [&](About about, int count, bool platform = false, int first = 0) {
        for (int k = first; k < first + count; ++k) out.push_back({about, n + 2, k, k, high, platform});
      };
      if (legs) {
        add(legs->about, legs->count, legs->platform, legs->first);
        known = known && (legs->about == About::length || high);
      } else if (one.name == "leg_clearance" && !high) {
        for (int k = 0; k < 21; ++k)
          if (std::ranges::find(file.exempt, k) == file.exempt.end()) out.push_back({About::pair, n + 2, k, k, false});
      } else if (one.name == "singularity_free" && !high) add(About::determinant, 3);
      else if ((one.name == "stroke" || one.name == "stroke_ratio") && high) add(About::spread, 9);
      else if (one.name == "leg_ratio" && high) {
        for (int k = 0; k < 81; ++k) out.push_back({About::spread, n + 2, k / 9, k % 9});
      } else if (one.name == "condition_number" && high) add(About::condition, 1);
      else if (one.name == "fault_tolerant" && high) {
        for (int leg = 3; leg < 9; ++leg) out.push_back({About::condition, n + 2, 0, leg});
      } else if (duties_of(one.name).count > 0 && high) add(About::duty, 1);
      else if (one.name == "height" || one.name == "zs_fraction" || one.name == "footprint" ||
               one.name == "radius_ratio" || (one.name == "joint_height" && high) ||
               (one.name == "joint_spacing" && !high)) {
        add(About::design, 1);
      } else known = false;
    }
    if (!known) unknown.push_back(one.name);
  }
  return out;
}

Weigher::Weigher(const DesignsFile& file, const Cube& designs) : file_(file), mount_(mount(file, designs)) {
  for (int k = 0; k < 3; ++k) {
    const auto n = static_cast<std::size_t>(k);
    side_[n] = 1.0;
    const Linear at_home = determinant({mount_, mount_.home}, k, false);
    if (at_home.c < 0.0) side_[n] = -1.0;
    side_of_all_[n] = lower_end(side_[n] * at_home) > 0.0;
  }
}

void Weigher::take(const Linear& x, const Patch& patch, Weighed& out) const {
  out.low = least_over(file_, x, patch);
  out.high = upper_end(x);
}

namespace {

void add_moves(const Arrow& v, bool other, Weighed& out) {
  for (std::size_t k = 0; k < symbols; ++k) {
    const double most = largest(std::abs(v.x.a[k]), largest(std::abs(v.y.a[k]), std::abs(v.z.a[k])));
    double& place = out.moves[other && k < pose_symbols ? symbols + k : k];
    place = largest(place, most);
  }
}

}  // namespace

/// det N of the moments of the external legs about O, det B and det C of the lower and the upper legs.
Linear Weigher::determinant(const Posed& at, int which, bool of_units) const {
  std::array<Arrow, 3> row;
  for (int k = 0; k < 3; ++k) {
    const LegLine leg = at.leg((which == 0 ? 0 : which == 1 ? 6 : 3) + k);
    Arrow& v = row[static_cast<std::size_t>(k)];
    if (which > 0) {
      v = of_units ? unit(leg.along()) : leg.along();
    } else {
      const Arrow from = leg.from - at.stand.s, to = leg.to - at.stand.s;
      v = of_units ? cross(unit(from), unit(to)) : cross(from, to);
    }
  }
  return side_[static_cast<std::size_t>(which)] * dot(row[0], cross(row[1], row[2]));
}

Linear Weigher::number(const Want& want, const Posed& at, Weighed& out) const {
  if (want.about == About::determinant) {
    const int first = want.item == 0 ? 0 : want.item == 1 ? 6 : 3;
    for (int k = 0; k < 3; ++k) add_moves(at.leg(first + k).along(), false, out);
    if (want.item == 0)
      for (int k = 0; k < 3; ++k) add_moves(at.leg(k).from - at.stand.s, false, out);
    const Linear value = determinant(at, want.item, want.limit > 0);
    return want.limit == 0 ? value : value - bound(want);
  }
  if (want.about == About::height) return want.item == 0 ? mount_.zp - mount_.zs : mount_.zs;
  const int leg = want.about == About::cone && !want.platform && want.item > 2 ? want.item + 3 : want.item;
  const LegLine ends = at.leg(leg);
  const Arrow v = ends.along();
  add_moves(v, false, out);
  if (want.about == About::length) {
    const Linear margin = squared(in_unit(want)) - dot(v, v);
    return want.high ? margin : -margin;
  }
  // The cosine of the angle from the axis, which stands in the frame of its body.
  const double sense = want.platform && want.item < 3 ? -1.0 : 1.0;
  Arrow axis;
  if (const Triple& given = line(want).axis; given != Triple{}) {
    axis = unit({given[0], given[1], given[2]});
  } else {
    axis = Linear(sense) * unit(leg_line(mount_, mount_.home, leg).along());
    if (want.platform) axis = {dot(mount_.home.q[0], axis), dot(mount_.home.q[1], axis), dot(mount_.home.q[2], axis)};
  }
  if (want.platform) axis = carried(at.stand, axis);
  add_moves(square_root(dot(v, v)) * axis, false, out);
  return dot(Linear(sense) * unit(v), axis) - cosine(bound(want));
}

namespace {

/// Two legs where their middles are nearest: the way from one to the other, and a direction across what is near.
struct NearLegs {
  LegLine one, two;
  Arrow apart, across;
};
NearLegs near_legs(const LegLine& one, const LegLine& two) {
  const Arrow u = one.along(), v = two.along(), w = two.from - one.from;
  // By turns along one and the other, which comes near enough.
  const double uu = dot(u, u).c, vv = dot(v, v).c, uv = dot(u, v).c, uw = dot(u, w).c, vw = dot(v, w).c;
  const auto part = [](double x) { return x > 0.0 ? std::min(x, 1.0) : 0.0; };
  const double across = uu * vv - uv * uv;
  double s = part((uw * vv - uv * vw) / across), t = part((uv * s - vw) / vv);
  s = part((uw + uv * t) / uu);
  t = part((uv * s - vw) / vv);
  NearLegs out{one, two, w + Linear(t) * v - Linear(s) * u, {}};
  const bool within_one = s > 0.0 && s < 1.0, within_two = t > 0.0 && t < 1.0;
  const Arrow between = (t > 0.5 ? two.to : two.from) - (s > 0.5 ? one.to : one.from);
  const auto across_leg = [&](const Arrow& leg) { return dot(leg, leg) * between - dot(leg, between) * leg; };
  out.across = between;
  if (within_one && within_two) out.across = cross(u, v);
  else if (within_one) out.across = across_leg(u);
  else if (within_two) out.across = across_leg(v);
  if (dot(out.across, out.apart).c < 0.0) out.across = Linear(-1.0) * out.across;
  return out;
}
/// The legs are at least the least of four products along a unit vector apart: those with the ways from the ends of one
/// to the ends of the other.
std::array<Linear, 4> products_along(const Arrow& unit, const NearLegs& legs) {
  const LegLine &one = legs.one, &two = legs.two;
  return {dot(unit, two.from - one.from), dot(unit, two.to - one.from), dot(unit, two.from - one.to),
          dot(unit, two.to - one.to)};
}
Arrow fixed_direction(const NearLegs& legs) {
  const Arrow& v = legs.apart;
  const double size = std::sqrt(dot(v, v).c) * grain::up;
  return {v.x.c / size, v.y.c / size, v.z.c / size};
}

/// A number below all of these, with the slopes of the least.
Linear below_all(const std::array<Linear, 4>& all) {
  Linear slopes = all[0];
  for (const Linear& x : all)
    if (!(lower_end(x) >= lower_end(slopes))) slopes = x;
  slopes.c = slopes.r = 0.0;
  double rest = inf;
  for (const Linear& x : all)
    if (const double low = lower_end(x - slopes); !std::isnan(rest) && !(low >= rest)) rest = low;  // NaN stays
  return slopes + Linear(rest);
}

/// The range of the squared length is exact up to rounding: each coordinate depends on one symbol.
int length_within(const Arrow& v, double bound, bool high) {
  Range sum;
  for (const Linear& x : {v.x, v.y, v.z}) sum = sum + square(Range(lower_end(x), upper_end(x)));
  const Range margin = high ? square(Range(bound)) - sum : sum - square(Range(bound));
  return margin.a > 0.0 ? 1 : margin.b < 0.0 ? -1 : 0;
}

}  // namespace

/// They are at most as far apart as two points of them.
void Weigher::pair(const Want& want, const Posed& at, const Patch& patch, Weighed& out) const {
  const auto [a, b] = legs_of_pair(want.item);
  const NearLegs legs = near_legs(at.leg(a), at.leg(b));
  for (const Arrow& v : {legs.one.along(), legs.two.along(), legs.two.from - legs.one.from}) add_moves(v, false, out);
  const Linear distance = in_unit(want);
  const auto least_along = [&](const Arrow& direction) {
    double least = inf;
    for (const Linear& x : products_along(direction, legs))
      least = std::min(least, least_over(file_, x - distance, patch));
    return least;
  };
  out.low = least_along(unit(legs.across));
  if (!(out.low > 0.0)) {
    const double fixed = least_along(fixed_direction(legs));
    if (!(out.low > fixed)) out.low = fixed;
  }
  out.high = upper_end(dot(legs.apart, legs.apart) - squared(distance));
}

/// The designs count once: their slopes in both lengths are taken together.
void Weigher::spread(const Want& want, const Spot& spot, Weighed& out) const {
  const Posed far{mount_, stand(file_, mount_, spot.at)}, near{mount_, stand(file_, mount_, spot.other)};
  const Arrow v = far.leg(want.item).along(), w = near.leg(want.second).along();
  add_moves(v, false, out);
  add_moves(w, true, out);
  const bool ratio = line(want).name != "stroke";
  const Linear longest = -square_root(dot(v, v));
  const Linear shortest = square_root(dot(w, w));
  Linear room = ratio ? bound(want) * shortest : shortest + in_unit(want);
  Linear of_poses = room;  // its slopes along poses, which are not those of the first length
  std::fill(of_poses.a.begin() + pose_symbols, of_poses.a.end(), 0.0);
  of_poses.c = of_poses.r = 0.0;
  std::fill(room.a.begin(), room.a.begin() + pose_symbols, 0.0);
  const Linear sum = room + longest;
  out.low = least_over(file_, sum, spot.at) + least_over(file_, of_poses, spot.other);
  out.low -= grain::of_product * std::abs(out.low);
  out.high = (upper_end(sum) + upper_end(of_poses)) + grain::of_product * std::abs(sum.c);
}

void Weigher::duty(const Want& want, const Posed& at, const Patch& patch, Weighed& out) const {
  for (int leg = 0; leg < 9; ++leg) add_moves(at.leg(leg).along(), false, out);
  out.low = out.high = inf;
  for (const Linear& x : leg_duties(file_.duty, mount_, at.stand, duties_of(line(want).name)))
    for (const Linear& room : {bound(want) - x, bound(want) + x}) {
      out.low = std::min(out.low, least_over(file_, room, patch));
      out.high = std::min(out.high, upper_end(room));  // what is not known does not count
    }
}

/// Of every pose and of some joint: numbers of the design alone. `low` is that of what has to hold for all, and the
/// best of what has to hold for one.
void Weigher::design(const Want& want, Weighed& out) const {
  const std::string& name = line(want).name;
  const double sign = want.high ? 1.0 : -1.0;
  const auto below = [&](const Linear& limit, const Linear& x) { return sign * (limit - x); };
  std::vector<std::vector<Linear>> all;  // for all of these there has to be one that is positive
  std::array<Linear, 12> radius;
  for (std::size_t k = 0; k < 12; ++k) radius[k] = from_z(mount_.plate[k]);
  const auto some = [&](std::size_t first, const auto& of) {
    std::vector<Linear> one;
    for (std::size_t k = first; k < first + 6; ++k) one.push_back(of(k));
    return one;
  };
  const auto each = [&](const std::vector<Linear>& list) {
    for (const Linear& x : list) all.push_back({x});
  };
  if (name == "height") each({below(in_unit(want), mount_.zp)});
  else if (name == "zs_fraction") each({below(bound(want) * mount_.zp, mount_.zs)});
  else if (name == "footprint") {
    const auto list = some(0, [&](std::size_t k) { return below(bound(want), radius[k]); });
    if (want.high) each(list);
    else all.push_back(list);
  } else if (name == "radius_ratio") {
    for (std::size_t i = 0; i < 6; ++i)
      all.push_back(want.high ? some(6, [&](std::size_t k) { return bound(want) * radius[k] - radius[i]; })
                              : some(0, [&](std::size_t k) { return radius[k] - bound(want) * radius[6 + i]; }));
  } else {
    const bool of_radius = line(want).of == "radius", spacing = name == "joint_spacing";
    for (std::size_t i = 0; i < 12; ++i) {
      const std::size_t body = i - i % 6;
      const auto limit = [&](std::size_t k) { return of_radius ? bound(want) * radius[k] : Linear(bound(want)); };
      if (!spacing) {
        for (const double way : {1.0, -1.0}) {
          std::vector<Linear> any;  // of the joint that is farthest from z, of both bodies
          for (std::size_t k = 0; k < (of_radius ? 12U : 1U); ++k) any.push_back(limit(k) - way * mount_.plate[i].z);
          all.push_back(any);
        }
        continue;
      }
      for (std::size_t j = body; j < i; ++j) {
        const Arrow apart = mount_.plate[i] - mount_.plate[j];
        each(some(body, [&](std::size_t k) { return dot(apart, apart) - squared(limit(k)); }));
      }
    }
  }
  out.low = out.high = inf;
  for (const std::vector<Linear>& any : all) {
    double low = -inf, high = -inf;
    for (const Linear& x : any) {
      if (const double end = lower_end(x); end > low) low = end;
      if (const double end = upper_end(x); !(end <= high)) high = std::isnan(end) ? inf : end;
    }
    out.low = std::min(out.low, low);
    out.high = std::min(out.high, high);
  }
  for (const Arrow& joint : mount_.plate) add_moves(joint, false, out);
  add_moves({mount_.zp, mount_.zs, 0.0}, false, out);
}

Weighed Weigher::weigh(const Want& want, const Spot& spot) const {
  Weighed out;
  if (want.about == About::spread) spread(want, spot, out);
  else if (want.about == About::design) design(want, out);
  else {
    const Posed at{mount_, stand(file_, mount_, spot.at)};
    if (want.about == About::pair) pair(want, at, spot.at, out);
    else if (want.about == About::duty) duty(want, at, spot.at, out);
    else if (want.about == About::condition) {
      for (int leg = 0; leg < 9; ++leg) add_moves(at.leg(leg).along(), false, out);
      const int found =
          condition_within(mount_, at.stand, file_.length, bound(want), want.second > 0 ? want.second : -1);
      out.low = found;
      out.high = found;
      if (found == 0) out.low = -1.0, out.high = 1.0;
    } else {
      take(number(want, at, out), spot.at, out);
      if (want.about == About::determinant && !side_of_all_[static_cast<std::size_t>(want.item)]) out.high = inf;
    }
  }
  return out;
}

Sides Weigher::sides(const Want& want, const Patch& patch) const {
  const Posed at{mount_, stand(file_, mount_, patch)};
  if (want.about == About::condition)
    return condition_sides(mount_, at.stand, file_.length, bound(want), want.second > 0 ? want.second : -1);
  if (want.about == About::pair) {
    const auto [a, b] = legs_of_pair(want.item);
    const NearLegs legs = near_legs(at.leg(a), at.leg(b));
    const Linear distance = in_unit(want);
    Linear turning = below_all(products_along(unit(legs.across), legs)) - distance;
    const Linear held = below_all(products_along(fixed_direction(legs), legs)) - distance;
    if (!(lower_end(turning) > lower_end(held))) turning = held;
    return {{turning}, {dot(legs.apart, legs.apart) - squared(distance)}};
  }
  if (want.about == About::duty) {
    std::vector<Linear> all;
    for (const Linear& x : leg_duties(file_.duty, mount_, at.stand, duties_of(line(want).name)))
      for (const Linear& room : {bound(want) - x, bound(want) + x}) all.push_back(room);
    return {all, all};
  }
  if (want.about == About::length)
    if (const int known = length_within(at.leg(want.item).along(), bound(want), want.high); known != 0)
      return {{Linear(known)}, {Linear(known)}};
  if (want.about == About::determinant && !side_of_all_[static_cast<std::size_t>(want.item)])
    refuse("rounding cannot tell home from a singular configuration");
  Weighed unused;
  const Linear x = number(want, at, unused);
  return {{x}, {x}};
}

}  // namespace ninedof::checker::sets
