#pragma once
/// A polynomial for O whose worst row is least over poses that become more.

#include "optimize/rule/rule_rows.hpp"

namespace ninedof {

using Powers = std::array<int, 6>;

/// What a rule is a polynomial in: the shift of p as lengths, the tilt and the yaw.
Vec6 rule_coordinates(const RuleRows& rows, const Vec6& at);

class MinimaxFit {
 public:
  /// Begins from the polynomial of given terms that is nearest to O as it is placed. Keeps a reference to `rows`, whose
  /// goal and margin may change before `join`.
  MinimaxFit(const RuleRows& rows, const std::vector<Powers>& powers, const std::vector<Placed>& best);

  PointRule rule() const;
  std::size_t term_count() const { return powers_.size(); }
  /// The worst row at the poses taken.
  double worst() const;
  /// Takes further poses, and the worst ones of a dense sample where the rule is worse than at all that it has.
  void join(const std::vector<Vec6>& poses);
  /// Lowers the worst row, smoothed, by damped Gauss-Newton steps.
  void lower(double smoothing);

 private:
  /// The smoothed worst row near the unknowns, of `bend` the lower half: these are the x, y and z coefficients of all
  /// terms, in zp, then the middles.
  struct Model {
    double value;
    Eigen::VectorXd gradient;
    Eigen::MatrixXd bend;
  };

  Eigen::VectorXd terms_at(const Vec6& at) const;
  Vec3 shift_by(const Eigen::VectorXd& terms) const;
  std::vector<Placed> placed(const std::vector<Vec6>& poses) const;
  void take(const std::vector<Vec6>& poses);
  void move_to(const Eigen::VectorXd& unknowns);
  double smoothed(double smoothing) const;
  Model model(double smoothing) const;
  Eigen::MatrixXd metric() const;

  const RuleRows& rows_;
  std::vector<Powers> powers_;
  Vec6 scale_;
  Eigen::VectorXd stiffness_;  // of the coefficients
  std::vector<Placed> places_;
  Eigen::MatrixXd terms_;          // a column for each place
  Eigen::VectorXd unknowns_;
  std::vector<PlacedRows> values_;  // at the places
};

}  // namespace ninedof
