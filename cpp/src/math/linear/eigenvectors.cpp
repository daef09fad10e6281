#include "math/linear/eigenvectors.hpp"

#include <Eigen/Eigenvalues>

namespace ninedof {
namespace {

/// One type for both solvers, which then share half of their code; without allocation, and with the bits of the types
/// of their sizes.
using UpTo8 = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 8, 8>;

}  // namespace

RealEigen8 real_eigen(const Eigen::Matrix<double, 8, 8>& a) {
  const Eigen::EigenSolver<UpTo8> eigen(a);
  if (eigen.info() != Eigen::Success) return {};
  return {true, eigen.eigenvalues(), eigen.pseudoEigenvectors()};
}

SymmetricEigen symmetric_eigen(const Eigen::MatrixXd& symmetric) {
  const Eigen::SelfAdjointEigenSolver<UpTo8> eigen(symmetric);
  return {eigen.eigenvalues(), eigen.eigenvectors()};
}

}  // namespace ninedof
