#pragma once
/// What a design has to keep, number by number, and its bounds over boxes of designs and poses.

#include "proof/checker/posed.hpp"

namespace ninedof::checker::sets {

/// One number that has to be positive. Its limit is 0 for singularities, 1 for 0 < zs < zp, and counts from 2 on.
struct Want {
  enum class About { height, length, cone, pair, determinant, spread, condition, duty, design };
  About about;
  int limit = 0;
  int item = 0;    ///< a leg, a pair, a determinant, the leg that is longest; of the design which piece
  int second = 0;  ///< the leg that is shortest; of condition numbers that is locked, 3 to 8
  bool high = true;  ///< whether the limit is a greatest value
  bool platform = false;
};

/// All that a file asks for; names of limits that the checker does not know go to `unknown`.
std::vector<Want> wants_of(const DesignsFile& file, std::vector<std::string>& unknown);

/// Two patches: the second counts for spreads alone.
struct Spot {
  Patch at, other;
};

/// Over a box of designs and poses the number is at least `low`; for all designs of a box at a single pose at most
/// `high`.
struct Weighed {
  double low = -inf, high = inf;
  /// How far the coordinates move its legs: poses of `at`, designs, poses of `other`.
  std::array<double, symbols + pose_symbols> moves{};
};

/// Numbers over a box of poses of one machine: the limit is kept where all of `keeps` are positive, and broken where
/// one of `breaks` is negative.
struct Sides {
  std::vector<Linear> keeps, breaks;
};

/// A box of designs with what all numbers share.
class Weigher {
 public:
  Weigher(const DesignsFile& file, const Cube& designs);
  Weighed weigh(const Want& want, const Spot& spot) const;
  /// Of one machine; for wants that are about a pose.
  Sides sides(const Want& want, const Patch& patch) const;

 private:
  struct Posed {
    const Mount& mount;
    Stand stand;
    LegLine leg(int k) const { return leg_line(mount, stand, k); }
  };
  Linear number(const Want& want, const Posed& at, Weighed& out) const;
  void pair(const Want& want, const Posed& at, const Patch& patch, Weighed& out) const;
  void spread(const Want& want, const Spot& spot, Weighed& out) const;
  void duty(const Want& want, const Posed& at, const Patch& patch, Weighed& out) const;
  void design(const Want& want, Weighed& out) const;
  Linear determinant(const Posed& at, int which, bool of_units) const;
  const LimitLine& line(const Want& want) const { return file_.limits[static_cast<std::size_t>(want.limit - 2)]; }
  double bound(const Want& want) const { return want.high ? line(want).range.b : line(want).range.a; }
  Linear in_unit(const Want& want) const { return line(want).of == "zp" ? bound(want) * mount_.zp : bound(want); }
  void take(const Linear& x, const Patch& patch, Weighed& out) const;

  const DesignsFile& file_;
  Mount mount_;
  std::array<double, 3> side_{};          ///< of each determinant at home, in the middle
  std::array<bool, 3> side_of_all_{};  ///< whether it is that of all designs
};

/// Whether kappa <= K over the box (1), kappa > K for all designs at the single pose (-1), or neither is known (0);
/// with an internal leg locked where that is not -1.
int condition_within(const Mount& m, const Stand& at, double length, double most, int locked = -1);

/// Planes beyond which kappa is within `most` over the box, and below which it is not.
Sides condition_sides(const Mount& m, const Stand& at, double length, double most, int locked);

using Point = std::array<double, 3>;
/// The corners of the part of the box -1 to 1 where slope . t >= level.
std::vector<Point> corners_beyond(const Point& slope, double level);

/// Forces, greatest rates or powers of legs, for each load: of what moduli the limit is.
std::vector<Linear> leg_duties(const DutyLines& duty, const Mount& m, const Stand& at, const LegDuties& of);

}  // namespace ninedof::checker::sets
