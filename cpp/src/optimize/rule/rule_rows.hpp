#pragma once
/// A design over its region with O at given places, as rows to be lowered: the worse the larger.

#include <utility>

#include "ninedof/optimize/rule_fit.hpp"

namespace ninedof {

/// The index less its goal, and all limits, weighted. A limit that compares poses is a range about the middle of each
/// leg's lengths, or of the lengths of all legs: these middles are unknowns like the rule.
class RuleRows {
 public:
  static constexpr double weight = 10.0;  // of limits against the index, which may be a little worse

  double goal;           ///< logarithm of the index
  double margin = 5e-4;  ///< what is left of every limit at the poses taken, since others lie between them

  RuleRows(const RuleTask& task, int threads, const Control& control);
  /// Without a place of O, which a rule has.
  const Region& region() const { return region_; }
  double zp() const { return task_.machine.neutral.position.z() - task_.problem.tool.position.z(); }

  /// The nearest poses of the region with O where it is best.
  std::vector<Placed> best(const std::vector<Vec6>& at) const;
  /// Rows with O as it is placed. Limits that O has no part in are left out: they are minus infinity.
  std::vector<PlacedRows> at(const std::vector<Placed>& places, const Eigen::VectorXd& middles) const;

  Eigen::Index middle_count() const;
  /// The middles of what the legs do at some poses.
  Eigen::VectorXd middles(const std::vector<Placed>& places) const;
  /// The middle that a row is about, and the derivative of the row with respect to it; -1 without one.
  std::pair<Eigen::Index, double> middle_of(const PlacedRows& rows, Eigen::Index row) const;

 private:
  struct Spread {
    LegRange range;  // about middles of zero
    Eigen::Index first;  // of its middles
    Eigen::Index middle(Eigen::Index leg) const { return range.spread.each_leg ? first + leg : first; }
  };

  const RuleTask& task_;
  Region region_;
  int threads_;
  const Control& control_;
  std::vector<Spread> spreads_;
};

}  // namespace ninedof
