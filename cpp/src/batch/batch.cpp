#include "ninedof/batch/batch.hpp"

#include <algorithm>
#include <cmath>

#include "batch/kernels/dispatch.hpp"
#include "math/numbers.hpp"
#include "ninedof/conditioning/axis_spectrum.hpp"
#include "ninedof/math/error.hpp"
#include "ninedof/math/length_range.hpp"
#include "ninedof/robot/hexagon.hpp"
#include "ninedof/robot/legs.hpp"
#include "ninedof/singularity/singularity.hpp"

namespace ninedof::batch {
namespace {

Configuration at(const Configurations& c, long k) {
  using RowMajor3 = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;
  return {Eigen::Map<const Vec3>(c.position + k * c.position_step),
          Eigen::Map<const RowMajor3>(c.rotation + k * c.rotation_step),
          Eigen::Map<const Vec3>(c.internal_point + k * c.internal_point_step)};
}

void copy(const Triple& t, double (&to)[3][3]) {
  for (std::size_t i = 0; i < 3; ++i) std::copy(t[i].begin(), t[i].end(), to[i]);
}

kernels::Block block(const Geometry& g, const Configurations& c, const Lengths& lc = {}) {
  kernels::Block b{};
  copy(g.base_external(), b.robot.base_external);
  copy(g.base_internal(), b.robot.base_internal);
  copy(g.platform_external(), b.robot.platform_external);
  copy(g.platform_internal(), b.robot.platform_internal);
  b.position = c.position;
  b.rotation = c.rotation;
  b.internal_point = c.internal_point;
  b.length = lc.value;
  b.position_step = c.position_step;
  b.rotation_step = c.rotation_step;
  b.internal_point_step = c.internal_point_step;
  b.length_step = lc.step;
  b.count = c.count;
  return b;
}

void require_lengths(const Lengths& lc, long count) {
  for (long k = 0; k < (lc.step == 0 ? std::min(count, 1L) : count); ++k)
    require_length("characteristic_length", lc.value[k * lc.step]);
}

/// Calls accurate(k, row) for the rows that a kernel has marked as unsure.
template <class Accurate>
void recompute_unsure(long count, long width, double* out, const Accurate& accurate) {
  for (long k = 0; k < count; ++k)
    if (out[k * width] == kernels::unsure) accurate(k, out + k * width);
}

}  // namespace

void leg_lengths(const Geometry& g, const Configurations& c, double* out) {
  kernels::table().leg_lengths(block(g, c), out);
  recompute_unsure(c.count, 9, out,
                   [&](long k, double* to) { Eigen::Map<Vec9>{to} = ninedof::leg_lengths(g, at(c, k)); });
}

void condition_numbers(const Geometry& g, const Configurations& c, const Lengths& lc, Norm norm, double* out) {
  require_lengths(lc, c.count);
  const kernels::Table& table = kernels::table();
  (norm == Norm::two ? table.condition_numbers : table.frobenius_condition_numbers)(block(g, c, lc), out);
  recompute_unsure(c.count, 1, out,
                   [&](long k, double* to) { *to = condition_number(g, at(c, k), lc.value[k * lc.step], norm); });
}

void singular_values(const Geometry& g, const Configurations& c, const Lengths& lc, double* out) {
  require_lengths(lc, c.count);
  kernels::table().singular_values(block(g, c, lc), out);
  recompute_unsure(c.count, 6, out, [&](long k, double* to) {
    Eigen::Map<Vec6>{to} = ninedof::singular_values(g, at(c, k), lc.value[k * lc.step]);
  });
}

void singularity_margins(const Geometry& g, const Configurations& c, double* out) {
  kernels::table().singularity_margins(block(g, c), out);
  recompute_unsure(c.count, 3, out, [&](long k, double* to) {
    const PerMechanism margins = ninedof::singularity_margins(g, at(c, k));
    to[0] = margins.n;
    to[1] = margins.b;
    to[2] = margins.c;
  });
}

void hexagonal_condition_numbers(const double* designs, long count, double* out) {
  kernels::table().hexagonal_condition_numbers(designs, count, out);
  recompute_unsure(count, 1, out, [&](long k, double* to) {
    const double* x = designs + 6 * k;
    // Beyond the range a side or a height is so large beside the characteristic length that no design is regular.
    if (std::any_of(x, x + 6, [](double length) { return std::abs(length) > most_length; })) {
      *to = std::any_of(x, x + 6, [](double length) { return std::isnan(length); }) ? not_a_number : infinity;
      return;
    }
    const Xyz<double> base = hexagon_joint_1(x[0], x[1]), platform = hexagon_joint_1(x[2], x[3]);
    const AxisSpectrum<double> s = axis_spectrum_of_any_size(
        AxisDesign<double>{base, mirrored(base), platform, mirrored(platform), x[4], x[5]}, 1.0);
    const double high = std::max(s.axial_max, s.transverse_max), low = std::min(s.axial_min, s.transverse_min);
    *to = low <= negligible * high ? infinity : high / low;
  });
}

const char* simd_level() {
  return kernels::table().level;
}

}  // namespace ninedof::batch
