#include "optimize/polish/cluster.hpp"

#include "math/linear/eigenvectors.hpp"
#include "math/linear/jacobi_svd.hpp"

namespace ninedof {

Cluster::Cluster(const PreparedProblem& p, const DesignEvaluation& design, int pose, double tie) {
  const Index index = p.problem.objective.index;
  const PoseSpectrum& s = design.spectra[at_index(pose)];
  // The closed form's pairs move together by symmetry, and the Frobenius form is smooth.
  if (s.closed || index == Index::frobenius) return;
  condition_ = index == Index::condition_number;
  for (int k = 0; k < 6; ++k) {
    if (s.log_sigma[0] - s.log_sigma[k] <= tie) top_.members.push_back(k);
    if (condition_ && s.log_sigma[k] - s.log_sigma[5] <= tie) bottom_.members.push_back(k);
  }
  if (!ambiguous()) return;
  top_.entries = cluster_block(design, pose, top_.members);
  bottom_.entries = cluster_block(design, pose, bottom_.members);
}

std::vector<Eigen::RowVectorXd> cluster_block(const DesignEvaluation& design, int pose,
                                              const std::vector<int>& members) {
  const PoseSpectrum& s = design.spectra[at_index(pose)];
  const PoseState& at = design.state.pose(design.state.first_pose + pose);
  std::vector<Eigen::RowVectorXd> out;
  for (std::size_t i = 0; i < members.size(); ++i)
    for (std::size_t j = i; j < members.size(); ++j) {
      const int a = members[i], b = members[j];
      PointGradient g = zero_gradient();
      add_spectrum_gradient(at.at, at.legs, s.general, a, b, 0.5 / (s.general.sigma[a] * s.general.sigma[b]), g);
      Eigen::RowVectorXd row = Eigen::RowVectorXd::Zero(design.state.columns());
      design.state.add(design.state.first_pose + pose, g, row);
      out.push_back(std::move(row));
    }
  return out;
}

Eigen::VectorXd Cluster::extreme(const Block& b, const Eigen::VectorXd& along, double sign) {
  const auto n = static_cast<Eigen::Index>(b.members.size());
  Eigen::MatrixXd slope(n, n);
  std::size_t k = 0;
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index j = i; j < n; ++j) slope(i, j) = slope(j, i) = sign * b.entries[k++].dot(along);
  const Eigen::VectorXd w = symmetric_eigen(slope).vectors.col(0);
  Eigen::VectorXd out = Eigen::VectorXd::Zero(along.size());
  k = 0;
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index j = i; j < n; ++j) out += (i == j ? 1.0 : 2.0) * w[i] * w[j] * b.entries[k++].transpose();
  return sign * out;
}

Eigen::VectorXd Cluster::steepest(const Eigen::VectorXd& along) const {
  Eigen::VectorXd out = extreme(top_, along, 1.0);
  if (condition_) out += extreme(bottom_, along, -1.0);
  return out;
}

Coalesced::Coalesced(const DesignEvaluation& reference, int pose, std::vector<int> members)
    : pose_(pose), members_(std::move(members)) {
  basis_ = vectors(reference);
}

Eigen::MatrixXd Coalesced::vectors(const DesignEvaluation& design) const {
  const Mat6& twist = design.spectra[at_index(pose_)].general.twist;
  Eigen::MatrixXd out(6, size());
  for (int k = 0; k < size(); ++k) out.col(k) = twist.col(members_[at_index(k)]);
  return out;
}

Coalesced::Entries Coalesced::at(const DesignEvaluation& design) const {
  const PoseSpectrum& s = design.spectra[at_index(pose_)];
  // Transport of the reference basis into the present subspace: the orthogonal matrix nearest to the overlap.
  const Eigen::MatrixXd turn = nearest_orthogonal(vectors(design).transpose() * basis_);
  const std::vector<Eigen::RowVectorXd> block = cluster_block(design, pose_, members_);
  const int n = size(), entries = n * (n + 1) / 2;
  Entries out{Eigen::VectorXd::Zero(entries), Rows::Zero(entries, design.state.columns())};
  int entry = 0;
  for (int i = 0; i < n; ++i)
    for (int j = i; j < n; ++j, ++entry) {
      std::size_t k = 0;
      for (int a = 0; a < n; ++a)
        for (int b = a; b < n; ++b, ++k) {
          const double weight = a == b ? turn(a, i) * turn(a, j) : turn(a, i) * turn(b, j) + turn(b, i) * turn(a, j);
          out.gradient.row(entry) += weight * block[k];
          if (a == b) out.value[entry] += weight * s.log_sigma[members_[at_index(a)]];
        }
    }
  return out;
}

std::vector<Coalesced> coalesced_groups(const PreparedProblem& p, const DesignEvaluation& design,
                                        const std::vector<int>& poses, double gap) {
  std::vector<Coalesced> out;
  if (!p.has_kinks()) return out;
  for (const int pose : poses) {
    const PoseSpectrum& s = design.spectra[at_index(pose)];
    if (s.closed) continue;
    std::vector<int> tops, bottoms;
    for (int k = 0; k < 6; ++k) {
      if (s.log_sigma[0] - s.log_sigma[k] <= gap) tops.push_back(k);
      if (s.log_sigma[5 - k] - s.log_sigma[5] <= gap) bottoms.push_back(5 - k);
    }
    if (tops.size() > 1) out.emplace_back(design, pose, tops);
    if (bottoms.size() > 1 && p.problem.objective.index == Index::condition_number)
      out.emplace_back(design, pose, bottoms);
  }
  return out;
}

}  // namespace ninedof
