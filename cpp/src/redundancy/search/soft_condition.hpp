#pragma once
/// A smooth approximation of the logarithm of the condition number, to second order in O.

#include "ninedof/conditioning/sensitivity.hpp"
#include "redundancy/search/jet.hpp"

namespace ninedof {

/// epsilon log sum (sigma_k)^(1/epsilon) + epsilon log sum (sigma_k)^(-1/epsilon): above log(sigma_1 / sigma_6) by at
/// most 2 epsilon log 6. It is smooth in O even where singular values coincide, as a smooth symmetric function of them.
///
/// The Hessian is exact: second derivatives of M^T M, first derivatives between every two singular vectors, divided
/// differences for singular values that nearly coincide. Every sigma must be positive.
Jet soft_condition(const Points& at, const NineLegs& legs, const Spectrum& s, double epsilon);

}  // namespace ninedof
