#include <Eigen/Geometry>
#include <cmath>
#include <limits>

#include "batch/floor/floor.hpp"
#include "batch/kernels/dispatch.hpp"
#include "ninedof/batch/batch.hpp"
#include "ninedof/conditioning/conditioning.hpp"

namespace bench {
namespace {

using ninedof::Vec3;

/// Moves O along the normal of a triangle of joints to the given distance from its plane.
Vec3 above(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& o, double distance) {
  const Vec3 normal = (b - a).cross(c - a).normalized();
  return o + (distance - normal.dot(o - a)) * normal;
}

/// All poses with O at 1 to 1e-9 from the plane of the lower joints, or of the upper ones.
void bring_near(File& file) {
  const ninedof::Geometry g = file.geometry();
  for (std::size_t k = 0; k < file.count(); ++k) {
    const ninedof::Configuration c = file.configuration(k);
    const double distance = std::pow(10.0, -9.0 * static_cast<double>(k % 1000) / 999.0);
    const auto joint = [&](std::size_t i) -> Vec3 {
      if (k % 2 == 0) return g.base_internal()[i];
      return c.position + c.rotation * g.platform_internal()[i];
    };
    Eigen::Map<Vec3>(file.pose(k) + 12) = above(joint(0), joint(1), joint(2), c.internal_point, distance);
  }
}

}  // namespace

Accuracy accuracy(const File& original, bool near_singular) {
  File file = original;
  if (near_singular) bring_near(file);
  const ninedof::Geometry g = file.geometry();
  const double lc = file.characteristic_length();
  const auto count = static_cast<long>(file.count());
  constexpr long step = File::width;
  const double* x = file.pose(0);

  ninedof::kernels::Block block{};
  static_assert(sizeof block.robot == 36 * sizeof(double));
  std::copy_n(file.numbers.data(), 36, &block.robot.base_external[0][0]);
  block.position = x;
  block.rotation = x + 3;
  block.internal_point = x + 12;
  block.length = &lc;
  block.position_step = block.rotation_step = block.internal_point_step = step;
  block.count = count;
  std::vector<double> kappa(file.count());
  Accuracy out;
  ninedof::kernels::table().condition_numbers(block, kappa.data());
  for (const double k : kappa) out.handed_over += k == ninedof::kernels::unsure;

  ninedof::batch::condition_numbers(g, {x, x + 3, x + 12, count, step, step, step}, {&lc, 0}, ninedof::Norm::two,
                                    kappa.data());
  for (std::size_t k = 0; k < kappa.size(); ++k) {
    const double expected = ninedof::condition_number(g, file.configuration(k), lc);
    if (std::isinf(expected) && kappa[k] == expected) continue;
    const double error = std::abs(kappa[k] / expected - 1.0) / std::max(1.0, expected / 1e3);
    if (!(error <= out.error)) out.error = std::isnan(error) ? std::numeric_limits<double>::infinity() : error;
    out.most_condition = std::max(out.most_condition, expected);
  }
  return out;
}

}  // namespace bench
