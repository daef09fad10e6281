#include "optimize/region/design_at_poses.hpp"

#include "math/numbers.hpp"

namespace ninedof {
namespace {

constexpr double small = 0.1;  // margin from which a descent is not worth while, but for the least of all

PreparedProblem at_one_pose(const Problem& problem, const Eigen::VectorXd& variables, bool with_design) {
  const Problem there = with_one_pose(problem);
  return with_design ? PreparedProblem(there) : PreparedProblem(there, variables);
}

}  // namespace

DesignAtPoses::DesignAtPoses(const Problem& problem, const Region& region, const Eigen::VectorXd& variables,
                             bool with_design)
    : region_(region),
      p_(at_one_pose(problem, variables, with_design)),
      specs_(p_.pose_specs),
      none_(selection_of(p_)) {
  p_.set_state(with_design ? variables : Eigen::VectorXd(), design_.state);
}

void DesignAtPoses::look_at(const Vec6& at) {
  go(at);
  evaluate_rows(p_, design_, &none_);
}

void DesignAtPoses::go(const Vec6& at) {
  for (std::size_t k = 1; k < specs_.size(); ++k) {
    specs_[k].pose = region_.pose(at);
    specs_[k].slopes.reset();
  }
  design_.state.set_poses(specs_);
}

void DesignAtPoses::evaluate(int, double* out) {
  evaluate_rows(p_, design_, &none_);
  const Vec9 lengths = design_.state.pose(1).legs.length / design_.state.unit;
  Eigen::Map<Eigen::VectorXd>(out, RegionNumber::first_margin + margins()) << -design_.log_objective, lengths, -lengths,
      design_.margins;
}

/// Of pairs of singular values the largest and the smallest alone.
bool DesignAtPoses::smooth(int, int number) const {
  if (number < RegionNumber::first_margin) return true;
  const auto [constraint, row] = p_.margins[at_index(number - RegionNumber::first_margin)];
  return constraint >= 0 || row == 0;
}

double DesignAtPoses::slopes(int, int number, const Vec6& at, Vec6& by_at) {
  Eigen::RowVectorXd row;
  const double value = differentiate(number, at, row);
  by_at = row.tail<6>().transpose();
  return value;
}

double DesignAtPoses::differentiate(int number, const Vec6& at, Eigen::RowVectorXd& slopes) {
  const int k = number - RegionNumber::first_margin;
  const int pose = k >= 0 ? pose_of_margin(p_, design_.state, k) : 1;
  if (pose > 0) go_with_slopes(pose, at);
  slopes.setZero(p_.coordinates.size() + 6);
  if (k >= 0) return evaluate_margin(p_, design_, k, slopes.head(design_.state.columns()));  // at home without a pose's
  if (number == RegionNumber::index) {
    const double value = -evaluate_index(p_, design_, 0, slopes);
    slopes = -slopes;
    return value;
  }
  const int leg = (number - RegionNumber::shortest) % 9;
  const double sign = number < RegionNumber::longest ? 1.0 : -1.0;
  design_.state.add_leg(1, leg, sign / design_.state.unit, slopes);
  return sign * design_.state.pose(1).legs.length[leg] / design_.state.unit;
}

/// The least margin is stated whatever it is.
std::vector<double> DesignAtPoses::worthwhile(const std::vector<double>& sampled) const {
  std::vector<double> below(sampled.size(), infinity);
  int tightest = 0;
  std::vector<double> shown;
  for (int k = 0; k < margins(); ++k) {
    shown.push_back(p_.shown_margin(k, sampled[at_index(RegionNumber::first_margin + k)]).value);
    if (shown.back() < shown[at_index(tightest)]) tightest = k;
  }
  for (int k = 0; k < margins(); ++k)
    if (k != tightest) below[at_index(RegionNumber::first_margin + k)] = small;
  return below;
}

void DesignAtPoses::go_with_slopes(int pose, const Vec6& at) {
  PoseSpec& spec = specs_[at_index(pose)];
  spec.pose = region_.pose(at);
  spec.slopes = region_.slopes(at);
  design_.state.set_pose(pose, spec);
}

}  // namespace ninedof
