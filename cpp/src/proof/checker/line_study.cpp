/// The bounds of a study of non-planar designs. Declared in proof/checker/lines.hpp.

#include "proof/checker/designs_file.hpp"
#include "proof/checker/lines.hpp"

namespace ninedof::checker::lines {
namespace {

void read_limit(const Bound& limit, double length, Study& out) {
  const auto& [name, range, of] = limit;
  const bool plain = of.empty();
  const Range low_high{range.a > 0.0 ? range.a : -inf, range.b}, lengths = plain ? low_high / length : low_high;
  const std::array legs{"external_length", "upper_length", "lower_length"};
  if (of == "zp" ? !name.ends_with("_length") : of == "radius" ? name != "joint_height" : !plain)
    refuse("the limit " + name + " has no unit " + quoted(of));
  if (out.take(limit)) return;
  if (name == "height") out.zp = meet(out.zp, lengths);
  else if (name == "footprint") {
    for (const std::size_t k : {0, 1}) out.radius[k].b = std::min(out.radius[k].b, lengths.b);
  } else if (name == "joint_height") {
    double& most = plain ? out.joint_height : out.joint_height_in_radius;
    most = std::min(most, lengths.b);
  } else {
    bool known = false;
    for (std::size_t k = 0; k < 3; ++k) {
      if (name != "leg_length" && name != legs[k]) continue;
      Range& within = plain ? out.length[k] : out.length_in_zp[k];
      within = meet(within, lengths);
      known = true;
    }
    if (!known) refuse("the proof knows no limit " + name);
  }
}

/// Of lemma 13, where a design below the target can lie.
Box first_box(const Study& s) {
  const Range K = s.target, steepest = root(3.0) * K;
  const double arm = (1.0 / steepest).a;
  Box box;
  box[delta] = meet({arm, (1.5 * K).b}, {0.0, std::min(s.radius[0].b, s.radius[2].b)});
  box[eta] = Range(-1.0, 1.0) * root(1.5) * K;
  const double cosine = std::clamp((Range(arm) / box[delta].b).a, 0.0, 1.0);
  box[epsilon] = {0.0, angle_of(cosine, root(1.0 - square(cosine))).b};
  box[zp] = s.zp;
  box[drop] = meet(meet(s.zp - s.zs, s.zp * (1.0 - s.fraction)), {0.0, inf});
  const Range slopes{(1.0 / (K * root(1.5 * (1.0 + square(Range(box[drop].b)))))).a, steepest.b};
  box[upper] = box[lower] = slopes;
  box[x_a] = {-s.radius[0].b, s.radius[0].b};
  box[x_b] = {-s.radius[2].b, s.radius[2].b};
  box[lower_up] = s.radius[1] / slopes;
  box[upper_up] = s.radius[3] / slopes;
  return box;
}

}  // namespace

Study study_of_lines(const Certificate& c) {
  sets::require_variables(c.family, c.variables);
  if (!(c.target > 1.0 && c.target < 1e3)) refuse("the target is not from 1 to 1000");
  const double length = c.length.a;
  if (!c.length_kind.empty() || c.length.b != length || !ordinary(length) || !(length > 0.0 && length < inf))
    refuse("the characteristic length is not one number from 1e-100 to 1e100");
  std::vector<Range> x(c.variables.size());
  for (std::size_t k = 0; k < x.size(); ++k) {
    const auto& [name, range, of] = c.variables[k];
    const bool positive = name == "zp" || name.ends_with("radius");
    if (!of.empty()) refuse("variable " + name + " is missing");
    if (name.ends_with("angle")) continue;
    if (!ordinary(range.a) || !ordinary(range.b) || !(size(range) < inf) || (positive && !(range.a >= 0.0)))
      refuse("the bounds of " + name + " are not those of such a number, or not from 1e-100 to 1e100");
    x[k] = range / length;
  }
  Study out;
  out.target = c.target;
  out.radius = {x[0], x[1], x[3], x[5]};
  out.zp = x[7];
  out.zs = x[8];
  out.height = {x[9], x[10], x[11], x[12]};
  out.length.fill({-inf, inf});
  out.length_in_zp.fill({-inf, inf});
  for (const Bound& limit : c.limits) {
    for (const double end : {limit.range.a, limit.range.b})
      if (!ordinary(end)) refuse("a bound of " + limit.name + " is not from 1e-100 to 1e100");
    read_limit(limit, length, out);
  }
  out.box = first_box(out);
  return out;
}

}  // namespace ninedof::checker::lines
