/// Declared in ninedof/singularity/singularity.hpp.
///
/// distance_to_singularity: the first zero of each determinant along p + t pdot, exp(t omega) Q, s + t sdot. Only the
/// numerators are used, which stay smooth where a leg or a direction vanishes:
///   B  height of O over the plane of the lower joints, linear in t;
///   C  height of O over the plane of the upper joints, linear in t times trigonometric in |omega| t;
///   N  det[d_i x w_i], d_i linear, w_i linear plus trigonometric.

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

#include "math/numbers.hpp"
#include "math/roots/first_root.hpp"
#include "ninedof/math/error.hpp"
#include "ninedof/singularity/singularity.hpp"

namespace ninedof {
namespace {

/// The unit normal of three points and its rounding error, which is large for a thin triangle.
struct Normal {
  explicit Normal(const Triple& t) {
    const Vec3 a = t[1] - t[0], b = t[2] - t[0], raw = a.cross(b);
    const double size = t[0].norm() + t[1].norm() + t[2].norm();
    unit = raw / raw.norm();
    error = 8.0 * eps * (a.norm() * b.norm() + size * (a.norm() + b.norm())) / raw.norm();
  }
  Vec3 unit;
  double error;
};

/// The largest coordinate, rounded to a power of two: division by it is exact, and products of nine do not overflow.
double length_unit(const Geometry& g, const Configuration& c) {
  double largest = std::max(c.position.cwiseAbs().maxCoeff(), c.internal_point.cwiseAbs().maxCoeff());
  for (const Triple* t : {&g.base_external(), &g.base_internal(), &g.platform_external(), &g.platform_internal()})
    for (const Vec3& joint : *t) largest = std::max(largest, joint.cwiseAbs().maxCoeff());
  return std::exp2(std::ilogb(largest));
}

/// Joints in base axes, lengths over the unit; the path of the configuration.
struct Path {
  Path(const Geometry& g, const Configuration& c, const Vec9& direction)
      : unit(length_unit(g, c)),
        p(c.position / unit),
        s(c.internal_point / unit),
        omega(direction.head<3>()),
        pdot(direction.segment<3>(3) / unit),
        sdot(direction.tail<3>() / unit) {
    for (std::size_t i = 0; i < 3; ++i) {
      r[i] = g.base_external()[i] / unit;
      r_hat[i] = g.base_internal()[i] / unit;
      u[i] = c.rotation * (g.platform_external()[i] / unit);
      u_tilde[i] = c.rotation * (g.platform_internal()[i] / unit);
    }
  }

  /// Time in which the robot moves by about its own size.
  double pace() const { return 1.0 / (omega.norm() + pdot.norm() + sdot.norm()); }

  double unit;
  Vec3 p, s, omega, pdot, sdot;
  Triple r, r_hat, u, u_tilde;
};

FirstRoot first_loss_of_b(const Path& path, double most) {
  const Normal normal(path.r_hat);
  const Line fixed{normal.unit, Vec3::Zero(), 1.0, normal.error};
  const Line from_plane{path.s - path.r_hat[0], path.sdot, path.s.norm() + path.r_hat[0].norm()};
  const auto height = [&](double t, double h) { return dot(fixed.at(t, h), from_plane.at(t, h), h); };
  return first_root(height, most, path.pace());
}

FirstRoot first_loss_of_c(const Path& path, double most) {
  const Normal normal(path.u_tilde);
  const Turning turning(normal.unit, path.omega, normal.error);
  const Line from_origin{path.s - path.p, path.sdot - path.pdot, path.s.norm() + path.p.norm()};
  // The plane keeps its distance from the platform's origin.
  const double plane = normal.unit.dot(path.u_tilde[0]), size = path.u_tilde[0].norm();
  const Enclosure<double> to_plane{
      {-plane, 0.0, 0.0}, {(8.0 * eps + normal.error) * size, 0.0, 0.0}, {std::abs(plane), 0.0, 0.0, 0.0}};
  const auto height = [&](double t, double h) { return dot(turning.at(t, h), from_origin.at(t, h), h) + to_plane; };
  return first_root(height, most, path.pace());
}

FirstRoot first_loss_of_n(const Path& path, double most) {
  std::array<Line, 3> d;
  std::array<Turning, 3> joint{Turning(path.u[0], path.omega), Turning(path.u[1], path.omega),
                               Turning(path.u[2], path.omega)};
  for (std::size_t i = 0; i < 3; ++i) d[i] = {path.r[i] - path.s, -path.sdot, path.r[i].norm() + path.s.norm()};
  const Line origin{path.p - path.s, path.pdot - path.sdot, path.p.norm() + path.s.norm()};
  const auto determinant = [&](double t, double h) {
    const Enclosure<Vec3> from_o = origin.at(t, h);
    std::array<Enclosure<Vec3>, 3> row;
    for (std::size_t i = 0; i < 3; ++i) row[i] = cross(d[i].at(t, h), from_o + joint[i].at(t, h), h);
    return dot(row[0], cross(row[1], row[2], h), h);
  };
  return first_root(determinant, most, path.pace());
}

}  // namespace

SingularityDistance distance_to_singularity(const Geometry& g, const Configuration& c, const Vec9& direction,
                                            double most) {
  require_positive("most", most);
  if (direction.array().isInf().any()) throw InvalidArgument("direction", "an infinite number", "finite numbers");
  if (direction.hasNaN() || c.position.hasNaN() || c.rotation.hasNaN() || c.internal_point.hasNaN())
    return {not_a_number, Mechanism::none, {not_a_number, not_a_number, not_a_number}, false};
  const Path path(g, c, direction);
  const FirstRoot n = first_loss_of_n(path, most), lower = first_loss_of_b(path, most),
                  upper = first_loss_of_c(path, most);
  SingularityDistance out{infinity, Mechanism::none, {n.at, lower.at, upper.at}, true};
  const auto consider = [&](const FirstRoot& root, Mechanism mechanism) {
    if (!(root.at < out.distance)) return;
    out.distance = root.at;
    out.mechanism = mechanism;
    out.resolved = root.resolved;
  };
  consider(n, Mechanism::n);
  consider(upper, Mechanism::c);
  consider(lower, Mechanism::b);
  return out;
}

}  // namespace ninedof
