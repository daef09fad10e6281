#pragma once
/// The fast solution of the rotation problem: one leg is satisfied identically, one angle is eliminated, and a
/// polynomial of degree eight in the other angle remains (docs/theory/position.md).
///
/// The three equations are d . Q w = c, of rank one each, so Q = X Rz(phi) Ry(a) Rz(psi) Y^T with X e3 = d_1, Y e3 =
/// w_1 and cos a = c_1 satisfies the first for all phi and psi. The others are A(phi) cos psi + B(phi) sin psi + C(phi)
/// = 0 with A, B, C of first order in cos phi and sin phi. Eliminating psi gives (B2 C3 - B3 C2)^2 + (C2 A3 - C3 A2)^2
/// = (A2 B3 - A3 B2)^2. General quadrics need the elimination of Kukelova, Heller and Fitzgibbon (CVPR 2016) for the
/// same degree, from forty times the coefficients and with charts that can be unlucky; a circle has none.

#include "position/rotation_problem.hpp"

namespace ninedof {

/// The equation of leg `pivot` is satisfied identically. Unreliable where two solutions share or nearly share phi:
/// there the null-space method is used.
RotationCandidates eliminated_rotations(const RotationProblem& problem, int pivot);

}  // namespace ninedof
