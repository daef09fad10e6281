#include "math/linear/decompositions.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/SVD>

namespace ninedof {

TallSvd<9> right_svd(const Eigen::Matrix<double, 27, 9>& a) {
  const Eigen::JacobiSVD<Eigen::Matrix<double, 27, 9>> svd(a, Eigen::ComputeFullV);
  return {svd.singularValues(), svd.matrixV()};
}

TallSvd<3> right_svd(const Mat93& a) {
  const Eigen::JacobiSVD<Mat93> svd(a, Eigen::ComputeFullV);
  return {svd.singularValues(), svd.matrixV()};
}

RealEigen8 real_eigen(const Eigen::Matrix<double, 8, 8>& a) {
  const Eigen::EigenSolver<Eigen::Matrix<double, 8, 8>> eigen(a);
  if (eigen.info() != Eigen::Success) return {};
  return {true, eigen.eigenvalues(), eigen.pseudoEigenvectors()};
}

Eigen::VectorXd least_eigenvector(const Eigen::MatrixXd& symmetric) {
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(symmetric).eigenvectors().col(0);
}

Eigen::MatrixXd nearest_orthogonal(const Eigen::MatrixXd& square) {
  // A square matrix needs no QR first, and Eigen's default would compile one.
  const Eigen::JacobiSVD<Eigen::MatrixXd, Eigen::NoQRPreconditioner> svd(square,
                                                                         Eigen::ComputeFullU | Eigen::ComputeFullV);
  return svd.matrixU() * svd.matrixV().transpose();
}

}  // namespace ninedof
