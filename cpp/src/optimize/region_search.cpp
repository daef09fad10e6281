#include "ninedof/optimize/region_search.hpp"

#include <algorithm>

#include "math/numbers.hpp"
#include "optimize/region/design_at_poses.hpp"
#include "problem/full_variables.hpp"

namespace ninedof {
namespace {

constexpr double small = 0.1;  // margin from which a descent is not worth while, but for the least of all

/// Of one design: the margins of all limits, minus the logarithm of the index, and the length of each leg and its
/// negative.
class OnePose : public PoseNumbers {
 public:
  OnePose(const Problem& problem, const Region& region, const Eigen::VectorXd& variables)
      : region_(region), p_(with_one_pose(problem), variables), specs_(p_.pose_specs) {
    p_.set_state({}, design_.state);
    none_ = selection_of(p_);
  }

  int margins() const { return static_cast<int>(p_.margins.size()); }
  std::vector<int> groups() const override { return {margins() + 1 + 18}; }
  RegionWorst::Limit limit(int row, const MetNumber& met) const {
    return {p_.margin_name(row), row, p_.shown_margin(row, met.value).value, met.at};
  }

  void go(const Vec6& at) override {
    for (std::size_t k = 1; k < specs_.size(); ++k) {
      specs_[k].pose = region_.pose(at);
      specs_[k].slopes.reset();
    }
    design_.state.set_poses(specs_);
  }
  void evaluate(int, double* out) override {
    evaluate_rows(p_, design_, &none_);
    const Vec9 lengths = design_.state.pose(1).legs.length / design_.state.unit;
    Eigen::Map<Eigen::VectorXd>(out, margins() + 1 + 18) << design_.margins, -design_.log_objective, lengths, -lengths;
  }
  /// Of pairs of singular values the largest and the smallest alone.
  bool smooth(int, int number) const override {
    if (number >= margins()) return true;
    const auto [constraint, row] = p_.margins[at_index(number)];
    return constraint >= 0 || row == 0;
  }
  double slopes(int, int number, const Vec6& at, Vec6& by_at) override {
    const int pose = number < margins() ? pose_of_margin(p_, design_.state, number) : 1;
    if (pose > 0) go_with_slopes(pose, at);
    Eigen::RowVectorXd row = Eigen::RowVectorXd::Zero(design_.state.columns());
    double value;
    if (number < margins()) value = evaluate_margin(p_, design_, number, row);
    else if (number == margins()) {
      value = -evaluate_index(p_, design_, 0, row);
      row = -row;
    } else {
      const int leg = (number - margins() - 1) % 9;
      const double sign = number - margins() - 1 < 9 ? 1.0 : -1.0;
      value = sign * design_.state.pose(1).legs.length[leg] / design_.state.unit;
      design_.state.add_leg(1, leg, sign / design_.state.unit, row);
    }
    if (row.size() == 6) by_at = row.transpose();
    else by_at.setZero();  // of the design or at home
    return value;
  }
  /// The least margin is stated whatever it is.
  std::vector<double> worthwhile(const std::vector<double>& sampled) const override {
    std::vector<double> below(sampled.size(), infinity);
    int tightest = 0;
    std::vector<double> shown;
    for (int k = 0; k < margins(); ++k) {
      shown.push_back(p_.shown_margin(k, sampled[at_index(k)]).value);
      if (shown.back() < shown[at_index(tightest)]) tightest = k;
    }
    for (int k = 0; k < margins(); ++k)
      if (k != tightest) below[at_index(k)] = small;
    return below;
  }

 private:
  void go_with_slopes(int pose, const Vec6& at) {
    PoseSpec& spec = specs_[at_index(pose)];
    spec.pose = region_.pose(at);
    spec.slopes = region_.slopes(at);
    design_.state.set_pose(pose, spec);
  }

  const Region& region_;
  PreparedProblem p_;
  std::vector<PoseSpec> specs_;
  DesignEvaluation design_;
  RowSelection none_;  // no derivatives
};

}  // namespace

RegionWorst search_region(const Problem& problem, const Region& region, const Eigen::VectorXd& variables,
                          const RegionSettings& settings, const Control& control) {
  problem.validate();
  region.validate();
  require_full("variables", problem, variables);
  const OnePose shape(problem, region, variables);
  const RegionExtremes found =
      region_extremes(region, [&] { return std::make_unique<OnePose>(problem, region, variables); }, settings, control);

  RegionWorst out;
  out.poses = found.poses;
  const int index = shape.margins();
  for (int k = 0; k < index; ++k)
    for (const MetNumber& met : found.ends[at_index(k)]) out.limits.push_back(shape.limit(k, met));
  for (const MetNumber& met : found.ends[at_index(index)]) out.index.push_back({-met.value, met.at});
  for (int leg = 0; leg < 9; ++leg) {
    out.shortest_at[at_index(leg)] = found.least(at_index(index + 1 + leg)).at;
    out.longest_at[at_index(leg)] = found.least(at_index(index + 10 + leg)).at;
  }
  return out;
}

}  // namespace ninedof
