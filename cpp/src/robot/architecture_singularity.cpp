#include "ninedof/robot/architecture_singularity.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "math/linear/jacobi_svd.hpp"
#include "robot/triangle.hpp"

namespace ninedof {
namespace {

/// The sides of a triangle in ascending order, and its least height.
struct TriangleSides {
  explicit TriangleSides(const Triple& t) : side{(t[1] - t[0]).norm(), (t[2] - t[1]).norm(), (t[0] - t[2]).norm()} {
    std::ranges::sort(side);
    height = side[2] * relative_height(t, side[2]);
  }
  /// The radius of the least circle about the triangle: half the longest side, or the circumradius.
  double radius() const {
    const double a = side[0] / side[2], b = side[1] / side[2];
    return a * a + b * b <= 1.0 ? 0.5 * side[2] : 0.5 * a * b * side[2] * (side[2] / height);
  }

  std::array<double, 3> side;
  double height;
};

/// Columns: the joints from their centre.
Mat3 centred(const Triple& t) {
  Mat3 out;
  for (std::size_t i = 0; i < 3; ++i)
    out.col(static_cast<Eigen::Index>(i)) = ((t[i] - t[(i + 1) % 3]) + (t[i] - t[(i + 2) % 3])) / 3.0;
  return out / out.cwiseAbs().maxCoeff();  // only the shape counts: squares neither underflow nor overflow
}

}  // namespace

ArchitectureSingularity nearest_architecture_singularity(const Geometry& g) {
  using enum ArchitectureClass;
  const Triple &r = g.base_external(), &u = g.platform_external();
  const TriangleSides base(r), platform(u), lower(g.base_internal()), upper(g.platform_internal());
  const double size = std::max({base.side[2], platform.side[2], lower.side[2], upper.side[2]});
  std::array<ArchitectureSingularity, 7> classes{{{lower_on_line, 0, 0, 0.5 * lower.height, 0.0},
                                                  {upper_on_line, 0, 0, 0.5 * upper.height, 0.0},
                                                  {base_in_point, 0, 0, base.radius(), 0.0},
                                                  {platform_in_point, 0, 0, platform.radius(), 0.0}}};
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t a = i == 2 ? 0 : i, b = i == 2 ? 2 : i + 1;
    const double apart = std::max((r[a] - r[b]).norm(), (u[a] - u[b]).norm());
    classes[4 + i] = {legs_coincide, static_cast<int>(a), static_cast<int>(b), 0.5 * apart, 0.0};
  }
  ArchitectureSingularity out = *std::ranges::min_element(classes, {}, &ArchitectureSingularity::distance);
  out.relative = out.distance / size;
  return out;
}

double homothety_residual(const Geometry& g, const Mat3& rotation) {
  const Mat3 r = centred(g.base_external()), u = rotation * centred(g.platform_external());
  return (r - (r.cwiseProduct(u).sum() / u.squaredNorm()) * u).norm() / r.norm();
}

SimilarTriangles similar_triangles(const Geometry& g) {
  // The rotation with the greatest trace of Q^T r u^T (Kabsch). r u^T has rank 2: the sign of the third axis is free.
  const Svd<3> svd = jacobi_svd(Mat3(centred(g.base_external()) * centred(g.platform_external()).transpose()));
  const double sign = (svd.u * svd.v.transpose()).determinant() < 0.0 ? -1.0 : 1.0;
  const auto with = [&](double factor) -> Mat3 {
    return svd.u * Vec3(factor, factor, sign).asDiagonal() * svd.v.transpose();
  };
  const Mat3 rotation = with(1.0);
  return {homothety_residual(g, rotation), {rotation, with(-1.0)}};
}

}  // namespace ninedof
