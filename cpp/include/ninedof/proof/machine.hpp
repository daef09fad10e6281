#pragma once
/// What a machine does over a whole region of poses, proved: lengths of legs, angles at joints, distances of legs,
/// determinants and the condition number, each enclosed from a pose that was met and from bounds that hold everywhere.
///
/// Assumed: the arithmetic of interval.hpp.

#include <array>
#include <limits>
#include <string>
#include <vector>

#include "ninedof/domains/region.hpp"
#include "ninedof/limits/limits.hpp"
#include "ninedof/math/control.hpp"
#include "ninedof/math/interval.hpp"
#include "ninedof/proof/point_rule.hpp"
#include "ninedof/robot/configuration.hpp"
#include "ninedof/robot/geometry.hpp"
#include "ninedof/robot/tool.hpp"
#include "ninedof/statics/accuracy.hpp"

namespace ninedof {

/// A robot, and all poses at which it is looked at: those of the region, if there is one, and those listed.
struct PosedRobot {
  Geometry geometry;
  Configuration neutral;
  double characteristic_length = 1.0;
  std::vector<Region> region;  ///< none or one
  std::vector<Configuration> poses;
  std::vector<PointRule> rule;  ///< none or one: where s is in the region, in place of what the region says
  Tool tool = {};  ///< whose frame the geometry has; limits of the design alone are of the plates
  /// Statements are about every machine whose joints and leg lengths are within these of the drawing. Its platform is
  /// at the pose, its cones have the axes of the drawing, and its lengths are as actuators read them.
  Tolerances tolerances = {};
};

/// A number of a pose: what a limit is about, for one of its items.
struct PoseQuantity {
  std::string limit_name = "leg_length";  ///< a limit that has a value at every pose
  int item = 0;  ///< a leg, a pair of legs (leg_pairs.hpp), det N, B or C
  LimitOptions options = {};
  bool greatest = true;  ///< which end of its range is asked for
  double relative = 1e-7;  ///< width of its enclosure at which the search ends
  /// Where this is within the enclosure, the search goes on to ProofSettings::relative.
  double limit = std::numeric_limits<double>::quiet_NaN();
  double scale = 0.0;  ///< `relative` is a share of this where the number is less
};

/// Where a number was met: the piece of the domain, and its place in it.
struct MetAt {
  Vec3 shift = Vec3::Zero();  ///< of p from its neutral position, lengths
  Vec3 tilt = Vec3::Zero();  ///< rotation vector about a horizontal axis
  double yaw = 0.0;
  int pose = -1;  ///< index of a listed pose; -1: a pose of the region
};

/// The greatest or least value over all poses, and machines within tolerances, is within [low, high]. One end was met.
struct Extreme {
  double low = 0.0, high = 0.0;
  MetAt at;
  long boxes = 0;
};

struct ProofSettings {
  int threads = 0;  ///< 0: one per processor
  double seconds = 60.0;  ///< of wall time
  double relative = 1e-7;  ///< see PoseQuantity::limit
  double gap = 0.05;  ///< the same of the condition number
  double condition = 0.0;  ///< a condition number to be proved instead; 0: none
  int locked = -1;  ///< of the condition number: an internal leg that is locked, 3 to 8; -1: none
  /// At most, for a number; ten times as many where O follows a rule: it is fitted until limits are only just kept.
  long boxes = 200'000;
};

/// The extreme values over all poses. On a stop or when the time is over, enclosures are wider.
std::vector<Extreme> pose_extremes(const PosedRobot& machine, const std::vector<PoseQuantity>& quantities,
                                   const ProofSettings& settings, const Control& control = {});

/// One side of a limit over all poses.
struct LimitOverPoses {
  std::string name;  ///< its label; "no singularity" for the three determinants, which have no limit but 0
  LimitKind kind = LimitKind::ratio;  ///< as in the table of limits, whatever a length is a fraction of
  Side side = Side::high;
  double limit = 0.0;  ///< a length, radians or a ratio: what is a fraction of zp or a radius is multiplied by it
  Interval value;  ///< holds the worst value; one end was met, by a machine within tolerances
  enum class Answer { proved, violated, undecided } answer = Answer::undecided;
  std::string part;  ///< the leg, pair of legs or determinant that is worst
  std::vector<MetAt> at;  ///< where it was met; of a stroke where the leg is longest and where shortest
  bool at_neutral = false;  ///< the limit holds at the neutral pose alone
  long boxes = 0;
};

struct LimitsOverPoses {
  std::vector<LimitOverPoses> limits;  ///< "no singularity", then those given, in their order
  std::array<Interval, 9> lengths;  ///< every leg is between lo and hi
  std::vector<MetAt> met;  ///< every pose of the region where an extreme was met
};

/// Where the worst value of each limit is, and in what it is enclosed; over the neutral pose alone where the machine
/// has no others. Pairs of legs that are `exempt` may meet if their joints coincide in this machine. `slack`: of a
/// limit, relative; one that is passed by no more counts as kept; with one above 0 strokes are searched once more where
/// they are undecided. `settings.seconds` are of each search. Throws InvalidArgument for a limit that is not valid.
LimitsOverPoses limits_over_poses(const PosedRobot& machine, const std::vector<Limit>& limits,
                                  const std::array<bool, 21>& exempt, double slack, const ProofSettings& settings,
                                  const Control& control = {});

/// Boxes of poses: numbers of the piece, then low and high ends of its six coordinates.
using PoseBoxes = std::vector<std::array<double, 13>>;

/// The greatest condition number over all poses.
struct WorstOverPoses {
  Extreme extreme;
  PoseBoxes left;  ///< where nothing better than extreme.high, or the condition number asked for, is proved
  double tried = 0.0;  ///< the bound that was tried last
  /// Of machines within tolerances that differ too much at one pose for the bound tried last: the least that is proved
  /// there. The search ended then, and no boxes are left: no division of poses helps.
  double least_there = 0.0;
  bool interrupted = false;
};

/// `from`: boxes that another run has left, with the upper bound proved elsewhere; empty: all poses.
WorstOverPoses worst_condition(const PosedRobot& machine, const ProofSettings& settings, const PoseBoxes& from = {},
                               const Control& control = {});

/// How far the platform and O may be from a pose, of every machine within tolerances whose legs have the lengths that
/// the drawing has there: the first number to first order at the worst pose found, the second proved, of all poses.
struct ErrorOverPoses {
  Interval position;  ///< of p
  Interval rotation;  ///< angle, radians
  Interval internal_point;  ///< of O
  long boxes = 0;
};
ErrorOverPoses error_over_poses(const PosedRobot& machine, const ProofSettings& settings, const Control& control = {});

}  // namespace ninedof
