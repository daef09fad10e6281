#pragma once
/// The criteria of a workspace over a box of positions, each as cuts: planes beyond which it is proved to hold, or to be
/// violated.

#include <cstdint>

#include "conditioning/forms/gram.hpp"
#include "limits/leg_clearance.hpp"
#include "limits/pose_row.hpp"
#include "ninedof/workspace/certified.hpp"

namespace ninedof::certified {

using forms::Slope3;

/// A plane as in BoxCut.
struct Cut {
  Slope3 slope{};
  double allowed = std::numeric_limits<double>::infinity();
  double forbidden = -std::numeric_limits<double>::infinity();
};

/// One bit for each criterion that is not proved yet.
using Criteria = std::uint64_t;

struct PositionBox {
  Vec3 low, high;
};

class PoseCuts {
 public:
  PoseCuts(const Geometry& g, const WorkspaceDomain& domain, const InternalPointRule& rule,
           const WorkspaceCriteria& criteria, const Configuration& home);

  /// All criteria asked for.
  Criteria all() const { return all_; }
  std::size_t rotations() const { return rotations_.size(); }
  FormPose pose(const PositionBox& box, std::size_t rotation) const;

  struct Found {
    Criteria open = 0;      ///< not proved to hold in all of the box
    bool violated = false;  ///< one is violated in all of it
    std::vector<Cut> cuts;  ///< of the open ones
  };
  /// Looks at the criteria that are `open`. The condition number is the dearest of all: `cheap_ones` leaves it open.
  Found look(const PositionBox& box, std::size_t rotation, Criteria open, bool cheap_ones) const;

  /// A box that holds all positions where the limits of the legs are met; infinite where they do not bound it.
  PositionBox reached() const;

 private:
  void look_at_legs(const FormPose& pose, Found& found) const;
  void look_at_cones(const FormPose& pose, bool platform, Found& found) const;
  void look_at_clearance(const FormPose& pose, Found& found) const;
  void look_at_signs(const FormPose& pose, Found& found) const;
  void look_at_condition(const FormPose& pose, Found& found) const;
  /// The poses where f > 0 are allowed, those where f < 0 are not. Returns whether the criterion is decided.
  static bool decided(const PoseForm& f, Criteria bit, Found& found);
  static void put(const Cut& cut, Found& found);
  /// Whether two legs are at least the distance apart in all of the box; else where they are.
  static bool all_apart(const LegPairForms& legs, double distance, Cut& apart);
  PositionBox reached_with(std::size_t rotation) const;

  Geometry geometry_;
  WorkspaceCriteria criteria_;
  InternalPointRule rule_;
  FormHome home_;
  bool some_;  // one allowed rotation is enough
  std::vector<std::array<FormVector, 3>> rotations_;  // by columns
  std::optional<FormHome> base_home_, platform_home_;  // with the axes of cones
  PoseForm least_base_cosine_, least_platform_cosine_;
  Criteria all_ = 0;
};

}  // namespace ninedof::certified
