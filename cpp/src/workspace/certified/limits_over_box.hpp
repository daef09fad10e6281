#pragma once
/// The criteria of a workspace over a box of positions, each as cuts: planes beyond which it is proved to hold, or to
/// be violated.

#include <bitset>

#include "conditioning/forms/gram.hpp"
#include "limits/leg_clearance.hpp"
#include "ninedof/workspace/certified.hpp"
#include "workspace/criteria/limits.hpp"

namespace ninedof::certified {

using forms::Slope3;

/// A plane as in BoxCut.
struct Cut {
  Slope3 slope{};
  double allowed = std::numeric_limits<double>::infinity();
  double forbidden = -std::numeric_limits<double>::infinity();
};

/// A side of a limit of an item, as one of u: at least or at most that; none is 0.
struct Edge {
  bool least;
  std::optional<PoseForm> at;
};

/// One bit for each number with a limit that is not proved to be kept yet.
using Criteria = std::bitset<128>;  // all limits at once have at most 124

struct PositionBox {
  Vec3 low, high;
};

class LimitsOverBox {
 public:
  LimitsOverBox(const Geometry& g, const WorkspaceDomain& domain, const InternalPointRule& rule,
                const WorkspaceCriteria& criteria, const Configuration& home);

  /// All criteria asked for.
  Criteria all() const { return all_; }
  std::size_t rotations() const { return rotations_.size(); }
  FormPose pose(const PositionBox& box, std::size_t rotation) const;

  struct Found {
    Criteria open;      ///< not proved to hold in all of the box
    bool violated = false;  ///< one is violated in all of it
    std::vector<Cut> cuts;  ///< of the open ones
  };
  /// Looks at the criteria that are `open`. The condition number is the dearest of all: `cheap_ones` leaves it open.
  Found look(const PositionBox& box, std::size_t rotation, Criteria open, bool cheap_ones) const;

  /// A box that holds all positions where the limits of the legs are met; infinite where they do not bound it.
  PositionBox reached() const;

 private:
  /// A limit at a pose: of each item its bit, -1 without a limit, its least number and what that says of u.
  struct RowCuts {
    struct Item {
      int bit;
      double low;
      std::vector<Edge> edges;  ///< none of pairs of legs
    };
    const PoseRow* row;
    FormHome home;
    std::vector<Item> items;
  };
  int add_bit();
  void add(const PoseRow& row, const FormHome& home, const std::vector<Interval>& ranges);
  /// Throws InvalidArgument unless a limit is proved to hold at home.
  void require_kept(const RowCuts& cuts, const Configuration& home, const std::string& name) const;
  /// u of an item, or its numerator where that is enough.
  static PoseForm u_of(const RowCuts& cuts, const FormLook& look, int item);
  void look_at(const RowCuts& cuts, const FormPose& pose, Found& found) const;
  /// Returns whether the legs are at least the distance apart in all of the box.
  static bool look_at_pair(const LegPairForms& legs, double distance, Found& found);
  /// A limit of the condition number, with a leg locked or, with -1, without.
  struct ConditionLimit {
    int bit, locked;
    double high;
  };
  void look_at(const ConditionLimit& limit, const FormPose& pose, Found& found) const;
  /// The poses where f > 0 are allowed, those where f < 0 are not. Returns whether that is decided.
  static bool decided(const PoseForm& f, Found& found);
  /// Whether two legs are at least the distance apart in all of the box; else where they are.
  static bool all_apart(const LegPairForms& legs, double distance, Cut& apart);
  PositionBox reached_with(std::size_t rotation) const;

  Geometry geometry_;
  WorkspaceCriteria criteria_;
  InternalPointRule rule_;
  bool some_;  // one allowed rotation is enough
  std::vector<std::array<FormVector, 3>> rotations_;  // by columns
  std::vector<RowCuts> rows_;  // the cheap ones first
  std::vector<ConditionLimit> conditions_;
  int bits_ = 0;
  Criteria all_;
};

}  // namespace ninedof::certified
