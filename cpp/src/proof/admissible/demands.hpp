#pragma once
/// All that a study demands of a design, as items at poses, spreads of lengths over all poses, and limits of the design
/// alone.

#include <vector>

#include "proof/admissible/climb.hpp"

namespace ninedof::admissible {

/// A limit of the longest and the shortest lengths over all poses together.
struct Spread {
  const SpreadRow* row;
  double high;
  bool of_zp, at_neutral;
  int demand;  ///< of leg 1, where each leg has its own
};

/// A side of a limit of the design alone.
struct Alone {
  const DesignRow* row;
  Side side;
  double bound;
  Unit of;
  int demand;
};

/// Pairs of legs whose joints coincide in every design of the study, and in every design that is asked about: it may be
/// asked about more than the study has.
std::array<bool, 21> pairs_that_may_meet(const DesignQuestion& question);

struct Demands {
  explicit Demands(const DesignQuestion& question);
  std::vector<Demand> names;
  std::vector<Item> items;
  std::vector<Spread> spreads;
  std::vector<Alone> alone;
  int between_plates = 0;  ///< 0 < zs < zp, eq. (9b), which holds in every study
};

/// The lengths of the legs over all poses, each looked for once.
class Spreads {
 public:
  Spreads(const DesignsAt& designs, const std::stop_token& stop);
  Found look_at(const Spread& spread);
  /// The margin of a spread at the poses of a loss.
  Met meet(const Spread& spread, const Loss& loss) const;

 private:
  const Envelope& of(const Spread& spread, int leg, double sign, bool closely);
  Found look_at(const Spread& spread, int longest, int shortest, bool closely);
  Plane margin(const Spread& spread, const Plane& less_longest, const Plane& shortest, bool above) const;

  const DesignsAt& designs_;
  const std::stop_token& stop_;
  /// At the neutral pose alone or not, closely or not, shortest or longest.
  std::array<std::array<std::array<std::array<Envelope, 9>, 2>, 2>, 2> known_;
  long boxes_ = 0;
};

Found look_at_heights(const DesignForms& forms, int demand);
Found look_at(const DesignForms& forms, const Alone& alone);

}  // namespace ninedof::admissible
