#pragma once
/// From one design to the optimum over a region near it: solve at the poses imposed, look over the region, impose what
/// is worse there, and again. What was imposed last follows the design while it is solved, as the worst pose does
/// (local reduction): its row then bends as the worst does, and few rounds are needed.

#include "ninedof/optimize/region_study.hpp"
#include "optimize/minimax/prepared_problem.hpp"
#include "optimize/region/pose_follower.hpp"

namespace ninedof {

/// What may be left to gain near an optimum of a region, relative.
inline constexpr double most_gain = 1e-7;

inline constexpr int most_exchanges = 40;  // rounds

/// Status and reason of a design over a region. `settled`: nothing is passed, in a dense search.
void conclude(Result& result, bool settled, int rounds, const Candidate& best, double gain);

/// A design of a study over a region and what is known of it.
struct Settled {
  Candidate best;  ///< of the problem with these poses
  Imposed imposed;
  Look look;       ///< of that design; without poses if a stop came before
  int rounds = 0;
  double slack = 0.0;    ///< of the optimum at these poses, see Stationarity
  bool settled = false;  ///< nothing is passed, in a dense search
};

/// The work of one study, for all of its designs.
class Exchange {
 public:
  Exchange(const Problem& problem, const Region& region, const RegionStudySettings& settings, const Control& control)
      : problem_(problem), region_(region), settings_(settings), control_(control) {}

  /// Follows a design, the variables of the problem without poses of the region. Gives up where it cannot become better
  /// than `known`, or comes to where that is.
  Settled follow(const Imposed& first, const Eigen::VectorXd& start, const Settled* known);

  /// Looks at a design. Throws Stopped.
  Look look(const Settled& of, long samples, const Control& control) const;

  /// See Settled::slack.
  double slack(const Settled& of) const;

  /// A design judged at the imposed poses alone.
  Candidate at_imposed(const Imposed& imposed, const Eigen::VectorXd& x) const;

  /// Of the imposed poses those that hold the design: the optimum at these alone is the same one.
  Imposed holding(const Imposed& imposed, const Eigen::VectorXd& x) const;

  int rounds() const { return rounds_; }
  long evaluations() const { return evaluations_; }

 private:
  PreparedProblem prepared(const Imposed& imposed) const;
  /// Imposed poses by their place in the list, and how they follow the design.
  using Following = std::vector<std::pair<std::size_t, std::shared_ptr<const FollowingPose>>>;

  /// The optimum at the poses alone; those that follow the design move to where they are then. `exactly`: until its
  /// slack is as small as what may be passed between the poses.
  Candidate solved(const Following& following, const Eigen::VectorXd& x, bool exactly, Imposed& imposed);
  /// Imposes the local worsts of a design; how they follow it, where `moving`.
  Following join(const Eigen::VectorXd& x, const std::vector<Look::Worst>& worst, bool moving, Imposed& imposed) const;
  /// Leaves out the imposed poses from `first` up to `last` that do not hold the design and have a later one near them:
  /// of the row that a worst pose leaves as it moves with the design its end stays.
  void drop(const Eigen::VectorXd& x, std::size_t first, std::size_t last, Imposed& imposed) const;
  /// Of two designs, in coordinates of the solver.
  double distance(const Eigen::VectorXd& a, const Eigen::VectorXd& b) const;
  bool hopeless(const Settled& here, const Settled* known) const;
  void tell(const Settled& here, const Imposed& at);

  const Problem& problem_;
  const Region& region_;
  const RegionStudySettings& settings_;
  const Control& control_;
  RoundClock clock_;
  int rounds_ = 0;
  long evaluations_ = 0;
};

/// How much the objective could still fall, relative; see RegionReport::gain.
double gain_of(const Settled& found);

}  // namespace ninedof
