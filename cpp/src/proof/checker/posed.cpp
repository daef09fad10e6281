#include "proof/checker/posed.hpp"

#include <cmath>

namespace ninedof::checker::sets {
namespace {

/// Half the root of three, and a sixth.
const Linear half_root(0.86602540378443864676, 2e-16), sixth_root(0.28867513459481288225, 1e-16);

Arrow fixed(const Triple& v) {
  return {v[0], v[1], v[2]};
}

/// The rotation by a vector of at most half a turn: 1 + S a x + C a x a x of its length a.
std::array<Arrow, 3> turned_axes(const Arrow& a) {
  const Linear u = dot(a, a), s = of_angle_squared(u, 1), c = of_angle_squared(u, 2);
  std::array<Arrow, 3> out{Arrow{1.0, 0.0, 0.0}, Arrow{0.0, 1.0, 0.0}, Arrow{0.0, 0.0, 1.0}};
  for (Arrow& v : out) {
    const Arrow once = cross(a, v);
    v = v + s * once + c * cross(a, once);
  }
  return out;
}
Arrow combined(const std::array<Arrow, 3>& columns, const Arrow& v) {
  return v.x * columns[0] + v.y * columns[1] + v.z * columns[2];
}
bool is_zero(const Triple& v) {
  return v == Triple{};
}

/// The joints of a triple: each is the one before, turned by -120 degrees.
void put_triple(const Arrow& first, std::size_t triple, Mount& out) {
  const Linear rx = half_root * first.x, ry = half_root * first.y, hx = 0.5 * first.x, hy = 0.5 * first.y;
  out.plate[triple] = first;
  out.plate[triple + 1] = {ry - hx, -(rx + hy), first.z};
  out.plate[triple + 2] = {-(ry + hx), rx - hy, first.z};
}
/// eqs. (37) and (38): the first external joint of a hexagon of sides a and b, and the internal one, its mirror image.
void put_hexagon(const Linear& a, const Linear& b, std::size_t triple, Mount& out) {
  const Linear x = 0.5 * a, y = -(sixth_root * (a + 2.0 * b));
  put_triple({x, y, 0.0}, triple, out);
  put_triple({-x, y, 0.0}, triple + 3, out);
}
Arrow polar(const Linear& radius, const Linear& angle, const Linear& height) {
  return {radius * cosine(angle), radius * sine(angle), height};
}

/// The rotation nearest to a matrix: one with the singular values x is within max |x - 1| <= max |x^2 - 1| of it, and
/// that is at most three times the greatest entry of Q^T Q - 1.
std::array<Arrow, 3> rotation_near(const double* rows) {
  double defect = 0.0;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      Range sum = i == j ? -1.0 : 0.0;
      for (int k = 0; k < 9; k += 3) sum = sum + Range(rows[k + i]) * Range(rows[k + j]);
      defect = std::max(defect, size(sum));
    }
  const double volume = rows[0] * (rows[4] * rows[8] - rows[5] * rows[7]) +
                        rows[1] * (rows[5] * rows[6] - rows[3] * rows[8]) +
                        rows[2] * (rows[3] * rows[7] - rows[4] * rows[6]);
  if (!(defect < 1e-6 && volume > 0.5)) refuse("a matrix is no rotation");
  std::array<Arrow, 3> out;
  for (int k = 0; k < 3; ++k) {
    const auto entry = [&](int row) { return Linear(rows[3 * row + k], 3.5 * defect); };
    out[static_cast<std::size_t>(k)] = {entry(0), entry(1), entry(2)};
  }
  return out;
}
Arrow middle_of(const std::array<Arrow, 12>& joints, std::size_t first) {
  return Linear(1.0 / 3.0, 1e-16) * (joints[first] + joints[first + 1] + joints[first + 2]);
}

Mount mount_of(const SpaceLines& space) {
  Mount out;
  for (std::size_t k = 0; k < out.plate.size(); ++k) out.plate[k] = fixed(space.joints[k]);
  out.joint = out.plate;
  const auto& home = space.home;
  out.home = {fixed({home[0], home[1], home[2]}), fixed({home[12], home[13], home[14]}), rotation_near(&home[3])};
  return out;
}
Stand stand_in(const SpaceLines& space, const Mount& m, const Patch& patch) {
  Stand out;
  out.p = {along(patch.low[0], patch.high[0], 0), along(patch.low[1], patch.high[1], 1),
           along(patch.low[2], patch.high[2], 2)};
  out.q = rotation_near(space.rotations[static_cast<std::size_t>(patch.piece)].data());
  const Arrow point = fixed(space.point);
  if (space.rule == "fixed") out.s = point;
  else if (space.rule == "platform") out.s = out.p + combined(out.q, point);
  else {
    const Arrow lower = middle_of(m.joint, 3), upper = out.p + combined(out.q, middle_of(m.joint, 9));
    out.s = lower + Linear(space.fraction) * (upper - lower);
  }
  return out;
}

struct RoundPart {
  std::size_t first, count;
  double radius;
};
std::vector<RoundPart> round_parts(const DesignsFile& file) {
  std::vector<RoundPart> out;
  const RegionLine& region = file.region;
  if (region.shape == "ball") out.push_back({0, 3, region.size[0]});
  if (region.shape == "cylinder") out.push_back({0, 2, region.size[0]});
  if (region.tilt > 0.0) out.push_back({3, 2, region.tilt});
  return out;
}

}  // namespace

Mount mount(const DesignsFile& file, const Cube& designs) {
  if (file.space.present()) return mount_of(file.space);
  std::vector<Linear> x;
  for (const Bound& one : file.variables) x.emplace_back(one.range.a);
  for (std::size_t k = 0; k < file.varied.size(); ++k)
    x[file.varied[k]] = along(designs[k].a, designs[k].b, pose_symbols + k);
  Mount out;
  Linear twist = 0.0;
  if (file.family == "hexagonal") {
    put_hexagon(x[0], x[1], 0, out);
    put_hexagon(x[2], x[3], 6, out);
    out.zp = x[4];
    out.zs = x[5];
    twist = x[6];
  } else if (file.family == "general") {
    for (std::size_t k = 0; k < 12; ++k) out.plate[k] = {x[3 * k], x[3 * k + 1], x[3 * k + 2]};
    out.zp = x[36];
    out.zs = x[37];
    twist = x[38];
  } else {
    const auto height = [&](std::size_t k) { return x.size() > 9 ? x[9 + k] : Linear(0.0); };
    put_triple({x[0], 0.0, height(0)}, 0, out);
    for (std::size_t k = 1; k < 4; ++k) put_triple(polar(x[2 * k - 1], x[2 * k], height(k)), 3 * k, out);
    out.zp = x[7];
    out.zs = x[8];
  }
  const bool twisted = twist.c != 0.0 || swing(twist) > 0.0;
  const Linear c = twisted ? cosine(twist) : 1.0, s = twisted ? sine(twist) : 0.0;
  std::array<Arrow, 3> q{Arrow{c, s, 0.0}, Arrow{-s, c, 0.0}, Arrow{0.0, 0.0, 1.0}};
  const Arrow point = fixed({file.tool[0], file.tool[1], file.tool[2]});
  const Triple turn{file.tool[3], file.tool[4], file.tool[5]};
  out.home.p = Arrow{0.0, 0.0, out.zp} + combined(q, point);
  out.home.s = {0.0, 0.0, out.zs};
  out.joint = out.plate;
  for (std::size_t k = 6; k < 12; ++k) out.joint[k] = out.plate[k] - point;
  if (!is_zero(turn)) {
    const std::array<Arrow, 3> axes = turned_axes(fixed(turn));
    for (std::size_t k = 6; k < 12; ++k) {
      const Arrow own = out.joint[k];
      out.joint[k] = {dot(axes[0], own), dot(axes[1], own), dot(axes[2], own)};
    }
    q = {combined(q, axes[0]), combined(q, axes[1]), combined(q, axes[2])};
  }
  out.home.q = q;
  return out;
}

Stand stand(const DesignsFile& file, const Mount& m, const Patch& patch) {
  if (file.space.present()) return stand_in(file.space, m, patch);
  Stand out = m.home;
  const auto moved = [&](Arrow& point, const Arrow& by, bool in_zp) { point = point + (in_zp ? m.zp * by : by); };
  const auto turn = [&](const std::array<Arrow, 3>& by) {
    for (Arrow& column : out.q) column = combined(by, column);
  };
  if (patch.piece == -1) return out;
  if (patch.piece < -1) {
    const PoseLine& pose = file.poses[static_cast<std::size_t>(-2 - patch.piece)];
    moved(out.p, fixed(pose.position), pose.in_zp);
    moved(out.s, fixed(pose.internal), pose.in_zp);
    if (!is_zero(pose.rotation)) turn(turned_axes(fixed(pose.rotation)));
    return out;
  }
  const RegionLine& region = file.region;
  std::array<Linear, pose_symbols> x;
  for (std::size_t k = 0; k < x.size(); ++k) x[k] = along(patch.low[k], patch.high[k], k);
  Arrow by{x[0], x[1], x[2]};
  if (region.shape == "path") {
    const auto k = static_cast<std::size_t>(patch.piece);
    const Arrow from = fixed(region.corners[k]), to = fixed(region.corners[k + 1]);
    by = from + x[0] * (to - from);
  }
  moved(out.p, by, region.in_zp);
  if (region.shifted) moved(out.s, by, region.in_zp);
  if (region.yaw > 0.0) {
    const Linear c = cosine(x[5]), s = sine(x[5]);
    turn({Arrow{c, s, 0.0}, Arrow{-s, c, 0.0}, Arrow{0.0, 0.0, 1.0}});
  }
  if (region.tilt > 0.0) turn(turned_axes({x[3], x[4], 0.0}));
  return out;
}

Arrow carried(const Stand& at, const Arrow& v) {
  return combined(at.q, v);
}

LegLine leg_line(const Mount& m, const Stand& at, int leg) {
  const auto k = static_cast<std::size_t>(leg);
  if (leg < 3) return {m.joint[k], at.p + carried(at, m.joint[6 + k])};
  if (leg < 6) return {at.p + carried(at, m.joint[6 + k]), at.s};
  return {m.joint[k - 3], at.s};
}

void require_shared_joints(const DesignsFile& file, const Mount& m) {
  const auto joint_of = [](int leg, bool at_platform) {
    return static_cast<std::size_t>(leg < 3 ? (at_platform ? 6 + leg : leg) : leg < 6 ? 6 + leg : leg - 3);
  };
  // Of the place of one in the middle of the designs: a cube may be so large that any distance is small beside it.
  const auto together = [&](std::size_t i, std::size_t j) {
    const Arrow &one = m.plate[i], apart = one - m.plate[j];
    const double size = std::max({std::abs(one.x.c), std::abs(one.y.c), std::abs(one.z.c)});
    const auto nowhere = [size](const Linear& x) { return std::abs(x.c) + swing(x) + x.r <= 1e-12 * size; };
    return nowhere(apart.x) && nowhere(apart.y) && nowhere(apart.z);
  };
  for (const int pair : file.exempt) {
    const auto [a, b] = legs_of_pair(pair);
    const bool shared =
        b < 3   ? together(joint_of(a, false), joint_of(b, false)) || together(joint_of(a, true), joint_of(b, true))
        : b < 6 ? together(joint_of(a, true), joint_of(b, true))
                : together(joint_of(a, false), joint_of(b, false));
    if (!shared) refuse("a pair of legs that is exempt shares no joint");
  }
}

std::vector<Patch> all_poses(const DesignsFile& file) {
  std::vector<Patch> out;
  const RegionLine& region = file.region;
  if (region.shape != "none") {
    Patch one;
    const bool path = region.shape == "path", ball = region.shape == "ball", cylinder = region.shape == "cylinder";
    const double first = region.size[0];
    one.high = {path ? 1.0 : first,
                path               ? 0.0
                : ball || cylinder ? first
                                   : region.size[1],
                path   ? 0.0
                : ball ? first
                       : region.size[2],
                region.tilt,
                region.tilt,
                region.yaw};
    for (std::size_t k = 0; k < pose_symbols; ++k) one.low[k] = path && k == 0 ? 0.0 : -one.high[k];
    const int pieces = path ? static_cast<int>(region.corners.size()) - 1 : 1;
    for (one.piece = 0; one.piece < pieces; ++one.piece) out.push_back(one);
  }
  for (std::size_t k = 0; k < file.poses.size(); ++k) out.push_back({-2 - static_cast<int>(k), {}, {}});
  if (out.empty()) out.push_back({});
  return out;
}

bool beside(const DesignsFile& file, const Patch& patch) {
  if (patch.piece < 0) return false;
  for (const RoundPart& part : round_parts(file)) {
    double sum = 0.0;
    for (std::size_t k = part.first; k < part.first + part.count; ++k) {
      const double x = std::max({patch.low[k], -patch.high[k], 0.0});
      sum += x * x;
    }
    if (sum > part.radius * part.radius * grain::up && sum < inf) return true;
  }
  return false;
}

Patch drawn_in(const DesignsFile& file, const std::vector<Patch>& among, Patch pose) {
  for (const Patch& all : among) {
    if (pose.piece != all.piece) continue;
    for (std::size_t k = 0; k < pose_symbols; ++k)
      pose.low[k] = pose.high[k] = std::min(std::max(pose.low[k], all.low[k]), all.high[k]);
    for (const RoundPart& part : round_parts(file)) {
      double sum = 0.0;
      for (std::size_t k = part.first; k < part.first + part.count; ++k) sum += pose.low[k] * pose.low[k];
      if (pose.piece < 0 || sum * grain::up <= part.radius * part.radius) continue;
      for (std::size_t k = part.first; k < part.first + part.count; ++k)
        pose.low[k] = pose.high[k] = pose.low[k] * (part.radius / std::sqrt(sum) * (1.0 - 0x1p-40));
    }
    return pose;
  }
  refuse("pose " + digits(pose.piece) + " is none at which the limit holds");
}

/// In a disc of radius R the sum of b_k x_k is at least -R |b|; in the box each term has its own least value. The
/// better of both counts.
double least_over(const DesignsFile& file, const Linear& x, const Patch& patch) {
  double out = lower_end(x);
  if (!(out > -inf)) return -inf;
  if (patch.piece < 0) return out;
  for (const RoundPart& part : round_parts(file)) {
    double in_box = 0.0, squares = 0.0, in_middle = 0.0, moduli = 0.0;
    bool whole = true;
    for (std::size_t k = part.first; k < part.first + part.count; ++k) {
      whole = whole && patch.low[k] < patch.high[k];
      const Linear coordinate = along(patch.low[k], patch.high[k], k);
      const double b = x.a[k] / coordinate.a[k];
      in_box += std::abs(x.a[k]);
      squares += b * b;
      in_middle += b * coordinate.c;
      moduli += std::abs(b * coordinate.c);
    }
    if (!whole) continue;
    const double most = std::sqrt(squares) * part.radius;
    const double gain = in_box - (most + in_middle) - grain::of_curve * (most + moduli + in_box);
    if (gain > 0.0) out += gain;
  }
  out -= grain::of_curve * std::abs(out);
  return out > -inf ? out : -inf;
}

}  // namespace ninedof::checker::sets
