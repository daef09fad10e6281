#pragma once
/// The extremes over all poses that limits ask for: each one once, however many limits ask, and all searched together.

#include <utility>
#include <vector>

#include "limits/table.hpp"
#include "ninedof/proof/machine.hpp"

namespace ninedof::over_region {

/// What is asked of an item of a limit.
struct Question {
  bool greatest;       ///< its greatest or its least value
  bool at_neutral;     ///< over the neutral pose alone
  double limit;        ///< the value that it is compared with; NaN: none
  LimitOptions options = {};
};

class Questions {
 public:
  /// Over the neutral pose where the machine has no others.
  Questions(const PosedRobot& machine, const ProofSettings& settings, const Control& control);

  /// The number of an extreme, for operator[]. All limits of lengths ask for the same ones.
  std::size_t ask(const LimitRow& row, int item, const Question& question);
  /// Of the shortest and of the longest length of a leg.
  std::pair<std::size_t, std::size_t> ends_of_leg(int leg, bool at_neutral);

  void search();
  /// Those of lengths once more, to narrower enclosures.
  void search_lengths_again();

  const Extreme& operator[](std::size_t number) const { return asked_[number].found; }
  /// Every pose of the region where one was met.
  std::vector<MetAt> met_in_region() const;

 private:
  struct Asked {
    PoseQuantity quantity;
    bool at_neutral, of_length;
    Extreme found = {};
  };
  /// Those that `wanted` accepts, with `take(asked, found)` for each.
  template <class Wanted, class Take>
  void search(const Wanted& wanted, const Take& take);

  PosedRobot machine_, at_neutral_;
  const ProofSettings& settings_;
  const Control& control_;
  std::vector<Asked> asked_;
};

}  // namespace ninedof::over_region
