#pragma once
/// Everything the optimizer may move: the family's variables, the characteristic length, the place of s in displaced poses.

#include <array>
#include <vector>

#include "ninedof/optimize/optimize.hpp"

namespace ninedof {

struct Variable {
  std::string name;
  VariableKind kind;
  Bounds bounds;
  bool ours = false;  ///< bounds are a range of ours, not the study's: standing on one is no answer
};

/// In the order of Problem::names().
std::vector<Variable> full_variables(const Problem& problem);

/// Whether the optimizer moves s of a pose. At the neutral place it does so through zs.
bool placed(const Pose& pose);

/// PoseSpec of the characteristic length among them, or -1.
int length_variable(const Problem& problem);

/// A pose on the axis of a symmetric family, s included: the closed form holds there.
bool on_axis(const Problem& problem, const Pose& pose);

/// Places of s_x, s_y, s_z of the objective's pose `k` among the full variables, -1 where the optimizer does not move them.
/// On the axis symmetry keeps s there, and only s_z moves.
std::array<int, 3> offset_variables(const Problem& problem, std::size_t k);

/// Throws InvalidArgument unless `x` is a full set of finite variables.
void require_full(const char* argument, const Problem& problem, const Eigen::VectorXd& x);

}  // namespace ninedof
