#pragma once
/// Poses and constraints once more, by hand: from Geometry, legs.hpp and vectors, one plain formula each. Shares
/// nothing with the library's views and rows.

#include <Eigen/SVD>
#include <cmath>

#include "ninedof/kinematics/velocity.hpp"
#include "ninedof/math/rotation.hpp"
#include "ninedof/problem/problem.hpp"
#include "ninedof/robot/legs.hpp"
#include "support/support.hpp"

namespace hand {

using namespace support;
using ninedof::Limit;
using ninedof::Problem;
using ninedof::Unit;

/// A design and everywhere it stands: neutral first, then the poses; `looked` of them count for a limit.
struct Design {
  Geometry geometry;
  std::vector<Configuration> at;
  double characteristic_length = 1.0;

  std::vector<Configuration> looked(const Limit& limit = {}) const {
    if (limit.at == ninedof::LimitAt::neutral) return {at.front()};
    return at.size() > 1 ? std::vector(at.begin() + 1, at.end()) : at;
  }
};

/// The configuration `fraction` of the way to a pose, s displaced by `offset` (in zp) at its end.
inline Configuration displaced(const Configuration& home, const ninedof::Pose& pose, const Vec3& offset,
                               double fraction) {
  const double zp = home.position.z(), unit = pose.in_zp ? zp : 1.0;
  Configuration c = home;
  c.position += fraction * unit * pose.position;
  c.internal_point += fraction * (unit * pose.internal + zp * offset);
  const double angle = pose.rotation.norm();
  if (angle > 0.0)
    c.rotation = Eigen::AngleAxisd(fraction * angle, pose.rotation / angle).toRotationMatrix() * home.rotation;
  return c;
}

/// Offsets of s follow the family's variables and a free length, three a pose that leaves s to the optimizer; poses on
/// the axis of a symmetric family have only the last of the three.
inline Design design(const Problem& p, const Eigen::VectorXd& x, double fraction = 1.0) {
  const ninedof::DesignFamily& family = ninedof::design_family(p.family);
  const std::span<const double> own{x.data(), family.variables().size()};
  Design out{family.geometry(own), {family.configuration(own)}, ninedof::characteristic_length(p, x)};
  const std::vector<std::string> names = p.names();
  for (std::size_t k = 0; k < p.objective.poses.size(); ++k) {
    Vec3 offset = Vec3::Zero();
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
      const auto name = "pose" + std::to_string(k + 1) + ".s_" + "xyz"[axis];
      const auto place = std::find(names.begin(), names.end(), name);
      if (place != names.end()) offset[axis] = x[place - names.begin()];
    }
    out.at.push_back(displaced(out.at.front(), p.objective.poses[k], offset, fraction));
  }
  return out;
}

inline double radius(const Vec3& joint) {
  return std::hypot(joint.x(), joint.y());
}

inline std::vector<Vec3> joints(const Geometry& g, bool base) {
  const Triple &a = base ? g.base_external() : g.platform_external(),
               &b = base ? g.base_internal() : g.platform_internal();
  std::vector<Vec3> all(a.begin(), a.end());
  all.insert(all.end(), b.begin(), b.end());
  return all;
}

inline double widest(const Geometry& g, bool base) {
  double most = 0.0;
  for (const Vec3& j : joints(g, base)) most = std::max(most, radius(j));
  return most;
}

/// The nine legs as (from, to), order of eq. (35b).
inline std::vector<std::pair<Vec3, Vec3>> segments(const Geometry& g, const Configuration& c) {
  std::vector<std::pair<Vec3, Vec3>> out;
  const auto platform = [&](const Vec3& u) -> Vec3 { return c.position + c.rotation * u; };
  for (std::size_t i = 0; i < 3; ++i) out.emplace_back(g.base_external()[i], platform(g.platform_external()[i]));
  for (std::size_t i = 0; i < 3; ++i) out.emplace_back(platform(g.platform_internal()[i]), c.internal_point);
  for (std::size_t i = 0; i < 3; ++i) out.emplace_back(g.base_internal()[i], c.internal_point);
  return out;
}

/// Least distance of two segments: of the lines if both feet lie inside, else of one end from the other segment.
inline double distance(const std::pair<Vec3, Vec3>& a, const std::pair<Vec3, Vec3>& b) {
  const auto to_segment = [](const Vec3& x, const std::pair<Vec3, Vec3>& s) {
    const Vec3 d = s.second - s.first;
    return (x - s.first - std::clamp(d.dot(x - s.first) / d.squaredNorm(), 0.0, 1.0) * d).norm();
  };
  double least =
      std::min({to_segment(a.first, b), to_segment(a.second, b), to_segment(b.first, a), to_segment(b.second, a)});
  const Vec3 d = a.second - a.first, e = b.second - b.first, n = d.cross(e), w = b.first - a.first;
  if (n.norm() > 1e-12) {
    const double s = w.cross(e).dot(n) / n.squaredNorm(), t = w.cross(d).dot(n) / n.squaredNorm();
    if (s > 0.0 && s < 1.0 && t > 0.0 && t < 1.0) least = std::min(least, std::abs(w.dot(n)) / n.norm());
  }
  return least;
}

inline double angle(const Vec3& a, const Vec3& b) {
  return std::acos(std::clamp(a.normalized().dot(b.normalized()), -1.0, 1.0));
}

/// det B, det C and det N: rows e^_i, e~_i and d^_i x w^_i.
inline Vec3 determinants(const Geometry& g, const Configuration& c) {
  const ninedof::Legs legs = ninedof::legs(g, c);
  Mat3 b, upper, n;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    b.row(row) = legs.e_hat[i];
    upper.row(row) = legs.e_tilde[i];
    const Vec3 d = g.base_external()[i] - c.internal_point, w = c.position + legs.u[i] - c.internal_point;
    n.row(row) = d.normalized().cross(w.normalized());
  }
  return {b.determinant(), upper.determinant(), n.determinant()};
}

/// The extremes of what a limit of lengths, ratios or angles measures, in its unit.
struct Range {
  double least = infinity, most = -infinity;
  void add(double value) {
    least = std::min(least, value);
    most = std::max(most, value);
  }
};

/// Two loads, weights of every body, and O where its legs are slowest.
inline std::shared_ptr<const ninedof::Duty> duty() {
  ninedof::Duty out;
  out.loads = {{{1.0, -0.5, 2.0}, {3.0, 2.0, -8.0}, Vec3::Zero()}, {{0.0, 3.0, 0.0}, {-4.0, 1.0, 2.0}, Vec3::Zero()}};
  out.masses.platform = 0.7;
  out.masses.centre = {0.1, -0.2, 0.4};
  out.masses.cylinder.setConstant(0.2);
  out.masses.rod.setConstant(0.1);
  out.masses.cylinder_centre.setConstant(0.5);
  out.masses.rod_centre.setConstant(0.3);
  out.masses.internal_point = 0.05;
  out.gravity = {0.5, 0.0, -9.81};
  out.motion = {ninedof::InternalMotion::least, 0.6, 0.4, {}};
  return std::make_shared<const ninedof::Duty>(out);
}

/// A limit of a row of the table, with every side that it has.
inline Limit limit_of(const ninedof::ConstraintInfo& row) {
  using enum ninedof::LimitKind;
  Limit out{.name = row.name, .steps = 3};
  if (*row.needs != '\0') out.duty = duty();
  if (row.sides != ninedof::LimitSides::only_low)
    out.high = row.kind == angle    ? 0.8
               : row.kind == number ? 30.0
               : row.kind == rate   ? 1.0
               : row.kind == power  ? 20.0
                                    : 3.0;
  if (row.sides != ninedof::LimitSides::only_high) out.low = row.kind == sign ? 0.05 : 0.5;
  return out;
}

/// Of every row of the table each side, in each unit; a cone about the legs' own directions and about an axis.
inline std::vector<Limit> every_limit() {
  std::vector<Limit> out;
  for (const ninedof::ConstraintInfo& row : ninedof::constraint_table())
    for (const bool other : {false, true}) {
      Limit both = limit_of(row);
      if (other && row.of == Unit::length && row.kind != ninedof::LimitKind::angle) continue;
      if (other && row.kind == ninedof::LimitKind::angle) both.axis = {1.0, -0.5, 0.3};
      if (other) both.of = row.of;
      Limit low = both, high = both;
      low.high = infinity;
      high.low = -infinity;
      if (row.sides != ninedof::LimitSides::only_low) out.push_back(high);
      if (row.sides != ninedof::LimitSides::only_high) out.push_back(low);
    }
  return out;
}

inline Range measured(const Limit& limit, const Design& d) {
  const Geometry& g = d.geometry;
  const double zp = d.at.front().position.z();
  const double unit = limit.of == Unit::zp       ? zp
                      : limit.of == Unit::radius ? std::max(widest(g, true), widest(g, false))
                                                 : 1.0;
  const std::string& name = limit.name;
  std::vector<ninedof::Vec9> lengths;
  for (const Configuration& c : d.looked(limit)) lengths.push_back(ninedof::leg_lengths(g, c));
  Range out, all;
  std::array<Range, 9> each;
  for (const ninedof::Vec9& l : lengths)
    for (std::size_t k = 0; k < 9; ++k) {
      all.add(l[static_cast<Eigen::Index>(k)]);
      each[k].add(l[static_cast<Eigen::Index>(k)]);
    }
  if (name == "radius_ratio") out.add(widest(g, true) / widest(g, false));
  if (name == "leg_ratio") out.add(all.most / all.least);
  if (name == "zs_fraction") out.add(d.at.front().internal_point.z() / zp);
  if (name == "height") out.add(zp);
  if (name == "footprint") out.add(widest(g, true));
  for (std::size_t k = 0; k < 9; ++k) {
    if (name == "stroke_ratio") out.add(each[k].most / each[k].least);
    if (name == "stroke") out.add((each[k].most - each[k].least) / unit);
    const char* kind = k < 3 ? "external_length" : k < 6 ? "upper_length" : "lower_length";
    if (name == "leg_length" || name == kind) {
      out.add(each[k].least / unit);
      out.add(each[k].most / unit);
    }
  }
  for (const bool base : {true, false}) {
    const std::vector<Vec3> body = joints(g, base);
    for (std::size_t i = 0; i < 6; ++i) {
      if (name == "joint_height") out.add(std::abs(body[i].z()) / unit);
      for (std::size_t j = 0; j < i; ++j)
        if (name == "joint_spacing")
          out.add((body[i] - body[j]).norm() / (limit.of == Unit::radius ? widest(g, base) : 1.0));
    }
  }
  if (name == "fault_tolerant")
    for (const Configuration& c : d.looked(limit))
      for (Eigen::Index k = 3; k < 9; ++k) {
        Eigen::Matrix<double, 6, 9> j = ninedof::jacobian(g, c, d.characteristic_length);
        j.col(k).setZero();
        const Eigen::VectorXd sigma = Eigen::JacobiSVD<Eigen::MatrixXd>(j).singularValues();
        out.add(sigma[0] / sigma[5]);
      }
  if (limit.duty != nullptr)
    for (const Configuration& c : d.looked(limit)) {
      const ninedof::Duty& duty = *limit.duty;
      ninedof::Vec9 force = ninedof::Vec9::Zero(), one = ninedof::Vec9::Ones();
      for (const ninedof::Load& load : duty.loads)
        force = force.cwiseMax(ninedof::inverse_dynamics(g, {c}, duty.masses, duty.gravity, load).forces.cwiseAbs());
      const ninedof::Vec9 rate = name.ends_with("force") ? one : ninedof::largest_leg_rates(g, c, duty.motion);
      const ninedof::Vec9 value = (name.ends_with("rate") ? one : force).cwiseProduct(rate);
      const int first = name.starts_with("upper") ? 3 : name.starts_with("lower") ? 6 : 0;
      out.add(value.segment(first, name.find('_') == std::string::npos ? 9 : 3).maxCoeff());
    }
  if (name == "leg_clearance")
    for (const Configuration& c : d.looked(limit)) {
      const auto legs = segments(g, c);
      for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = i + 1; j < 9; ++j) {
          const auto same = [](const Vec3& a, const Vec3& b) { return (a - b).norm() < 1e-12; };
          const auto &a = legs[i], &b = legs[j];
          if (!same(a.first, b.first) && !same(a.second, b.second) && !same(a.second, b.first))
            out.add(distance(a, b) / unit);
        }
    }
  if (name.starts_with("base_cone") || name.starts_with("platform_cone"))
    for (const Configuration& c : d.looked(limit))
      for (std::size_t k = name.ends_with("internal") ? 3 : 0; k < (name.ends_with("external") ? 3U : 6U); ++k) {
        const bool platform = name.starts_with("platform");
        const std::size_t leg = k < 3 || platform ? k : k + 3;
        const auto away = [&](const Configuration& where) -> Vec3 {  // from the joint, in its body's frame
          const auto [from, to] = segments(g, where)[leg];
          if (!platform) return to - from;
          const Vec3 direction = k < 3 ? from - to : to - from;
          return where.rotation.transpose() * direction;
        };
        out.add(angle(away(c), limit.axis.isZero(0.0) ? away(d.at.front()) : limit.axis));
      }
  return out;
}

/// The smallest margin of a limit, as docs/study-file.md defines it.
inline double margin(const Problem& p, const Limit& limit, const Eigen::VectorXd& x) {
  if (limit.name == "singularity_free") {
    const Vec3 home = determinants(hand::design(p, x).geometry, hand::design(p, x).at.front());
    if (limit.at == ninedof::LimitAt::neutral) return home.cwiseAbs().minCoeff() - limit.low;
    double least = infinity;
    for (int step = 0; step <= limit.steps; ++step) {
      const Design d = hand::design(p, x, static_cast<double>(step) / limit.steps);
      for (const Configuration& c : d.at) {
        const Vec3 now = determinants(d.geometry, c);
        for (Eigen::Index k = 0; k < 3; ++k) least = std::min(least, now[k] * std::copysign(1.0, home[k]) - limit.low);
      }
    }
    return least;
  }
  const Range range = measured(limit, hand::design(p, x));
  double least = infinity;
  if (limit.high < infinity) least = std::min(least, 1.0 - range.most / limit.high);
  if (limit.low > 0.0) least = std::min(least, range.least / limit.low - 1.0);
  return least;
}

}  // namespace hand
