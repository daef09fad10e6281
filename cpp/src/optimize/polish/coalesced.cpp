#include "optimize/polish/coalesced.hpp"

#include "math/linear/decompositions.hpp"

namespace ninedof {

Coalesced::Coalesced(const DesignEvaluation& reference, int pose, std::vector<int> members)
    : pose_(pose), members_(std::move(members)) {
  basis_ = vectors(reference);
}

Eigen::MatrixXd Coalesced::vectors(const DesignEvaluation& design) const {
  const Mat6& twist = design.spectra[static_cast<std::size_t>(pose_)].general.twist;
  Eigen::MatrixXd out(6, size());
  for (int k = 0; k < size(); ++k) out.col(k) = twist.col(members_[static_cast<std::size_t>(k)]);
  return out;
}

Coalesced::Entries Coalesced::at(const DesignEvaluation& design) const {
  const PoseSpectrum& s = design.spectra[static_cast<std::size_t>(pose_)];
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
          if (a == b) out.value[entry] += weight * s.log_sigma[members_[static_cast<std::size_t>(a)]];
        }
    }
  return out;
}

std::vector<Coalesced> coalesced_groups(const PreparedProblem& p, const DesignEvaluation& design,
                                        const std::vector<int>& poses, double gap) {
  std::vector<Coalesced> out;
  if (!p.has_kinks()) return out;
  for (const int pose : poses) {
    const PoseSpectrum& s = design.spectra[static_cast<std::size_t>(pose)];
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
