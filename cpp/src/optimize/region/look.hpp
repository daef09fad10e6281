#pragma once
/// One design looked at over a region, and at poses of it.

#include <chrono>
#include <map>
#include <string>

#include "ninedof/optimize/region_search.hpp"
#include "optimize/region/posed.hpp"

namespace ninedof {

/// Samples of a search: while the design moves, and at the end.
inline constexpr long quick_samples = 4'000, dense_samples = 100'000;

/// Where a design is worse than it may be.
struct Look {
  double log_index = 0.0;  ///< the largest
  Vec6 log_index_at = Vec6::Zero();
  double margin = 0.0;     ///< the least of a limit
  std::string limit;
  double excess = 0.0;  ///< the most by which a limit, or the index at the imposed poses, is passed; not positive: none
  double gain = 0.0;  ///< by which the index is passed
  std::map<std::string, double> passed;  ///< by which each limit is passed, 0 where it is kept
  struct Worst {
    Vec6 at;
    int number;  ///< see RegionNumber
  };
  std::vector<Worst> worst;  ///< local worsts that pass or nearly do, the worst first
  long poses = 0;  ///< looked at
};

/// `x`: variables of the problem without poses of its own; `imposed`: where index and limits are held.
Look look_over(const Problem& problem, const Region& region, const Imposed& imposed, const Eigen::VectorXd& x,
               const RegionSettings& settings, const Control& control);

/// The largest logarithm of the index at poses of the problem and at imposed ones; infinity where none is bounded.
double imposed_index(const Problem& problem, const Region& region, const Imposed& imposed, const Eigen::VectorXd& x);

/// How long the last round of an exchange took.
class RoundClock {
 public:
  void begin() {
    const auto now = std::chrono::steady_clock::now();
    last_ = now - begun_;
    begun_ = now;
  }
  double seconds() const { return std::chrono::duration<double>(last_).count(); }

 private:
  std::chrono::steady_clock::time_point begun_ = std::chrono::steady_clock::now();
  std::chrono::steady_clock::duration last_{};
};

/// How far an exchange is, in words: its design after so many rounds, by how much that passes between the poses, and a
/// guess, from the rate of all rounds so far and the time of the last, how long it takes until no more than `passed`
/// is.
std::string so_far(double objective, double excess, int rounds, double passed, const RoundClock& clock);

/// Which of the poses have an index within `near` of the largest over all of them, a margin below it, or a leg that is
/// nearly as long or short as at any: what decides a design is among them.
std::vector<Vec6> nearly_deciding(const Problem& problem, const Region& region, const std::vector<Vec6>& at,
                                  const Eigen::VectorXd& x, double near);

}  // namespace ninedof
