#pragma once
/// The fast way through the rotation problem: one leg solved identically, one angle eliminated, a polynomial of degree eight in
/// the other.
///
/// The three equations are d . Q w = c, of rank one each, so Q = X Rz(phi) Ry(a) Rz(psi) Y^T with X e3 = d_1, Y e3 = w_1 and
/// cos a = c_1 satisfies the first whatever phi and psi are. The others read A(phi) cos psi + B(phi) sin psi + C(phi) = 0 with
/// A, B, C of first order in phi; eliminating psi leaves (B2 C3 - B3 C2)^2 + (C2 A3 - C3 A2)^2 = (A2 B3 - A3 B2)^2. General
/// quadrics need the elimination of Kukelova, Heller and Fitzgibbon (CVPR 2016) for the same degree, from forty times the
/// coefficients and with charts that can be unlucky; a circle has none.

#include "position/rotation_problem.hpp"

namespace ninedof {

/// The leg whose equation is solved identically is `pivot`. Not reliable where two solutions share phi, or nearly: another pivot
/// may do, the null-space method does.
RotationCandidates eliminated_rotations(const RotationProblem& problem, int pivot);

}  // namespace ninedof
