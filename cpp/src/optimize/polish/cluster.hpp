#pragma once
/// Coinciding singular values: their joint derivative is a symmetric matrix, and each direction in it gives a row.

#include "optimize/minimax/design_evaluation.hpp"

namespace ninedof {

/// Derivatives of the matrix of logarithms of some singular values of a pose, in the basis of their own vectors:
/// entries (a, b), a <= b, row after row. Exact where they coincide.
std::vector<Eigen::RowVectorXd> cluster_block(const DesignEvaluation& design, int pose,
                                              const std::vector<int>& members);

/// Singular values of one displaced pose that tie for largest, and for smallest.
class Cluster {
 public:
  /// `tie`: difference of logarithms that counts as equal.
  Cluster(const PreparedProblem& p, const DesignEvaluation& design, int pose, double tie);

  /// Whether at least two singular values coincide.
  bool ambiguous() const { return tops_.size() > 1 || bottoms_.size() > 1; }

  /// The row of derivatives of the index, among all directions, that points most against `along`.
  Eigen::VectorXd steepest(const Eigen::VectorXd& along) const;

 private:
  /// Derivatives of log sigma along every direction of the span of some singular vectors: w^T (sum of d y) w.
  struct Block {
    std::vector<int> members;
    std::vector<Eigen::RowVectorXd> entries;  // a <= b, row after row
  };
  static Eigen::VectorXd extreme(const Block& b, const Eigen::VectorXd& along, double sign);

  std::vector<int> tops_, bottoms_;
  Block top_, bottom_;
  bool condition_ = false;
};

}  // namespace ninedof
