#include "workspace/cells/volume_estimate.hpp"

#include <algorithm>
#include <cmath>

namespace ninedof {
namespace {

constexpr double guard = 0.1;          // least error, relative to the last change
constexpr double unconfirmed = 2.0;  // on the first move of the extrapolation: that the next is smaller is not known
constexpr double random_signs = 2.0;  // standard deviations of a sum of differences with random signs
constexpr double coarse_share = 0.25;  // of the volume: while more than this changes, the cells are too coarse
constexpr double rounding = 1e-13;  // relative

/// The size of a sum of differences: at least what it would be if their signs were random. So differences that cancel
/// by chance are not taken for small ones.
double spread(const std::vector<double>& differences) {
  double sum = 0.0, squares = 0.0;
  for (const double one : differences) {
    sum += one;
    squares += one * one;
  }
  return std::max(std::abs(sum), random_signs * std::sqrt(squares));
}

}  // namespace

void VolumeEstimate::set(const LevelVolumes& level) {
  better_ = level.held;
  volume_ = 0.0;
  for (std::size_t n = 0; n < better_.size(); ++n) {
    // The error falls by a factor of four from level to level, so that a third of the last change remains.
    better_[n] += level.change[n] / 3.0;
    volume_ += better_[n];
  }
  const double changed = spread(level.change);
  error_ = rounding * volume_;
  if (levels_ == 1) {
    // The first extrapolation has none to be compared with.
    moved_ = 4.0 * guard * changed;
    error_ += 2.0 * changed;
  } else if (levels_ > 1) {
    std::vector<double> difference = better_;
    for (std::size_t n = 0; n < difference.size(); ++n) difference[n] -= before_[n];
    moved_ = spread(difference);
    const double doubt = levels_ == 2 ? unconfirmed : 1.0;
    error_ += std::max({doubt * moved_, 0.25 * moved_before_, guard * changed});
  }
  if (levels_ == 0 || changed > coarse_share * volume_) error_ = std::max(error_, level.undecided);
}

void VolumeEstimate::keep() {
  before_ = better_;
  moved_before_ = moved_;
  ++levels_;
}

}  // namespace ninedof
