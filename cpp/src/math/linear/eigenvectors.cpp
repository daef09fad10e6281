#include "math/linear/eigenvectors.hpp"

#include <Eigen/Eigenvalues>

namespace ninedof {

RealEigen8 real_eigen(const Eigen::Matrix<double, 8, 8>& a) {
  // Of dynamic size: shares half of its code with the other solver, at the same speed and with the same bits.
  const Eigen::EigenSolver<Eigen::MatrixXd> eigen(a);
  if (eigen.info() != Eigen::Success) return {};
  return {true, eigen.eigenvalues(), eigen.pseudoEigenvectors()};
}

Eigen::VectorXd least_eigenvector(const Eigen::MatrixXd& symmetric) {
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(symmetric).eigenvectors().col(0);
}

}  // namespace ninedof
