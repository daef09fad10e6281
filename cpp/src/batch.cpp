#include "ninedof/batch.hpp"

#include "ninedof/legs.hpp"
#include "ninedof/singularity.hpp"

namespace ninedof::batch {
namespace {

Configuration at(const Configurations& c, long k) {
  using RowMajor3 = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;
  return {Eigen::Map<const Vec3>(c.position + k * c.position_step),
          Eigen::Map<const RowMajor3>(c.rotation + k * c.rotation_step),
          Eigen::Map<const Vec3>(c.internal_point + k * c.internal_point_step)};
}

}  // namespace

void leg_lengths(const Geometry& g, const Configurations& c, double* out) {
  for (long k = 0; k < c.count; ++k) Eigen::Map<Vec9>(out + 9 * k) = ninedof::leg_lengths(g, at(c, k));
}

void condition_numbers(const Geometry& g, const Configurations& c, const Lengths& lc, Norm norm, double* out) {
  for (long k = 0; k < c.count; ++k) out[k] = condition_number(g, at(c, k), lc.value[k * lc.step], norm);
}

void singular_values(const Geometry& g, const Configurations& c, const Lengths& lc, double* out) {
  for (long k = 0; k < c.count; ++k)
    Eigen::Map<Vec6>(out + 6 * k) = ninedof::singular_values(g, at(c, k), lc.value[k * lc.step]);
}

void singularity_margins(const Geometry& g, const Configurations& c, double* out) {
  for (long k = 0; k < c.count; ++k) {
    const PerMechanism margins = ninedof::singularity_margins(g, at(c, k));
    out[3 * k] = margins.m;
    out[3 * k + 1] = margins.b;
    out[3 * k + 2] = margins.c;
  }
}

}  // namespace ninedof::batch
