#include "optimize/polish/equations.hpp"

#include <algorithm>

namespace ninedof {
ActiveEquations::ActiveEquations(const PreparedProblem& p, const DesignEvaluation& design, const ActiveSet& a,
                                 double gap)
    : p_(&p), margins_(a.margins) {
  std::vector<int> poses;
  for (const int k : a.row_levels) {
    const int pose = p.pose_of(p.row_levels[static_cast<std::size_t>(k)].row);
    if (std::ranges::find(poses, pose) == poses.end()) poses.push_back(pose);
  }
  if (gap > 0.0) groups_ = coalesced_groups(p, design, poses, gap);
  for (const int k : a.row_levels) {
    const RowLevel& u = p.row_levels[static_cast<std::size_t>(k)];
    const int pose = p.pose_of(u.row);
    const bool held = std::ranges::any_of(groups_, [&](const Coalesced& c) { return c.pose() == pose; });
    if (!held) {
      plain_.push_back(k);
      continue;
    }
    const bool known =
        std::ranges::any_of(pose_levels_, [&](const PoseLevel& r) { return r.pose == pose && r.level == u.level; });
    if (!known) pose_levels_.push_back({pose, u.level});
  }
}

Equations ActiveEquations::at(const DesignEvaluation& design) const {
  std::size_t structure = 0;  // equations that say singular values coincide
  for (const Coalesced& c : groups_) structure += static_cast<std::size_t>(c.size() * (c.size() + 1) / 2 - 1);
  const auto count = static_cast<Eigen::Index>(plain_.size() + margins_.size() + pose_levels_.size() + structure);
  Equations out{Eigen::VectorXd(count), Eigen::MatrixXd(count, design.state.columns()), {}};
  Eigen::Index row = 0;
  const auto add = [&](double value, const Eigen::RowVectorXd& gradient, int level) {
    out.value[row] = value;
    out.gradient.row(row++) = gradient;
    out.level.push_back(level);
  };
  for (const int k : plain_) {
    const RowLevel& u = p_->row_levels[static_cast<std::size_t>(k)];
    add(design.objective_rows[u.row], design.row_gradient.row(u.row), u.level);
  }
  for (const int k : margins_) add(design.margins[k], design.margin_gradient.row(k), -1);
  std::vector<Coalesced::Entries> entries;
  for (const Coalesced& c : groups_) entries.push_back(c.at(design));
  for (const PoseLevel& r : pose_levels_) {
    // The largest less the smallest singular value, each the mean of its group where it is held equal.
    const PoseSpectrum& s = design.spectra[static_cast<std::size_t>(r.pose)];
    double top = s.log_sigma[0], bottom = s.log_sigma[5];
    Eigen::RowVectorXd top_gradient = s.gradient.row(0), bottom_gradient = s.gradient.row(5);
    for (std::size_t k = 0; k < groups_.size(); ++k) {
      if (groups_[k].pose() != r.pose) continue;
      const Coalesced::Entries& e = entries[k];
      const Coalesced& c = groups_[k];
      double mean = 0.0;
      Eigen::RowVectorXd gradient = Eigen::RowVectorXd::Zero(design.state.columns());
      for (int i = 0; i < c.size(); ++i) {
        mean += e.value[c.diagonal(i)] / c.size();
        gradient += e.gradient.row(c.diagonal(i)) / c.size();
      }
      (c.top() ? top : bottom) = mean;
      (c.top() ? top_gradient : bottom_gradient) = gradient;
    }
    if (p_->problem.objective.index == Index::speed) add(top, top_gradient, r.level);
    else add(top - bottom, top_gradient - bottom_gradient, r.level);
  }
  for (std::size_t k = 0; k < groups_.size(); ++k) {
    const Coalesced& c = groups_[k];
    const Coalesced::Entries& e = entries[k];
    for (int i = 0; i < c.size(); ++i)
      for (int j = i; j < c.size(); ++j) {
        const int entry = c.diagonal(i) + j - i;
        if (j > i) add(e.value[entry], e.gradient.row(entry), -1);
        else if (i > 0) add(e.value[entry] - e.value[0], e.gradient.row(entry) - e.gradient.row(0), -1);
      }
  }
  return out;
}

}  // namespace ninedof
