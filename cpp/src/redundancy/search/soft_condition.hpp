#pragma once
/// The logarithm of the condition number without its kinks, to second order in O.

#include "ninedof/conditioning/sensitivity.hpp"
#include "redundancy/search/jet.hpp"

namespace ninedof {

/// epsilon log sum (sigma_k)^(1/epsilon) + epsilon log sum (sigma_k)^(-1/epsilon): at least log(sigma_1 / sigma_6) and above it by
/// at most 2 epsilon log 6. Smooth in O however singular values meet, because it is a smooth symmetric function of them.
///
/// The Hessian is exact: second derivatives of M^T M, first derivatives between every two singular vectors, divided differences
/// for singular values that come close. Every sigma must be positive.
Jet soft_condition(const Points& at, const NineLegs& legs, const Spectrum& s, double epsilon);

}  // namespace ninedof
