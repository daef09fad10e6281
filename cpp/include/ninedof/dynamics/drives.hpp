#pragma once
/// Drives over a motion: greatest forces and powers of the legs, and what they work.

#include <span>

#include "ninedof/math/types.hpp"

namespace ninedof {

/// Of each leg, in the order of leg_lengths. Force and power are linear between samples.
struct DriveFigures {
  Vec9 push = Vec9::Zero(), pull = Vec9::Zero();  ///< greatest forces, >= 0
  Vec9 rms = Vec9::Zero();                        ///< root of the mean of force^2 over time
  Vec9 power = Vec9::Zero();                      ///< greatest of force x rate, >= 0
  Vec9 braking = Vec9::Zero();                    ///< greatest of -force x rate, >= 0
  Vec9 work = Vec9::Zero();                       ///< integral of power where it is positive
  Vec9 returned = Vec9::Zero();                   ///< integral of -power where it is negative
};

/// Throws InvalidArgument unless there is one row of forces and rates for each time.
DriveFigures drive_figures(std::span<const double> time, std::span<const Vec9> forces, std::span<const Vec9> rates);

}  // namespace ninedof
