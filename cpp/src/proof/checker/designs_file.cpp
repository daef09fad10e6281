#include "proof/checker/designs_file.hpp"

#include <algorithm>
#include <cmath>

#include "proof/checker/line_words.hpp"
#include "proof/checker/linear.hpp"

namespace ninedof::checker::sets {
namespace {

/// The lines of a file, in this order: of designs, of a workspace or of both; whether there may be many, or none.
struct LineKind {
  const char* key;
  char of;
  bool many, optional;
};
constexpr std::array<LineKind, 23> kinds{{{"family", 'd', false, false},
                                          {"variable", 'd', true, false},
                                          {"tool", 'd', false, false},
                                          {"joint", 'w', true, false},
                                          {"home", 'w', false, false},
                                          {"characteristic_length", 'b', false, false},
                                          {"region", 'd', false, false},
                                          {"corner", 'd', true, true},
                                          {"pose", 'd', true, true},
                                          {"space", 'w', false, false},
                                          {"internal_point", 'w', false, false},
                                          {"allowed_with", 'w', false, false},
                                          {"rotation", 'w', true, false},
                                          {"weights", 'b', false, true},
                                          {"leg", 'b', true, true},
                                          {"load", 'b', true, true},
                                          {"speeds", 'b', false, true},
                                          {"limit", 'b', true, true},
                                          {"exempt", 'b', true, true},
                                          {"shares", 'd', false, false},
                                          {"box", 'd', true, false},
                                          {"volume", 'w', false, false},
                                          {"tree", 'w', false, false}}};
constexpr std::array states{"inside", "outside", "undecided"};

LimitLine limit_of(LineWords& line) {
  LimitLine out;
  out.name = line.word();
  for (const char c : out.name)
    if (c != '_' && (c < 'a' || c > 'z') && (c < '1' || c > '3')) refuse(quoted(out.name) + " is no name of a limit");
  out.range = line.range();
  out.of = line.word();
  if (out.of != "length" && out.of != "zp" && out.of != "radius") refuse(quoted(out.of) + " is no unit of a limit");
  out.at_neutral = line.either("neutral", "poses");
  out.axis = line.reals<3>();
  return out;
}

BoxLine box_of(LineWords& line, const DesignsFile& file) {
  BoxLine out;
  for (std::size_t k = 0; k < file.varied.size(); ++k) out.ends[k] = line.range();
  const std::string state = line.word();
  if (state != states[0] && state != states[1] && state != states[2]) refuse(quoted(state) + " is no state of a box");
  out.state = state[0];
  if (out.state != 'o') return out;
  out.limit = line.whole();
  out.at = line.pose();
  out.other = line.pose();
  return out;
}

void add(const std::string& key, LineWords& line, DesignsFile& out) {
  if (key == "family") out.family = line.word();
  else if (key == "variable") {
    const std::string name = line.word();
    out.variables.push_back({name, line.range()});
    const Range& x = out.variables.back().range;
    if (!std::isfinite(x.a) || !std::isfinite(x.b)) refuse("a variable has no bounds");
    if (x.a < x.b) out.varied.push_back(out.variables.size() - 1);
    if (out.varied.size() > most_varied_symbols) refuse("more than six variables vary");
  } else if (key == "joint") out.space.joints.push_back(line.reals<3>());
  else if (key == "home") out.space.home = line.reals<15>();
  else if (key == "space") {
    out.space.low = line.reals<3>();
    out.space.high = line.reals<3>();
  } else if (key == "internal_point") {
    out.space.rule = line.word();
    out.space.point = line.reals<3>();
    out.space.fraction = line.real();
  } else if (key == "allowed_with") out.space.some = line.either("some", "all");
  else if (key == "rotation") out.space.rotations.push_back(line.reals<9>());
  else if (key == "volume") out.space.volume = line.range();
  else if (key == "tree") out.space.tree = static_cast<std::size_t>(line.whole());
  else if (key == "tool") out.tool = line.reals<6>();
  else if (key == "characteristic_length") out.length = line.real();
  else if (key == "region") {
    out.region.shape = line.word();
    out.region.size = line.reals<3>();
    out.region.tilt = line.real();
    out.region.yaw = line.real();
    out.region.shifted = line.either("shifted", "held");
    out.region.in_zp = line.either("zp", "length");
  } else if (key == "corner") out.region.corners.push_back(line.reals<3>());
  else if (key == "pose") {
    PoseLine one{line.reals<3>(), line.reals<3>(), line.reals<3>()};
    one.in_zp = line.either("zp", "length");
    out.poses.push_back(one);
  } else if (key == "weights") {
    out.duty.gravity = line.reals<3>();
    out.duty.platform = line.real();
    out.duty.centre = line.reals<3>();
    out.duty.internal_point = line.real();
    out.duty.weighed = true;
  } else if (key == "leg") out.duty.legs.push_back(line.reals<4>());
  else if (key == "load") out.duty.loads.push_back({line.reals<3>(), line.reals<3>(), line.reals<3>()});
  else if (key == "speeds") {
    out.duty.linear = line.real();
    out.duty.angular = line.real();
    out.duty.internal = line.word();
  } else if (key == "limit") out.limits.push_back(limit_of(line));
  else if (key == "exempt") out.exempt.push_back(line.whole());
  else if (key == "shares") out.shares = line.reals<3>();
  else out.boxes.push_back(box_of(line, out));
}

/// Without loads and masses every design would keep its limits of forces.
void validate_duty(const DesignsFile& file) {
  const DutyLines& duty = file.duty;
  bool stated = false,
       known = duty.linear >= 0.0 && duty.angular >= 0.0 && duty.platform >= 0.0 && duty.internal_point >= 0.0;
  for (const auto& [cylinder, cylinder_centre, rod, rod_centre] : duty.legs) known &= cylinder >= 0.0 && rod >= 0.0;
  for (const char* one : {"shifted", "carried", "held", "least"}) stated |= duty.internal == one;
  known &= stated || duty.internal.empty();
  if (!known) refuse("the masses or speeds of the duty are none");
  if (stated != duty.weighed || stated != (duty.legs.size() == 9) || stated == duty.loads.empty())
    refuse("the duty lacks its weights, its nine legs, its loads or its speeds");
  for (const LimitLine& one : file.limits)
    if (duties_of(one.name).count > 0 && !stated) refuse(one.name + " is a limit of a duty, and the file has none");
}

void validate_space(const DesignsFile& file) {
  const SpaceLines& space = file.space;
  if (space.joints.size() != 12) refuse("the joints are not twelve");
  for (std::size_t k = 0; k < 3; ++k)
    if (!(space.low[k] < space.high[k])) refuse("the box of positions is none");
  if (space.rule != "fixed" && space.rule != "platform" && space.rule != "between")
    refuse(quoted(space.rule) + " is no rule for O");
  if (!(space.volume.a >= 0.0)) refuse("the volume is negative");
  for (const LimitLine& one : file.limits)
    if (one.at_neutral || one.of != "length") refuse("the limit of " + one.name + " is none of a pose");
}

void validate_region(const DesignsFile& file) {
  require_variables(file.family, file.variables);
  const RegionLine& region = file.region;
  bool known = region.corners.empty() == (region.shape != "path") && region.corners.size() != 1;
  for (const double x : {region.size[0], region.size[1], region.size[2], region.tilt, region.yaw}) known &= x >= 0.0;
  if (!known || !(region.tilt <= 3.15 && region.yaw <= 3.15)) refuse("the region is none");
  bool shape = false;
  for (const char* one : {"none", "box", "ball", "cylinder", "path"}) shape |= region.shape == one;
  if (!shape) refuse(quoted(region.shape) + " is no shape of a region");
  if (file.boxes.empty()) refuse("the file has no boxes");
}

void validate(const DesignsFile& file) {
  if (!(file.length > 0.0)) refuse("the characteristic length is not positive");
  if (file.space.present()) validate_space(file);
  else validate_region(file);
  for (const LimitLine& one : file.limits) {
    if (one.name.find("cone") != std::string::npos && !(one.range.b <= 3.15 || one.range.b == inf))
      refuse("the bound of " + one.name + " is no angle");
    if (!(one.range.a < inf && one.range.b > 0.0)) refuse("the bounds of " + one.name + " allow nothing");
  }
  validate_duty(file);
  for (const int pair : file.exempt)
    if (pair < 0 || pair > 20) refuse("a pair of legs is not from 0 to 20");
}

/// The variables of a family in their order.
std::vector<std::string> names_of(const std::string& family) {
  if (family == "hexagonal") return {"a1", "a2", "b1", "b2", "zp", "zs", "theta_z"};
  std::vector<std::string> out;
  const std::array triples{"base_external", "base_internal", "platform_external", "platform_internal"};
  if (family == "general") {
    for (const std::string triple : triples)
      for (const char* joint : {"_1", "_2", "_3"})
        for (const char* axis : {"_x", "_y", "_z"}) out.push_back(triple + joint + axis);
    out.insert(out.end(), {"zp", "zs", "theta_z"});
    return out;
  }
  if (family != "symmetric" && family != "symmetric_nonplanar") refuse(quoted(family) + " is no family of designs");
  for (const std::string triple : triples) {
    out.push_back(triple + "_radius");
    if (triple != triples[0]) out.push_back(triple + "_angle");
  }
  out.insert(out.end(), {"zp", "zs"});
  if (family == "symmetric_nonplanar")
    for (const std::string triple : triples) out.push_back(triple + "_height");
  return out;
}

std::string plain(const Triple& x) {
  return digits(x[0]) + ", " + digits(x[1]) + ", " + digits(x[2]);
}
std::string turned_by(const Triple& x) {
  return ", turned by " + plain(x) + in_degrees({x[0], x[1], x[2]});
}

}  // namespace

void require_variables(const std::string& family, const std::vector<Bound>& variables) {
  const std::vector<std::string> names = names_of(family);
  if (variables.size() != names.size()) refuse("the variables are not those of the family");
  for (std::size_t k = 0; k < names.size(); ++k)
    if (variables[k].name != names[k]) refuse("variable " + names[k] + " is missing");
}

DesignsFile read_designs(Stream& file) {
  DesignsFile out;
  const char other = file.kind() == kind_of_workspace ? 'd' : 'w';
  std::size_t place = 0, last = kinds.size();  // the kind that comes next, and the one that was last
  for (std::string text; file.line(text);) {
    LineWords line(text);
    const std::string key = line.word();
    const std::size_t before = place;
    while (place < kinds.size() && key != kinds[place].key) ++place;
    if (place == kinds.size() || kinds[place].of == other) refuse("line " + quoted(text) + " is not in its place");
    for (std::size_t k = before; k < place; ++k)
      if (!kinds[k].optional && kinds[k].of != other && k != last)
        refuse("line " + quoted(kinds[k].key) + " is missing");
    last = place;
    if (!kinds[place].many) ++place;
    add(key, line, out);
    if (!line.done()) refuse(quoted(text) + " goes on after its end");
    if (key == "tree") break;
  }
  if (other == 'w') file.finish();
  validate(out);
  return out;
}

namespace {

std::vector<std::string> robot_of(const DesignsFile& file) {
  const SpaceLines& space = file.space;
  std::vector<std::string> out{"positions from " + plain(space.low) + " to " + plain(space.high)};
  for (std::size_t k = 0; k < space.joints.size(); ++k)
    out.push_back((k < 6 ? "joint of the base " : "joint of the platform ") + plain(space.joints[k]));
  const auto matrix = [](const double* x) {
    return plain({x[0], x[1], x[2]}) + "; " + plain({x[3], x[4], x[5]}) + "; " + plain({x[6], x[7], x[8]});
  };
  const std::array<double, 15>& home = space.home;
  out.push_back("home at " + plain({home[0], home[1], home[2]}) + " with the rotation " + matrix(home.data() + 3) +
                ", O at " + plain({home[12], home[13], home[14]}));
  out.push_back(space.rule == "between"
                    ? "O at " + digits(space.fraction) + " of the way between the internal joints"
                    : "O at " + plain(space.point) + (space.rule == "platform" ? " of the platform" : " of the base"));
  for (const auto& rotation : space.rotations)
    out.push_back((space.rotations.size() == 1 ? "the rotation "
                   : space.some                ? "or the rotation "
                                               : "and the rotation ") +
                  matrix(rotation.data()));
  return out;
}

/// The centre of the platform's mass as the study has it, in the frame of the plate; the file has it in the tool's. Six
/// digits of it: for people, no part of a proof.
std::string centre_of_mass(const DesignsFile& file) {
  const auto& [px, py, pz, rx, ry, rz] = file.tool;
  const auto& [x, y, z] = file.duty.centre;
  const Arrow turn{rx, ry, rz}, own{x, y, z};
  const Linear squared = dot(turn, turn), s = of_angle_squared(squared, 1), c = of_angle_squared(squared, 2);
  const bool known = s.r < 1.0 && c.r < 1.0;  // not of a turn by more than that of poses
  const Arrow once = cross(turn, own);
  const Arrow at = known ? Arrow{px, py, pz} + own + s * once + c * cross(turn, once) : own;
  double size = 0.0;
  for (const double one : {px, py, pz, x, y, z}) size = std::max(size, std::abs(one));
  const auto shown = [&](double one) {
    return digits(std::abs(one) > 1e-12 * size ? one : 0.0, std::chars_format::general, 6);
  };
  return "(" + shown(at.x.c) + ", " + shown(at.y.c) + ", " + shown(at.z.c) + ") in the frame of " +
         (file.space.present() ? "its joints"
          : known              ? "the plate"
                               : "the tool");
}

std::vector<std::string> designs_of(const DesignsFile& file) {
  std::vector<std::string> out{file.family + " designs with 0 < zs < zp"};
  for (const Bound& one : file.variables) out.push_back(said(one.name, one.range));
  if (file.tool != std::array<double, 6>{})
    out.push_back("tool at " + plain({file.tool[0], file.tool[1], file.tool[2]}) +
                  turned_by({file.tool[3], file.tool[4], file.tool[5]}));
  const auto in = [](bool zp) { return zp ? " zp" : ""; };
  const RegionLine& region = file.region;
  if (region.shape != "none")
    out.push_back("at every pose of a " + region.shape +
                  (region.shape == "path" ? "" : " of " + plain(region.size) + in(region.in_zp)) + ", tilts up to " +
                  digits(region.tilt) + in_degrees({region.tilt}) + ", yaw up to " + digits(region.yaw) +
                  in_degrees({region.yaw}) + ", O " + (region.shifted ? "shifted" : "held"));
  for (const Triple& corner : region.corners) out.push_back("  by " + plain(corner) + in(region.in_zp));
  for (const PoseLine& one : file.poses)
    out.push_back("at the pose shifted by " + plain(one.position) + in(one.in_zp) + turned_by(one.rotation) +
                  ", O shifted by " + plain(one.internal) + in(one.in_zp));
  return out;
}

}  // namespace

std::vector<std::string> question_of(const DesignsFile& file) {
  std::vector<std::string> out = file.space.present() ? robot_of(file) : designs_of(file);
  if (const DutyLines& duty = file.duty; !duty.internal.empty()) {
    out.push_back("gravity " + plain(duty.gravity) + ", mass of the platform " + digits(duty.platform) + ", centre " +
                  centre_of_mass(file) + ", of O " + digits(duty.internal_point));
    for (int leg = 0; leg < 9; ++leg)
      if (const auto& m = duty.legs[static_cast<std::size_t>(leg)]; m != std::array<double, 4>{})
        out.push_back(std::string(name_of_leg(leg)) + ": mass of the cylinder " + digits(m[0]) + " at " + digits(m[1]) +
                      " from its start, of the rod " + digits(m[2]) + " at " + digits(m[3]) + " from its end");
    for (const auto& load : duty.loads)
      out.push_back("load of the moment " + plain(load[0]) + ", the force " + plain(load[1]) + ", the force on O " +
                    plain(load[2]));
    out.push_back("speeds up to " + digits(duty.linear) + " and " + digits(duty.angular) + in_degrees({duty.angular}) +
                  " per time, O " +
                  (duty.internal == "least" ? "where the squared rates of the inner legs are least" : duty.internal));
  }
  for (const LimitLine& one : file.limits) {
    std::string line = one.name;
    if (one.range.a > 0.0) line += " at least " + digits(one.range.a);
    if (one.range.b < inf) line += " at most " + digits(one.range.b);
    if (one.name.find("cone") != std::string::npos && one.range.b < inf) line += in_degrees({one.range.b});
    if (one.of != "length") line += " " + one.of;
    if (one.name == "condition_number" || one.name == "fault_tolerant")
      line += " with the characteristic length " + digits(file.length);
    if (one.axis != Triple{}) line += " about " + plain(one.axis);
    out.push_back(line + (one.at_neutral ? " at the neutral pose" : ""));
  }
  for (const int pair : file.exempt) {
    const auto [a, b] = legs_of_pair(pair);
    out.push_back(std::string(name_of_leg(a)) + "-" + name_of_leg(b) + " may meet: they share a joint");
  }
  return out;
}

LegDuties duties_of(const std::string& limit) {
  const std::array<std::string, 4> kinds{"", "external_", "upper_", "lower_"};
  for (int k = 0; k < 4; ++k)
    for (const std::string what : {"force", "rate", "power"})
      if (limit == kinds[static_cast<std::size_t>(k)] + what && (k == 0 || what != "power"))
        return {what != "rate", what != "force", k > 0 ? 3 * k - 3 : 0, k > 0 ? 3 : 9};
  return {};
}

const char* name_of_leg(int leg) {
  return std::array{"l1", "l2", "l3", "q1", "q2", "q3", "r1", "r2", "r3"}[static_cast<std::size_t>(leg)];
}

std::array<int, 2> legs_of_pair(int pair) {
  if (pair < 3) return {pair, (pair + 1) % 3};
  return {(pair - 3) / 6, 3 + (pair - 3) % 6};
}

}  // namespace ninedof::checker::sets
