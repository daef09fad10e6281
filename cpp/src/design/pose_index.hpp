#pragma once
/// The index of one pose as rows: smooth functions of the design, the largest of which is the logarithm of the index.

#include <array>
#include <span>

#include "design/design_state.hpp"
#include "ninedof/design/objective.hpp"

namespace ninedof {

/// Logarithms of singular values of M at one pose with their derivatives: the four distinct ones of the closed form on the
/// axis, or all six, descending.
struct PoseSpectrum {
  bool closed = false;
  Eigen::Matrix<double, 6, 1> log_sigma;
  Rows gradient;      ///< one row each
  Spectrum general;   ///< behind the six

  /// Rows that may be the largest, the smallest one.
  std::span<const int> tops() const;
  std::span<const int> bottoms() const;
  double log_max() const { return closed ? std::max(log_sigma[0], log_sigma[2]) : log_sigma[0]; }
  double log_min() const { return closed ? std::min(log_sigma[1], log_sigma[3]) : log_sigma[5]; }
};

/// Singular values of the nine-legged robot at a pose of the view, through the six values; without `derivatives` the gradient is
/// left as it was.
void general_spectrum(const DesignState& v, int pose, PoseSpectrum& out, bool derivatives = true);

/// Through the closed form: `shift` from the neutral configuration, s_z of the pose taken from `spec`.
void closed_spectrum(const DesignFamily& family, const DesignState& v, const PoseSpec& spec, Machine machine,
                     PoseSpectrum& out);

/// How many rows a pose has.
int index_rows(Index index, bool closed);

/// Fills `value` and `gradient` from row `row` on.
void fill_index(Index index, const PoseSpectrum& s, int row, Eigen::VectorXd& value, Rows& gradient);

/// The same for a pose off the axis without kinks: soft largest and smallest singular values, epsilon log sum exp(. / epsilon)
/// of the logarithms, which no meeting of singular values can make rough. One row; the others are left far below.
void fill_soft_index(Index index, const PoseSpectrum& s, double epsilon, int row, Eigen::VectorXd& value,
                     Rows& gradient);

}  // namespace ninedof
