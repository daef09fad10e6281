#pragma once
/// The singular values of M at many poses, and their derivatives, a block of poses at a time.

#include <array>
#include <span>

#include "batch/kernels/table.hpp"
#include "ninedof/conditioning/sensitivity.hpp"

namespace ninedof {

class SpectrumStack {
 public:
  static constexpr std::size_t most = 16;  // poses

  /// `poses` must stay. Throws InvalidArgument unless the characteristic length is finite and positive.
  SpectrumStack(std::span<const PosedPoints* const> poses, double characteristic_length);

  /// As `spectrum` has it.
  Spectrum spectrum(std::size_t pose) const;
  /// The derivatives of the logarithm of singular value k of it, which is not zero.
  PointGradient slopes(std::size_t pose, const Spectrum& s, int k) const;

 private:
  const double* row(std::size_t pose) const { return rows_.data() + pose * kernels::spectrum_numbers; }
  /// Whether the kernel has left it to the functions of one pose.
  bool alone(std::size_t pose) const { return *row(pose) == kernels::unsure; }

  std::span<const PosedPoints* const> poses_;
  double length_;
  std::array<double, most * kernels::spectrum_numbers> rows_;
  std::array<std::array<int, 6>, most> order_;  // of the singular values in each row, descending
};

}  // namespace ninedof
