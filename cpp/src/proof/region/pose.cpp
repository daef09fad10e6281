#include "proof/region/pose.hpp"

#include <algorithm>
#include <cmath>

#include "math/numbers.hpp"
#include "ninedof/math/error.hpp"

namespace ninedof::over_region {
namespace {

/// Rows of exp of the rotation vector (x, y, 0).
template <class T>
std::array<Xyz<T>, 3> tilted(const T& x, const T& y) {
  const T xx = x * x, yy = y * y, u = xx + yy;
  const T s = sine_over(u), k = one_minus_cosine_over(u), mixed = k * (x * y), sx = s * x, sy = s * y;
  return {Xyz<T>{1.0 - k * yy, mixed, sy}, Xyz<T>{mixed, 1.0 - k * xx, -sx}, Xyz<T>{-sy, sx, 1.0 - k * u}};
}

/// A configuration as a box of one pose.
template <class T>
PoseOf<T> pose_of(const Configuration& c) {
  const FormPose pose = form_pose(c);
  const auto vector = [](const FormVector& v) { return Xyz<T>{T(v.x), T(v.y), T(v.z)}; };
  return {vector(pose.p), vector(pose.s), {vector(pose.q[0]), vector(pose.q[1]), vector(pose.q[2])}};
}

/// Bounds of the length of a vector of coordinates in a box; rounding is far below what `slack` allows.
constexpr double slack = 1e-12;
double least_length(const Box& box, const Disc& disc) {
  double sum = 0.0;
  for (std::size_t k = disc.first; k < disc.first + disc.count; ++k) {
    const double x = std::max({box.low[k], -box.high[k], 0.0});
    sum += x * x;
  }
  return std::sqrt(sum);
}

}  // namespace

Domain::Domain(const PosedRobot& machine)
    : machine_(machine),
      built_{machine.geometry, machine.tolerances.joints},
      rule_(machine.rule.begin(), machine.rule.end()) {
  validate(machine.tolerances);
  const auto unknown = [](double x) { return std::isnan(x); };
  if (machine.tolerances.legs.hasNaN() || std::ranges::any_of(machine.tolerances.joints, unknown))
    throw InvalidArgument("tolerances", "nan", "finite lengths >= 0");
  if (!machine.region.empty()) {
    const Region& region = machine.region.front();
    Box box;
    const Vec6 reach = region.reach();
    for (std::size_t k = 0; k < PoseForm::size; ++k) {
      box.high[k] = reach[static_cast<Eigen::Index>(k)];
      box.low[k] = -box.high[k];
    }
    const bool path = region.shape == Region::Shape::path;
    if (path) box.low[0] = 0.0;
    if (region.shape == Region::Shape::ball) discs_.push_back({0, 3, region.size[0]});
    if (region.shape == Region::Shape::cylinder) discs_.push_back({0, 2, region.size[0]});
    if (region.tilt > 0.0) discs_.push_back({3, 2, region.tilt});
    const int pieces = path ? static_cast<int>(region.corners.size()) - 1 : 1;
    for (box.piece = 0; box.piece < pieces; ++box.piece) roots_.push_back(box);
  }
  for (std::size_t k = 0; k < machine.poses.size(); ++k) {
    Box box;
    box.piece = -1 - static_cast<int>(k);
    roots_.push_back(box);
  }
}

template <class T>
PoseOf<T> Domain::pose(const Box& box) const {
  if (box.piece < 0) {
    const Configuration& c = machine_.poses[static_cast<std::size_t>(-1 - box.piece)];
    return pose_of<T>(c);
  }
  return moved(box, pose_of<T>(machine_.neutral), machine_.region.front().unit(machine_.neutral));
}

template <class T, class Unit>
PoseOf<T> Domain::moved(const Box& box, const PoseOf<T>& neutral, const Unit& unit) const {
  std::array<T, PoseForm::size> x;
  for (std::size_t k = 0; k < x.size(); ++k) x[k] = T::coordinate(box.low[k], box.high[k], k);
  const Region& region = machine_.region.front();
  Xyz<T> moved{x[0], x[1], x[2]};
  if (region.shape == Region::Shape::path) {
    const auto k = static_cast<std::size_t>(box.piece);
    const Xyz<T> from = constant<T>(region.corners[k]), to = constant<T>(region.corners[k + 1]);
    moved = from + x[0] * (to - from);
  }
  if (region.in_zp) moved = unit * moved;
  PoseOf<T> out = neutral;
  out.p = out.p + moved;
  if (rule_.empty()) {
    if (region.shifted) out.s = out.s + moved;
  } else if constexpr (T::size == PoseForm::size) {  // a box of designs has no polynomial for O
    out.s = out.s + rule_.front().shift<T>({moved.x, moved.y, moved.z, x[3], x[4], x[5]});
  }
  if (region.yaw > 0.0) {
    const T c = cos(x[5]), s = sin(x[5]);
    for (Xyz<T>& v : out.q) v = {c * v.x - s * v.y, s * v.x + c * v.y, v.z};
  }
  if (region.tilt > 0.0) {
    const std::array<Xyz<T>, 3> rows = tilted(x[3], x[4]);
    for (Xyz<T>& v : out.q) v = {dot(rows[0], v), dot(rows[1], v), dot(rows[2], v)};
  }
  return out;
}

template PoseOf<PoseForm> Domain::pose(const Box&) const;
template PoseOf<CurvedForm> Domain::pose(const Box&) const;
template PoseOf<DesignForm> Domain::moved(const Box&, const PoseOf<DesignForm>&, const DesignForm&) const;
template PoseOf<CurvedForm> Domain::moved(const Box&, const PoseOf<CurvedForm>&, const CurvedForm&) const;

MetAt Domain::met(const Box& point) const {
  MetAt out;
  if (point.piece < 0) {
    out.pose = -1 - point.piece;
    return out;
  }
  const FormPose at = pose(point);
  out.shift = Vec3(at.p.x.c, at.p.y.c, at.p.z.c) - machine_.neutral.position;
  out.tilt = Vec3(point.low[3], point.low[4], 0.0);
  out.yaw = point.low[5];
  return out;
}

Configuration Domain::configuration(const Box& point) const {
  const FormPose at = pose(point);
  Mat3 rotation;
  rotation << centre(at.q[0]), centre(at.q[1]), centre(at.q[2]);
  return {centre(at.p), rotation, centre(at.s)};
}

Box Domain::point(const Vec6& at) const {
  Box out;
  std::copy(at.begin(), at.end(), out.low.begin());
  if (const Region& region = machine_.region.front(); region.shape == Region::Shape::path) {
    const auto [way, from, to] = region.straight(at[0]);
    out.piece = way;
    out.low[0] = std::clamp((at[0] - from) / (to - from), 0.0, 1.0);
  }
  out.high = out.low;
  return nearest(out);
}

bool Domain::outside(const Box& box) const {
  return cut(box) && std::ranges::any_of(discs_, [&](const Disc& disc) {
           const double least = least_length(box, disc);  // infinite where squares leave the doubles: not known then
           return least > disc.radius * (1.0 + slack) && std::isfinite(least);
         });
}

Box Domain::nearest(Box point) const {
  if (!cut(point)) return point;
  for (const Disc& disc : discs_) {
    const double length = least_length(point, disc);
    if (length <= disc.radius * (1.0 - slack)) continue;
    for (std::size_t k = disc.first; k < disc.first + disc.count; ++k)
      point.low[k] = point.high[k] = point.low[k] * (disc.radius / length * (1.0 - slack));
  }
  return point;
}

namespace {

/// Of a form that is linear in the vector of a disc: its slope, per unit of the coordinates, and what it has where that
/// vector is zero, less what it has in the middle of the box.
struct Plane {
  std::array<double, 3> slope{};
  double length = 0.0, from_middle = 0.0, size = 0.0;
};
Plane plane(const std::array<double, PoseForm::size>& a, const Box& box, const Disc& disc) {
  Plane out;
  double sum = 0.0;
  for (std::size_t n = 0; n < disc.count; ++n) {
    const std::size_t k = disc.first + n;
    const double half = 0.5 * (box.high[k] - box.low[k]);
    if (!(half > 0.0)) continue;
    out.slope[n] = a[k] / half;
    sum += out.slope[n] * out.slope[n];
    const double back = out.slope[n] * (0.5 * (box.low[k] + box.high[k]));
    out.from_middle -= back;
    out.size += std::abs(back);
  }
  out.length = std::sqrt(sum);
  return out;
}

}  // namespace

double Domain::greatest(const PoseForm& f, const Box& box) const {
  double most = upper(f);
  if (!cut(box) || !(most < infinity)) return most;
  for (const Disc& disc : discs_) {
    double in_box = 0.0;
    bool whole = true;  // a coordinate without width is no part of the form, but of the disc
    for (std::size_t k = disc.first; k < disc.first + disc.count; ++k) {
      in_box += std::abs(f.a[k]);
      whole = whole && box.low[k] < box.high[k];
    }
    if (!whole) continue;
    const Plane p = plane(f.a, box, disc);
    const double in_disc =
        p.from_middle + p.length * disc.radius + 0x1p-46 * (p.size + p.length * disc.radius + in_box);
    if (in_disc < in_box) most += (in_disc - in_box) * (1.0 - 0x1p-46);
  }
  return most + 0x1p-46 * std::abs(most);
}

Box Domain::towards(const std::array<double, PoseForm::size>& slope, const Box& box) const {
  Box out = corner_of(box, slope);
  if (!cut(box)) return out;
  for (const Disc& disc : discs_) {
    const Plane p = plane(slope, box, disc);
    if (!(p.length > 0.0) || least_length(out, disc) <= disc.radius) continue;
    Box edge = out;
    bool inside = true;
    for (std::size_t n = 0; n < disc.count; ++n) {
      const std::size_t k = disc.first + n;
      edge.low[k] = edge.high[k] = disc.radius * (p.slope[n] / p.length);
      inside = inside && box.low[k] <= edge.low[k] && edge.low[k] <= box.high[k];
    }
    if (inside) out = edge;
  }
  return nearest(out);
}

int divided_coordinate(const Box& box, const std::array<double, PoseForm::size>& moves) {
  const auto most = std::max_element(moves.begin(), moves.end());
  const auto k = static_cast<std::size_t>(most - moves.begin());
  const double middle = 0.5 * (box.low[k] + box.high[k]);
  return *most > 0.0 && box.low[k] < middle && middle < box.high[k] ? static_cast<int>(k) : -1;
}

std::array<Box, 2> halves(const Box& box, int coordinate) {
  const auto k = static_cast<std::size_t>(coordinate);
  std::array<Box, 2> out{box, box};
  out[0].high[k] = out[1].low[k] = 0.5 * (box.low[k] + box.high[k]);
  return out;
}

Box middle_of(const Box& box) {
  return corner_of(box, {});
}

Box corner_of(const Box& box, const std::array<double, PoseForm::size>& side) {
  Box out = box;
  for (std::size_t k = 0; k < PoseForm::size; ++k) {
    const double x = side[k] > 0.0 ? box.high[k] : side[k] < 0.0 ? box.low[k] : 0.5 * (box.low[k] + box.high[k]);
    out.low[k] = out.high[k] = x;
  }
  return out;
}

}  // namespace ninedof::over_region
