#pragma once
/// One design at poses of a region, one after another: values alone.

#include "ninedof/domains/region.hpp"
#include "optimize/minimax/design_evaluation.hpp"
#include "optimize/region/posed.hpp"

namespace ninedof {

class DesignAtPoses {
 public:
  /// `variables`: a full set of the problem without poses.
  DesignAtPoses(const Problem& problem, const Region& region, const Eigen::VectorXd& variables)
      : region_(region), p_(with_one_pose(problem), variables), specs_(p_.pose_specs), none_(selection_of(p_)) {
    p_.set_state({}, design_.state);
  }

  void go(const Vec6& at) {
    for (std::size_t k = 1; k < specs_.size(); ++k) specs_[k].pose = region_.pose(at);
    design_.state.set_poses(specs_);
    evaluate_rows(p_, design_, &none_);
  }
  const PreparedProblem& rows() const { return p_; }
  const Eigen::VectorXd& margins() const { return design_.margins; }
  double log_index() const { return design_.log_objective; }
  const Vec9& lengths() const { return design_.state.pose(1).legs.length; }

 private:
  Region region_;
  PreparedProblem p_;
  std::vector<PoseSpec> specs_;
  DesignEvaluation design_;
  RowSelection none_;
};

}  // namespace ninedof
