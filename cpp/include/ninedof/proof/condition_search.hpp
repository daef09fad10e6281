#pragma once
/// The worst condition number of a machine in searches one after another, with states that another run goes on from.

#include <functional>
#include <limits>
#include <vector>

#include "ninedof/proof/machine.hpp"

namespace ninedof {

/// What is known of the worst condition number. Outside of the boxes of `left` it is proved to be at most `target`.
struct ConditionState {
  double low = 0.0;                                       ///< met; 0: nothing was looked at
  double high = std::numeric_limits<double>::infinity();  ///< proved
  MetAt at;                                               ///< where `low` was met
  long boxes = 0;                                         ///< looked at
  PoseBoxes left;  ///< empty where there are more than ConditionSettings::most_left
  std::size_t left_count = 0;
  double target = std::numeric_limits<double>::infinity();  ///< the bound that was tried last
  bool interrupted = false;
};

struct ConditionSettings {
  int threads = 0;              ///< 0: one per processor
  double seconds = 60.0;        ///< of wall time, of all searches together
  double gap = 0.05;            ///< relative width of the enclosure at which its bounds are narrow enough
  std::vector<double> wanted = {}; ///< bounds to be proved where they lie inside the enclosure
  double tolerance = 0.0;       ///< relative: a wanted bound that is passed by no more counts as kept
  double slice_seconds = 20.0;  ///< between two states that are kept
  double least_seconds = 0.1;   ///< of a search, also where the time is over
  double keep_share = 20.0;     ///< a slice takes at least so many times what keeping the last state took
  std::size_t most_left = 20'000;  ///< boxes in a state: a state is a file
};

/// Encloses the worst condition number up to the gap, then proves the wanted bounds that lie inside the enclosure.
///
/// `earlier` is the state of another run over the same poses, whose boxes are gone on with; the default begins anew.
/// `keep` is called on this thread with the state after every slice; without it there are no slices. On a stop, or
/// when the time is over, the state says what is left. Progress counts the boxes of the state. Throws InvalidArgument
/// for boxes of other poses.
ConditionState search_condition(const PosedRobot& machine, const ConditionSettings& settings,
                                ConditionState earlier = {},
                                const std::function<void(const ConditionState&)>& keep = {},
                                const Control& control = {});

}  // namespace ninedof
