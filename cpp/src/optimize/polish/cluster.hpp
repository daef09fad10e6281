#pragma once
/// Singular values that coincide: their joint derivative is a symmetric matrix. Directions give rows (Cluster), its
/// entries smooth equations (Coalesced), after Overton (SIAM J. Matrix Anal. Appl. 9, 1988, 256-268).

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
  bool ambiguous() const { return top_.members.size() > 1 || bottom_.members.size() > 1; }

  /// The row of derivatives of the index, among all directions, that points most against `along`.
  Eigen::VectorXd steepest(const Eigen::VectorXd& along) const;

 private:
  /// Derivatives of log sigma along every direction of the span of some singular vectors: w^T (sum of d y) w.
  struct Block {
    std::vector<int> members;
    std::vector<Eigen::RowVectorXd> entries;  // a <= b, row after row
  };
  static Eigen::VectorXd extreme(const Block& b, const Eigen::VectorXd& along, double sign);

  Block top_, bottom_;
  bool condition_ = false;
};

/// The symmetric matrix S of the logarithms of the first (or last) few singular values of a pose, in a basis of their
/// common subspace that is transported from a reference point. It is smooth where the singular values meet and each has
/// a kink. They coincide where S is a multiple of the identity: two equations for a pair, five for three.
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

  /// Place of S(i, i) among the entries.
  int diagonal(int i) const { return i * size() - i * (i - 1) / 2; }

 private:
  Eigen::MatrixXd vectors(const DesignEvaluation& design) const;

  int pose_;
  std::vector<int> members_;
  Eigen::MatrixXd basis_;  ///< of the subspace at the reference, 6 x size
};

/// Groups of the largest, and of the smallest, of each pose that lie within `gap` of the extreme one, in logarithms.
std::vector<Coalesced> coalesced_groups(const PreparedProblem& p, const DesignEvaluation& design,
                                        const std::vector<int>& poses, double gap);

}  // namespace ninedof
