#include "problem/pose_index.hpp"

#include <cmath>

#include "batch/spectrum_stack.hpp"

namespace ninedof {
namespace {

constexpr double tiny = AxisPoint::vanished;
constexpr std::array<int, 2> closed_tops{AxisPoint::axial_max, AxisPoint::transverse_max};
constexpr std::array<int, 2> closed_bottoms{AxisPoint::axial_min, AxisPoint::transverse_min};
constexpr std::array<int, 3> general_tops{0, 1, 2}, general_bottoms{5, 4, 3};

/// Multiplicity of a singular value.
double multiplicity(bool closed, int k) {
  return closed && k >= AxisPoint::transverse_max ? 2.0 : 1.0;
}

/// The place of the largest of some singular values, and of the smallest.
int largest(const PoseSpectrum& s, std::span<const int> of) {
  return *std::ranges::max_element(of, {}, [&](int k) { return s.log_sigma[k]; });
}
int smallest(const PoseSpectrum& s, std::span<const int> of) {
  return *std::ranges::min_element(of, {}, [&](int k) { return s.log_sigma[k]; });
}

bool vanished(double sigma) {
  return !(sigma > tiny);
}

/// So near a singularity that squares under- or overflow there are no slopes.
void drop_infinite(PoseSpectrum& s) {
  if (!s.gradient.allFinite()) s.gradient.setZero();
}

/// log |J'|_F |J'^+|_F and its derivatives with respect to the logarithms of the singular values.
double frobenius(const PoseSpectrum& s, std::array<double, 6>& slope) {
  const int count = s.closed ? 4 : 6;
  double largest = s.log_max(), smallest = s.log_min(), sum = 0.0, inverse_sum = 0.0;
  for (int k = 0; k < count; ++k) {
    sum += multiplicity(s.closed, k) * std::exp(2.0 * (s.log_sigma[k] - largest));
    inverse_sum += multiplicity(s.closed, k) * std::exp(2.0 * (smallest - s.log_sigma[k]));
  }
  for (int k = 0; k < count; ++k)
    slope[at_index(k)] = multiplicity(s.closed, k) * (std::exp(2.0 * (s.log_sigma[k] - largest)) / sum -
                                                      std::exp(2.0 * (smallest - s.log_sigma[k])) / inverse_sum);
  return largest - smallest + 0.5 * std::log(sum) + 0.5 * std::log(inverse_sum);
}

}  // namespace

std::span<const int> tops_of(bool closed) {
  return closed ? std::span<const int>(closed_tops) : std::span<const int>(general_tops);
}
std::span<const int> bottoms_of(bool closed) {
  return closed ? std::span<const int>(closed_bottoms) : std::span<const int>(general_bottoms);
}

void general_spectra(const DesignState& v, std::span<const int> poses, std::span<PoseSpectrum* const> out,
                     bool derivatives) {
  std::array<const PosedPoints*, SpectrumStack::most> at;
  std::ranges::transform(poses, at.begin(), [&](int pose) { return &v.pose(pose); });
  const SpectrumStack stack({at.data(), poses.size()}, v.characteristic_length);
  for (std::size_t n = 0; n < poses.size(); ++n) {
    PoseSpectrum& s = *out[n];
    s.closed = false;
    s.general = stack.spectrum(n);
    const Vec6& sigma = s.general.sigma;
    for (int k = 0; k < 6; ++k) s.log_sigma[k] = std::log(!vanished(sigma[k]) ? sigma[k] : k == 0 ? 1.0 : tiny);
    s.gradient.setZero(6, v.columns());
    for (int k = 0; derivatives && k < 6; ++k)
      if (!vanished(sigma[k])) v.add(poses[n], stack.slopes(n, s.general, k), s.gradient.row(k));
    drop_infinite(s);
  }
}

void differentiate_spectrum(const DesignState& v, int pose, PoseSpectrum& out) {
  out.gradient.setZero(6, v.columns());
  for (int k = 0; k < 6; ++k) add_log_sigma(v, pose, out, k, 1.0, out.gradient.row(k));
  drop_infinite(out);
}

void add_log_sigma(const DesignState& v, int pose, const PoseSpectrum& s, int k, double scale, Row out) {
  if (s.closed) {
    out += scale * s.gradient.row(k);
    return;
  }
  const double sigma = s.general.sigma[k];
  if (vanished(sigma)) return;
  PointGradient g = zero_gradient();
  add_spectrum_gradient(v.pose(pose).at, v.pose(pose).legs, s.general, k, k, scale * 0.5 / (sigma * sigma), g);
  v.add(pose, g, out);
}

double add_index(Index index, const DesignState& v, int pose, const PoseSpectrum& s, Row out) {
  if (index == Index::frobenius) {
    std::array<double, 6> slope{};
    const double value = frobenius(s, slope);
    for (int k = 0; k < (s.closed ? 4 : 6); ++k) add_log_sigma(v, pose, s, k, slope[at_index(k)], out);
    return value;
  }
  const int top = largest(s, tops_of(s.closed)), bottom = smallest(s, bottoms_of(s.closed));
  add_log_sigma(v, pose, s, top, 1.0, out);
  if (index == Index::speed) return s.log_sigma[top];
  add_log_sigma(v, pose, s, bottom, -1.0, out);
  return s.log_sigma[top] - s.log_sigma[bottom];
}

void closed_spectrum(const DesignFamily& family, const DesignState& v, const PoseSpec& spec, Machine machine,
                     PoseSpectrum& out) {
  const Pose& pose = spec.pose;
  AxisShift shift;
  (pose.in_zp ? shift.p_in_zp : shift.p) = pose.position.z();
  (pose.in_zp ? shift.s_in_zp : shift.s) = pose.internal.z();
  shift.turn = pose.rotation.z();
  shift.tool = v.tool.position.z();
  if (spec.offset[2] >= 0) shift.s_in_zp += v.x[spec.offset[2]];
  AxisPoint point;
  const std::size_t own = family.variables().size();
  family.axis({v.x.data(), own}, v.characteristic_length, shift, machine, point);
  out.closed = true;
  out.log_sigma.head<4>() = point.value;
  out.gradient.setZero(4, v.columns());
  const int zs = family.index("zs");
  for (int k = 0; k < 4; ++k) {
    v.add_variables(point.gradient.row(k), out.gradient.row(k));
    if (spec.coordinate[2] >= 0) out.gradient(k, spec.coordinate[2]) += v.blueprint.zp * point.gradient(k, zs);
  }
}

int index_rows(Index index, bool closed) {
  const int each = static_cast<int>(tops_of(closed).size());
  switch (index) {
    case Index::condition_number:
    case Index::six_legged: return each * each;
    case Index::speed: return each;
    case Index::frobenius: return 1;
  }
  return 0;
}

void fill_index(Index index, const PoseSpectrum& s, int row, Eigen::VectorXd& value, Rows& gradient) {
  if (index == Index::frobenius) {
    std::array<double, 6> slope{};
    value[row] = frobenius(s, slope);
    gradient.row(row).setZero();
    for (Eigen::Index k = 0; k < s.gradient.rows(); ++k) gradient.row(row) += slope[at_index(k)] * s.gradient.row(k);
    return;
  }
  for (const int top : tops_of(s.closed)) {
    if (index == Index::speed) {
      value[row] = s.log_sigma[top];
      gradient.row(row++) = s.gradient.row(top);
      continue;
    }
    for (const int bottom : bottoms_of(s.closed)) {
      value[row] = s.log_sigma[top] - s.log_sigma[bottom];
      gradient.row(row++) = s.gradient.row(top) - s.gradient.row(bottom);
    }
  }
}

void fill_soft_index(Index index, const PoseSpectrum& s, double epsilon, int row, Eigen::VectorXd& value,
                     Rows& gradient) {
  constexpr double far_below = -1e3;
  const int rows = index_rows(index, false);
  value.segment(row, rows).setConstant(far_below);
  gradient.middleRows(row, rows).setZero();
  const Vec6 up = ((s.log_sigma.array() - s.log_max()) / epsilon).exp();
  value[row] = s.log_max() + epsilon * std::log(up.sum());
  gradient.row(row) = up.transpose() / up.sum() * s.gradient;
  if (index == Index::speed) return;
  const Vec6 down = ((s.log_min() - s.log_sigma.array()) / epsilon).exp();
  value[row] -= s.log_min() - epsilon * std::log(down.sum());
  gradient.row(row) -= down.transpose() / down.sum() * s.gradient;
}

}  // namespace ninedof
