#pragma once
/// What a study demands of a design, piece by piece, and designs that come nearest to chosen pieces.

#include <string>
#include <vector>

#include "optimize/minimax/subproblem.hpp"

namespace ninedof {

/// One side of a limit, or of the bounds of a variable; of an angle, both.
struct StudyDemand {
  std::string name;          ///< of the limit or the variable
  std::string words;         ///< "leg_length >= 3"
  std::vector<int> margins;  ///< of a limit: its rows of the prepared problem
  int coordinate = -1;       ///< of a bound: the free coordinate and its range
  double low = -infinity, high = infinity;

  bool is_bound() const { return coordinate >= 0; }
};

/// Difference of violations that counts as none.
inline constexpr double same_violation = 1e-5;

/// Which demands count, by their index.
using Demands = std::vector<bool>;

/// A study whose limits and bounds can be left out or violated one by one. 0 < zs < zp (eq. 9b) always holds.
class Relaxation {
 public:
  explicit Relaxation(const Problem& study);

  const std::vector<StudyDemand>& demands() const { return demands_; }
  Demands all() const { return Demands(demands_.size(), true); }

  /// Start number `index` within the bounds of the study, and without them; a design of the study: in the coordinates
  /// used here.
  Eigen::VectorXd start(int index, std::uint64_t seed) const;
  Eigen::VectorXd far_start(int index, std::uint64_t seed) const {
    return p_.with_auxiliary(p_.coordinates.start(index, seed));
  }
  Eigen::VectorXd coordinates(const Eigen::VectorXd& variables) const;
  Eigen::VectorXd variables(const Eigen::VectorXd& y) const {
    return p_.without_auxiliary(p_.coordinates.variables(y));
  }

  /// Largest violation of the demands that count, as the logarithm of a ratio or relative to the limit.
  double violation(const Eigen::VectorXd& y, const Demands& counted) const;
  /// Of each demand.
  std::vector<double> violations(const Eigen::VectorXd& y) const;

  /// The poses of the objective where the demands that count are violated most.
  std::vector<int> poses(const Eigen::VectorXd& y, const Demands& counted) const;

  /// The design near `start` that violates those of the counted demands least that `give`, and no other. If limits and
  /// no bounds give, the study's own rules (O between the plates) give with them.
  Eigen::VectorXd least(const Eigen::VectorXd& start, const Demands& counted, const Demands& give, int max_evaluations,
                        const std::stop_token& stop, long& evaluations) const;

  /// What a demand would have to be for a design to meet it: "leg_length >= 1.414", with four digits, to the safe side.
  std::string enough(const StudyDemand& demand, const Eigen::VectorXd& y) const;

 private:
  DesignEvaluation evaluated(const Eigen::VectorXd& y) const;
  double violation(const StudyDemand& demand, const DesignEvaluation& design, const Eigen::VectorXd& y) const;
  void add_limits();
  void add_bounds(const Problem& study);

  PreparedProblem p_;
  PreparedProblem own_;  ///< with the bounds of the study: for its starts
  std::vector<StudyDemand> demands_;
  std::vector<int> rules_;  ///< rows that no limit of the study states
};

}  // namespace ninedof
