#pragma once
/// The workspace of the platform: a set of positions or of orientations, its volume, its boundary and what limits it.
///
/// A workspace is the set of points x of a three-dimensional chart (positions, or orientations by three coordinates)
/// whose pose is allowed: every margin asked for is at least zero. Margins have different units. The search uses only
/// where they are zero and that they are nearly linear there.

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "ninedof/limits/limits.hpp"
#include "ninedof/limits/numbers.hpp"
#include "ninedof/math/control.hpp"
#include "ninedof/redundancy/redundancy.hpp"
#include "ninedof/redundancy/redundancy_map.hpp"
#include "ninedof/robot/configuration.hpp"
#include "ninedof/robot/geometry.hpp"

namespace ninedof {

/// The set of poses. The dexterous workspace is the inclusive one of spread_rotations over all of SO(3).
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

/// The rule that gives O at each pose.
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

/// The criteria of an allowed pose; those without a value do not apply.
struct WorkspaceCriteria {
  std::optional<LegLimits> legs;
  /// Limits with a value at every pose (limits_of_poses(), but for those of lengths, which `legs` has), in lengths or
  /// radians. Home is their neutral configuration. Of one that also has to hold on the way (singularity_free), poses
  /// are allowed that are connected with home; without a low side its determinants have the signs of home.
  std::vector<Limit> limits;
  /// Pairs of legs that may meet if their joints coincide in this robot.
  std::array<bool, 21> exempt = all_pairs;
  std::optional<double> condition_number;  ///< greatest
  double characteristic_length = 1.0;  ///< of the condition number
};

struct WorkspaceSettings {
  enum class Method {
    octree,  ///< cells divided at the boundary
    grid,  ///< resolution^3 cells, judged by their centres
    sample,  ///< low-discrepancy points, randomly shifted
  };
  Method method = Method::octree;
  double tolerance = 1e-3;  ///< of the octree: wanted error relative to the volume
  int resolution = 16;  ///< cells along each side before any is divided
  long most_evaluations = 2'000'000;  ///< greatest number of poses evaluated
  long points = 16384;  ///< of one shift of a sample; the first poses that audit an octree
  int shifts = 16;
  std::uint64_t seed = 0;
  int threads = 0;
};

enum class WorkspaceStatus : std::uint8_t {
  converged,  ///< the wanted error is reached
  limited,  ///< most_evaluations or the smallest cells are reached
  empty,  ///< no allowed pose was found
  stopped,  ///< interrupted: the state after the last complete level
};

const char* to_string(WorkspaceStatus status);

enum class CellState : std::uint8_t { outside, boundary, inside };

/// The cells at the end of the search, those outside included.
struct WorkspaceCells {
  std::vector<Vec3> centre;
  std::vector<std::uint8_t> level;  ///< side: of the box, over resolution * 2^level
  std::vector<CellState> state;
  std::vector<std::int16_t> limit;  ///< index into limit_names(): the limit of the workspace here; -1 for none
  std::vector<double> fraction;  ///< the allowed part of the cell
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

/// The estimate after each level of the octree.
struct WorkspaceLevel {
  long cells, evaluations;
  double volume, error;
};

struct WorkspaceMap {
  WorkspaceStatus status = WorkspaceStatus::empty;
  double volume = std::numeric_limits<double>::quiet_NaN();  ///< length^3, or radians^3 (8 pi^2 is all of SO(3))
  /// Estimate, with `unseen`; of a grid or sample without it, at least `unseen` where all points or none are allowed.
  /// Not of a part beyond a neck thinner than the smallest cell.
  double error = std::numeric_limits<double>::quiet_NaN();
  /// Upper bound, at 95 % confidence, of the volume of a feature that neither corners of cells nor audit poses show: a
  /// part of `error`. Many separate ones, of which the audit found some, may be larger. Without cells, of what every
  /// point missed.
  double unseen = 0.0;
  double chart_volume = 0.0;  ///< of the box or region
  bool box_limits = false;  ///< the workspace reaches the faces of the box or region: a larger one would contain more
  bool home_allowed = false;
  std::int16_t home_limit = -1;  ///< the limit that the home pose breaks
  std::vector<double> pieces;  ///< volumes of the connected pieces, the one counted first
  InscribedBall ball;
  InscribedBox box;
  double conditioning_index = std::numeric_limits<double>::quiet_NaN();  ///< mean of 1 / condition number
  double conditioning_index_error = std::numeric_limits<double>::quiet_NaN();
  double worst_condition_number = std::numeric_limits<double>::quiet_NaN();
  Vec3 worst_at = Vec3::Constant(std::numeric_limits<double>::quiet_NaN());
  /// Of the condition number over the volume, at 0, 1, ..., 100 %.
  std::vector<double> percentiles = std::vector<double>(101, std::numeric_limits<double>::quiet_NaN());
  double boundary_area = 0.0;  ///< in coordinates of the chart
  std::vector<double> limit_area;  ///< by index into limit_names()
  WorkspaceCells cells;
  std::vector<WorkspaceLevel> levels;
  MapAudit internal_points;  ///< of the best O: how often continuation from nearby points missed a better one
  Vec3 low = Vec3::Zero(), high = Vec3::Zero();  ///< of the chart
  int resolution = 0;  ///< 0 for a sample, whose points are no cells
  long evaluations = 0;
};

/// "l1 low", ..., "base_cone r2", "leg_clearance l1 q2", "condition_number", "det N", "region", "box",
/// "internal_point".
const std::vector<std::string>& limit_names();

/// Rotations that cover the ball of angle `angle` about the identity evenly: the identity, then a low-discrepancy
/// sequence by Haar's measure. Unless the ball is all of SO(3), every second rotation lies on its boundary, where most
/// legs have their extremes.
std::vector<Mat3> spread_rotations(int count, double angle = 3.14159265358979323846);

/// The workspace. `home` gives the signs of the determinants, the axes of cones and the piece that is counted; by
/// default the middle of the box, or Q0, with O by the rule.
///
/// Octree: the box is cut into resolution^3 cells, and the margins are evaluated at the corners and the centre of each.
/// Legs and the region are decided by bounds over the whole cell: it is proved to be outside if a leg violates its
/// limit throughout, and inside if nothing else limits and all legs are within theirs throughout. Other criteria are
/// judged: all nine points agree by more than the margins may curve between them. The rest are divided repeatedly. In
/// the smallest cells the boundary is taken as linear in six tetrahedra, so that the error of the volume is
/// proportional to the square of the cell size. An audit evaluates poses of a low-discrepancy sequence: a cell that one
/// of them contradicts is divided too. `error` compares levels, and includes `unseen`: what may still be hidden.
///
/// The best O is that of best_internal_map at the first corners (or the centres of a grid). At any other point it is
/// continued from two known points around it; a pose where that fails is searched. A sample searches all its poses.
///
/// Reports poses evaluated, poses in all as far as known, and the volume. A stop returns what is known. Throws
/// InvalidArgument naming the argument that is not valid. The same bits for any number of threads.
WorkspaceMap workspace(const Geometry& g, const WorkspaceDomain& domain, const InternalPointRule& rule,
                       const WorkspaceCriteria& criteria, const WorkspaceSettings& settings = {},
                       const std::optional<Configuration>& home = {}, const Control& control = {});

}  // namespace ninedof
