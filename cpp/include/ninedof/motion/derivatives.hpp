#pragma once
/// Velocity and acceleration of configurations over time.

#include <span>
#include <stop_token>
#include <vector>

#include "ninedof/kinematics/acceleration.hpp"
#include "ninedof/kinematics/velocity.hpp"

namespace ninedof {

struct PathDerivatives {
  std::vector<Velocity> velocity;
  std::vector<Acceleration> acceleration;
};

/// Those of the polynomial through the five configurations nearest in number, one-sided at both ends: exact for
/// polynomials of degree four, on even and uneven times. About sample k the polynomial is that of w(t), p and s, where
/// Q(t) = exp(w(t)) Q_k: at w = 0 the angular velocity is w' and the angular acceleration w''. The samples are not
/// smoothed: an error e of one becomes about e / step^2 in the acceleration.
///
/// `time`: increasing, at least three, one for each configuration. With fewer than five all are used. Throws
/// InvalidArgument for other numbers of them, Stopped on a stop.
PathDerivatives path_derivatives(std::span<const double> time, std::span<const Configuration> path,
                                 const std::stop_token& stop = {});

}  // namespace ninedof
