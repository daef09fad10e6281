#pragma once
/// One design at poses of a region, one after another.

#include "ninedof/domains/pose_numbers.hpp"
#include "ninedof/optimize/region_search.hpp"
#include "optimize/minimax/design_evaluation.hpp"
#include "optimize/region/posed.hpp"

namespace ninedof {

/// The numbers of RegionNumber, in one group.
class DesignAtPoses : public PoseNumbers {
 public:
  /// `variables`: a full set of the problem without poses; where `with_design`, derivatives by them are there too.
  DesignAtPoses(const Problem& problem, const Region& region, const Eigen::VectorXd& variables,
                bool with_design = false);

  int margins() const { return static_cast<int>(p_.margins.size()); }
  const std::string& margin_name(int k) const { return p_.margin_name(k); }
  ShownMargin shown_margin(int k, double margin) const { return p_.shown_margin(k, margin); }

  /// Goes to a pose and evaluates it.
  void look_at(const Vec6& at);
  double margin(int k) const { return design_.margins[k]; }
  double log_index() const { return design_.log_objective; }
  Vec9 lengths() const { return design_.state.pose(1).legs.length; }

  std::vector<int> groups() const override { return {RegionNumber::first_margin + margins()}; }
  void go(const Vec6& at) override;
  void evaluate(int group, double* out) override;
  bool smooth(int group, int number) const override;
  double slopes(int group, int number, const Vec6& at, Vec6& by_at) override;
  std::vector<double> worthwhile(const std::vector<double>& sampled) const override;

  /// A number and its derivatives by the variables, where these are wanted, and by the six coordinates of the pose.
  double differentiate(int number, const Vec6& at, Eigen::RowVectorXd& slopes);

 private:
  void go_with_slopes(int pose, const Vec6& at);

  Region region_;
  PreparedProblem p_;
  std::vector<PoseSpec> specs_;
  DesignEvaluation design_;
  RowSelection none_;  // no derivatives
};

}  // namespace ninedof
