#pragma once
/// The equations of an active set: rows equal to their level, margins at zero, singular values that coincide.

#include "optimize/polish/active_set.hpp"
#include "optimize/polish/coalesced.hpp"

namespace ninedof {

/// Values and derivatives of the equations; each value equals t of its `level`, or 0 where that is -1.
struct Equations {
  Eigen::VectorXd value;
  Eigen::MatrixXd gradient;  ///< one row each, by free coordinate
  std::vector<int> level;
};

/// The equations of Newton's method.
class ActiveEquations {
 public:
  /// `gap`: singular values of an active pose no farther apart than this, in logarithms, are held equal; 0: none are.
  ActiveEquations(const PreparedProblem& p, const DesignEvaluation& design, const ActiveSet& a, double gap);

  Equations at(const DesignEvaluation& design) const;

 private:
  struct PoseLevel {
    int pose, level;
  };

  const PreparedProblem* p_;
  std::vector<int> plain_;  ///< indices into PreparedProblem::row_levels, of the other poses
  std::vector<int> margins_;
  std::vector<PoseLevel> pose_levels_;  ///< of poses with singular values held equal
  std::vector<Coalesced> groups_;
};

}  // namespace ninedof
