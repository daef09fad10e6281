#pragma once
/// Where the platform can work: a set of positions or of orientations, its volume, its boundary and what limits it.
///
/// A workspace is the set of points x of a three-dimensional chart (positions, or orientations by three numbers) whose pose is
/// allowed. Allowed means that every margin asked for is at least zero. The margins have different units; only their zero
/// matters, and that they are nearly linear close to it.

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "ninedof/math/control.hpp"
#include "ninedof/redundancy/redundancy.hpp"
#include "ninedof/redundancy/redundancy_map.hpp"
#include "ninedof/robot/configuration.hpp"
#include "ninedof/robot/geometry.hpp"

namespace ninedof {

/// Which set of poses is meant. The dexterous workspace is the inclusive one of spread_rotations over all of SO(3).
enum class Archetype {
  constant_orientation,  ///< positions, the rotation fixed
  orientation,           ///< rotations of a region, the position fixed
  reachable,             ///< positions at which some rotation of a set is allowed
  inclusive,             ///< positions at which every rotation of a set is allowed
};

/// A region of SO(3) in three coordinates, about a rotation Q0: Q = R(x) Q0.
struct OrientationRegion {
  enum class Chart {
    rotation_vector,  ///< R = exp(x), |x| <= angle: a ball of SO(3)
    tilt_torsion,  ///< R = exp((-x2, x1, 0)) Rz(x3): tilt hypot(x1, x2) <= angle towards atan2(x2, x1), then torsion x3
  };
  Chart chart = Chart::rotation_vector;
  double angle = 0.5;  ///< at most pi
  double torsion_low = -0.5, torsion_high = 0.5;  ///< radians, at most 2 pi apart
};

struct WorkspaceDomain {
  Archetype archetype = Archetype::constant_orientation;
  Vec3 low = Vec3::Zero(), high = Vec3::Zero();  ///< box of positions; not for `orientation`
  Vec3 position = Vec3::Zero();  ///< of `orientation`
  std::vector<Mat3> rotations{Mat3::Identity()};  ///< the fixed one, Q0 of the region, or the set
  OrientationRegion region;  ///< of `orientation`
};

/// Where O is at each pose.
struct InternalPointRule {
  enum class Kind {
    fixed,  ///< at `point`, base frame
    between,  ///< at `fraction` of the way from the centroid of the lower to that of the upper internal joints
    platform,  ///< at `point`, platform frame
    best,  ///< where the condition number is least under the leg limits
  };
  Kind kind = Kind::between;
  double fraction = 0.5;
  Vec3 point = Vec3::Zero();
};

/// The angle between each leg and an axis of the body it starts from, as base_cone and platform_cone of constraints.hpp.
struct ConeLimit {
  double angle = 0.0;  ///< greatest, radians
  Vec3 axis = Vec3::Zero();  ///< in the body's frame; zero: the leg's own direction at the home configuration
};

/// What makes a pose allowed. What is not given is not asked for.
struct WorkspaceCriteria {
  std::optional<LegLimits> legs;
  std::optional<ConeLimit> base_cone, platform_cone;
  std::optional<double> leg_clearance;  ///< least distance of the axes of legs that share no joint
  std::optional<double> condition_number;  ///< greatest
  bool singularity_free = false;  ///< determinants signed as at home, and connected with it
  double characteristic_length = 1.0;  ///< of the condition number
};

struct WorkspaceSettings {
  enum class Method {
    octree,  ///< cells, divided where the boundary is
    grid,  ///< resolution^3 cells, judged by their centres
    sample,  ///< low-discrepancy points, randomly shifted
  };
  Method method = Method::octree;
  double tolerance = 1e-3;  ///< of the octree: error wanted, as a share of the volume
  int resolution = 16;  ///< cells along each side before any is divided
  long most_evaluations = 2'000'000;  ///< poses looked at
  long points = 16384;  ///< of one shift of a sample; poses that audit an octree
  int shifts = 16;
  std::uint64_t seed = 0;
  int threads = 0;
};

enum class WorkspaceStatus : std::uint8_t {
  converged,  ///< the error asked for is reached
  limited,  ///< most_evaluations came first
  empty,  ///< no allowed pose was found
  stopped,  ///< interrupted: what was known after the last whole level
};

const char* to_string(WorkspaceStatus status);

enum class CellState : std::uint8_t { outside, boundary, inside };

/// The cells at the end of the search, those outside included.
struct WorkspaceCells {
  std::vector<Vec3> centre;
  std::vector<std::uint8_t> level;  ///< side: of the box, over resolution * 2^level
  std::vector<CellState> state;
  std::vector<std::int16_t> limit;  ///< index into limit_names(): what ends the workspace here; -1 for none
  std::vector<double> fraction;  ///< of the cell that is allowed
  std::vector<double> condition_number;  ///< at the centre; of the best or worst rotation of a set
  std::vector<std::int32_t> piece;  ///< 0 for the largest, or for that of home; -1 outside
  std::size_t size() const { return centre.size(); }
};

struct InscribedBall {
  Vec3 centre = Vec3::Constant(std::numeric_limits<double>::quiet_NaN());
  double radius = 0.0;
};
struct InscribedBox {
  Vec3 low = Vec3::Constant(std::numeric_limits<double>::quiet_NaN());
  Vec3 high = Vec3::Constant(std::numeric_limits<double>::quiet_NaN());
};

/// What was known after each level of the octree.
struct WorkspaceLevel {
  long cells, evaluations;
  double volume, error;
};

struct WorkspaceMap {
  WorkspaceStatus status = WorkspaceStatus::empty;
  double volume = std::numeric_limits<double>::quiet_NaN();  ///< length^3, or radians^3 (8 pi^2 is all of SO(3))
  double error = std::numeric_limits<double>::quiet_NaN();  ///< estimate; a standard error for a sample
  double unseen =
      0.0;  ///< 95 % bound for the volume of features that every cell and audit pose, or every point, missed
  double chart_volume = 0.0;  ///< of the box or region
  bool box_limits = false;  ///< the workspace runs to the box (or region): a larger one would hold more
  bool home_allowed = false;
  std::int16_t home_limit = -1;  ///< what forbids the home pose
  std::vector<double> pieces;  ///< volumes of the connected pieces, the one counted first
  InscribedBall ball;
  InscribedBox box;
  double conditioning_index = std::numeric_limits<double>::quiet_NaN();  ///< mean of 1 / condition number
  double conditioning_index_error = std::numeric_limits<double>::quiet_NaN();
  double worst_condition_number = std::numeric_limits<double>::quiet_NaN();
  Vec3 worst_at = Vec3::Constant(std::numeric_limits<double>::quiet_NaN());
  std::vector<double> percentiles;  ///< of the condition number over the volume: at 0, 1, ..., 100 %
  double boundary_area = 0.0;  ///< in coordinates of the chart
  std::vector<double> limit_area;  ///< by index into limit_names()
  WorkspaceCells cells;
  std::vector<WorkspaceLevel> levels;
  MapAudit internal_points;  ///< of the best O: how often going on from nearby points missed a better one
  Vec3 low = Vec3::Zero(), high = Vec3::Zero();  ///< of the chart
  int resolution = 0;
  long evaluations = 0;
};

/// "l1 low", ..., "base_cone r2", "leg_clearance l1 q2", "condition_number", "det M", "region", "box", "internal_point".
const std::vector<std::string>& limit_names();

/// Rotations that cover the ball of angle `angle` about the identity evenly: the identity, then a low-discrepancy sequence by
/// Haar's measure. Where the ball is not all of SO(3), every other one lies on its rim, where most legs have their extremes.
std::vector<Mat3> spread_rotations(int count, double angle = 3.14159265358979323846);

/// The workspace. `home` gives the signs of the determinants, the axes of cones and the piece that is counted; by default the
/// middle of the box, or Q0, with O by the rule.
///
/// Octree: the box is cut into resolution^3 cells. Margins are known at the corners and the centre of a cell. It is outside for
/// certain where an external leg, or any leg with O by a rule, is further beyond its limit at the centre than a length can change
/// within the cell. Else it is judged: inside or outside if all nine points agree, by more than the margins curve between
/// them. All others are divided, again and again. In the smallest the boundary is linear in six tetrahedra, so that
/// the volume has an error of the order of the square of the cell; `error` compares two levels. Poses of a low-discrepancy
/// sequence audit the judgement: a cell in which one disagrees is divided as well. `unseen` bounds what could still hide.
///
/// The best O is that of best_internal_map at the first corners (or the centres of a grid). At every other point it is continued
/// from two points around it that are known by then, each pose being searched where that fails. A sample searches all its poses.
///
/// Throws InvalidArgument naming what makes no sense. The same bits for any number of threads.
WorkspaceMap workspace(const Geometry& g, const WorkspaceDomain& domain, const InternalPointRule& rule,
                       const WorkspaceCriteria& criteria, const WorkspaceSettings& settings = {},
                       const std::optional<Configuration>& home = {}, const Control& control = {});

}  // namespace ninedof
