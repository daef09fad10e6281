#pragma once
/// The full set of variables: the family's, the characteristic length, offsets of O at displaced poses.

#include <array>
#include <vector>

#include "ninedof/problem/problem.hpp"

namespace ninedof {

struct Variable {
  std::string name;
  VariableKind kind;
  Bounds bounds;
  bool internal_bounds = false;  ///< not of the study: an optimum must not lie on them
};

std::vector<Variable> full_variables(const Problem& problem);

/// Whether the optimizer chooses s at a pose. At the neutral pose it does so through zs.
bool optimizes_internal_point(const Pose& pose);

/// Index of the characteristic length among the full variables, or -1.
int length_variable(const Problem& problem);

/// Whether a pose of a symmetric family lies on the axis, s included: the closed form holds there.
bool on_axis(const Problem& problem, const Pose& pose);

/// Indices of s_x, s_y, s_z of the objective's pose `k` among the full variables, -1 where the optimizer does not move
/// them. On the axis symmetry keeps s there, and only s_z moves.
std::array<int, 3> offset_variables(const Problem& problem, std::size_t k);

/// Throws InvalidArgument unless `x` is a full set of finite variables.
void require_full(const char* argument, const Problem& problem, const Eigen::VectorXd& x);

}  // namespace ninedof
