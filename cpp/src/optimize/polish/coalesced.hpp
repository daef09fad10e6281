#pragma once
/// Singular values of one pose that coincide at a solution, as smooth equations, after Overton (SIAM J. Matrix Anal.
/// Appl. 9, 1988, 256-268).
///
/// Where singular values meet, each has a kink. The symmetric matrix S of their logarithms in a basis of their common
/// subspace, transported from a reference point, is smooth. They coincide where S is a multiple of the identity: two
/// equations for a pair, five for three.

#include "optimize/polish/cluster.hpp"

namespace ninedof {

/// The matrix S of the first (or last) few singular values of a pose, about a reference point.
class Coalesced {
 public:
  /// `members`: 0, 1, ... for the largest, 5, 4, ... for the smallest.
  Coalesced(const DesignEvaluation& reference, int pose, std::vector<int> members);

  int pose() const { return pose_; }
  bool top() const { return members_.front() == 0; }
  int size() const { return static_cast<int>(members_.size()); }

  /// S and its derivatives at another point nearby: entries (i, j), i <= j, row after row.
  struct Entries {
    Eigen::VectorXd value;
    Rows gradient;
  };
  Entries at(const DesignEvaluation& design) const;

  /// PoseSpec of S(i, i) among the entries.
  int diagonal(int i) const { return i * size() - i * (i - 1) / 2; }

 private:
  Eigen::MatrixXd vectors(const DesignEvaluation& design) const;

  int pose_;
  std::vector<int> members_;
  Eigen::MatrixXd basis_;  ///< of the subspace at the reference, 6 x size
};

/// Groups of the largest, and of the smallest, of the given poses that lie within `gap` of the extreme one, in
/// logarithms.
std::vector<Coalesced> coalesced_groups(const PreparedProblem& p, const DesignEvaluation& design,
                                        const std::vector<int>& poses, double gap);

}  // namespace ninedof
