#pragma once
/// The index of one pose as rows: smooth functions of the design whose maximum is the logarithm of the index.

#include <algorithm>
#include <span>

#include "ninedof/problem/objective.hpp"
#include "problem/design_state.hpp"

namespace ninedof {

/// Logarithms of the singular values of M at one pose with their derivatives: the four distinct ones of the closed form
/// on the axis, or all six, descending.
struct PoseSpectrum {
  bool closed = false;
  Eigen::Matrix<double, 6, 1> log_sigma;
  Rows gradient;      ///< one row each
  Spectrum general;   ///< where log_sigma has all six
  double log_max() const { return closed ? std::max(log_sigma[0], log_sigma[2]) : log_sigma[0]; }
  double log_min() const { return closed ? std::min(log_sigma[1], log_sigma[3]) : log_sigma[5]; }
};

/// Entries of log_sigma that may be the largest, and the smallest.
std::span<const int> tops_of(bool closed);
std::span<const int> bottoms_of(bool closed);

/// All six singular values of the nine-legged robot at poses, no more than SpectrumStack::most; without `derivatives`
/// the gradients are not computed.
void general_spectra(const DesignState& v, std::span<const int> poses, std::span<PoseSpectrum* const> out,
                     bool derivatives = true);
/// The gradient afterwards.
void differentiate_spectrum(const DesignState& v, int pose, PoseSpectrum& out);

/// The four singular values of the closed form, at a pose on the axis.
void closed_spectrum(const DesignFamily& family, const DesignState& v, const PoseSpec& spec, Machine machine,
                     PoseSpectrum& out);

/// Adds `scale` times the derivatives of log_sigma[k], whether or not the spectrum has its gradient.
void add_log_sigma(const DesignState& v, int pose, const PoseSpectrum& s, int k, double scale, Row out);

/// The logarithm of the index of a pose; adds its derivatives, of the largest row alone.
double add_index(Index index, const DesignState& v, int pose, const PoseSpectrum& s, Row out);

/// Number of rows of a pose.
int index_rows(Index index, bool closed);

/// Writes the rows of a pose to `value` and `gradient`, from row `row` on.
void fill_index(Index index, const PoseSpectrum& s, int row, Eigen::VectorXd& value, Rows& gradient);

/// The same for a pose off the axis, smoothed: epsilon log sum exp(. / epsilon) of the logarithms in place of the
/// largest and the smallest singular value. One row; the others are set far below it.
void fill_soft_index(Index index, const PoseSpectrum& s, double epsilon, int row, Eigen::VectorXd& value,
                     Rows& gradient);

}  // namespace ninedof
