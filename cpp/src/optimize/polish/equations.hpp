#pragma once
/// The first-order conditions' equations at an active set: rows on their level, margins at zero, singular values that coincide.

#include "optimize/polish/active_set.hpp"
#include "optimize/polish/coalesced.hpp"

namespace ninedof {

/// Values and derivatives of the equations; `level` says of which level's t the value is the equal, -1 for zero.
struct Equations {
  Eigen::VectorXd value;
  Eigen::MatrixXd gradient;  ///< one row each, by free coordinate
  std::vector<int> level;
};

/// What is held as an equation while Newton's method runs.
class ActiveEquations {
 public:
  /// `gap`: singular values of a ruling pose no farther apart than this, in logarithms, are held together; 0: none are.
  ActiveEquations(const Prepared& p, const Look& l, const ActiveSet& a, double gap);

  Equations at(const Look& l) const;

 private:
  struct PoseUse {
    int pose, level;
  };

  const Prepared* p_;
  std::vector<int> plain_;  ///< uses held as they are
  std::vector<int> margins_;
  std::vector<PoseUse> ruled_;  ///< poses with singular values held together
  std::vector<Coalesced> groups_;
};

}  // namespace ninedof
