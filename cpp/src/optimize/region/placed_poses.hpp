#pragma once
/// Poses of a region with O at each: which of them decide a design, and which join.

#include "math/numbers.hpp"
#include "ninedof/optimize/region_placement.hpp"
#include "optimize/region/posed.hpp"

namespace ninedof {

/// A design with O at the listed poses of the problem, then at poses of the region.
struct PlacedState {
  PlacedDesign design;
  std::vector<Placed> ruling;  ///< of the region; their shifts are the last ones of the design
};

/// A search of the region, O being placed at every pose.
struct PlacedLook {
  std::vector<PlacedEnd> worse;  ///< ends that pass, the worst first
  std::vector<double> excess;    ///< at the poses that rule; negative: to spare
  PlacedEnd worst;               ///< of the index
  double margin = infinity;
  std::string limit;
  long poses = 0;
};

class PlacedPoses {
 public:
  PlacedPoses(const Problem& problem, const Region& region);

  const Problem& alone() const { return alone_; }
  double zp(const PlacedDesign& design) const { return design.variables[zp_]; }
  /// The problem with these poses, O free at each.
  Problem posed(const std::vector<Placed>& ruling) const;
  /// A full set of its variables.
  Eigen::VectorXd variables(const PlacedState& state) const;
  PlacedState state(const Eigen::VectorXd& full, const std::vector<Placed>& ruling, double log_objective) const;
  /// The pose with O where it is placed.
  Pose pose(const Placed& placed, const PlacedDesign& design) const;
  /// Where O is in a region with O shifted.
  Vec3 shifted(const Vec6& at, const PlacedDesign& design) const;

  PlacedLook look(const PlacedState& state, const RegionSettings& settings, double passed,
                  const Control& control) const;
  /// The lengths of the legs at all poses of a design.
  std::vector<Vec9> lengths(const PlacedState& state) const;

  /// The poses where O leaves less than `idle` to spare or a leg is longest or shortest, and the first.
  std::vector<Placed> kept(const PlacedState& state, const PlacedLook& look, double idle) const;
  /// Those that decide the design, of neighbours only the worst.
  std::vector<Placed> deciding(const PlacedState& state, const PlacedLook& look) const;
  /// Those, and the worse ones, of which none is too near to another.
  std::vector<Placed> joined(std::vector<Placed> ruling, const PlacedLook& look) const;
  /// The ruling poses without neighbours of the worse ones, and these.
  std::vector<Placed> replaced(const PlacedState& state, const PlacedLook& look) const;
  /// Whether all worse poses are there already.
  bool nothing_new(const PlacedState& state, const PlacedLook& look) const;

 private:
  bool beside(const Placed& placed, const std::vector<Placed>& others) const;

  const Problem& problem_;
  Region region_;  // O held: shifts count from its neutral position
  Problem alone_;
  Eigen::Index zp_;
  std::size_t listed_;
};

}  // namespace ninedof
