#pragma once
/// What a certificate of a set of admissible designs, or of a workspace, says, before anything of it is believed.

#include <array>
#include <string>
#include <vector>

#include "proof/checker/certificate_file.hpp"
#include "proof/checker/linear.hpp"

namespace ninedof::checker::sets {

using Triple = std::array<double, 3>;

/// A box of poses. Piece -1 is the neutral pose, -2 - k listed pose k, and others are those of the region: all of it,
/// or straight part k of a path. Coordinates: the shift of p in the unit of the region (of a path the first, from 0 to
/// 1 along the part), the tilt vector about x and y, the yaw.
struct Patch {
  int piece = -1;
  std::array<double, pose_symbols> low{}, high{};
};

struct RegionLine {
  std::string shape;  ///< "none", "box", "ball", "cylinder" or "path"
  Triple size{};
  double tilt = 0.0, yaw = 0.0;
  bool shifted = true, in_zp = false;
  std::vector<Triple> corners;
};

struct PoseLine {
  Triple position, rotation, internal;
  bool in_zp = false;
};

struct LimitLine {
  std::string name;
  Range range;
  std::string of;  ///< "length", "zp" or "radius"
  bool at_neutral = false;
  Triple axis{};  ///< of cones; zero: the direction of the leg at home
};

/// The duty of a machine, of which limits of forces, rates and powers are.
struct DutyLines {
  Triple gravity{}, centre{};  ///< the centre of the platform's mass in the frame of the pose
  double platform = 0.0, internal_point = 0.0;
  bool weighed = false;                     ///< whether the file says so
  std::vector<std::array<double, 4>> legs;  ///< a cylinder, its centre from the leg's start, a rod, its from the end
  std::vector<std::array<Triple, 3>> loads;  ///< a moment about p, a force on the platform, a force on O
  double linear = 0.0, angular = 0.0;  ///< speeds of the platform, in any direction
  std::string internal;  ///< how O moves then: "shifted", "carried", "held" or "least"
};

struct BoxLine {
  std::array<Range, most_varied_symbols> ends{};
  char state = 'u';  ///< 'i' inside, 'o' outside, 'u' undecided
  int limit = 0;  ///< of those outside: 0 for singularities, 1 for 0 < zs < zp, then the limits from 2 on
  Patch at, other;  ///< where all of the box break it; of a spread where a leg is longest and where shortest
};

/// The workspace of one robot: a box of positions, and how the rest of a pose follows from the position.
struct SpaceLines {
  std::vector<Triple> joints;     ///< base external, base internal, platform external, platform internal, three each
  std::array<double, 15> home{};  ///< p, the rows of Q, O
  Triple low{}, high{};
  std::string rule;  ///< of O: "fixed" at a point of the base, "platform" at one of it, or "between" the plates
  Triple point{};
  double fraction = 0.0;  ///< of the way from the centroid of the lower to that of the upper internal joints
  bool some = false;      ///< one rotation is enough, not all are needed
  std::vector<std::array<double, 9>> rotations;  ///< their rows
  Range volume;
  std::size_t tree = 0;  ///< bytes that follow
  bool present() const { return !joints.empty(); }
};

struct DesignsFile {
  std::string family;
  std::vector<Bound> variables;
  std::vector<std::size_t> varied;  ///< the variables that have a range
  std::array<double, 6> tool{};  ///< its point, its rotation vector
  double length = 1.0;  ///< the characteristic length
  RegionLine region;
  std::vector<PoseLine> poses;
  DutyLines duty;
  SpaceLines space;  ///< then family, variables, tool, region, poses, shares and boxes are none
  std::vector<LimitLine> limits;
  std::vector<int> exempt;  ///< pairs of legs that share a joint in all designs
  std::array<double, 3> shares{};
  std::vector<BoxLine> boxes;
};

/// What of which legs a limit of forces, rates or powers is about; no leg for another limit.
struct LegDuties {
  bool force = false, rate = false;
  int first = 0, count = 0;
};
LegDuties duties_of(const std::string& limit);

constexpr const char* kind_of_designs = "ninedof certificate of designs 1";
constexpr const char* kind_of_workspace = "ninedof certificate of a workspace 1";

/// Accepts one spelling of each certificate, as `read` does. Of a workspace the tree is left to be read.
DesignsFile read_designs(Stream& file);

/// Refuses an unknown family, and variables that are not all of its own in their order.
void require_variables(const std::string& family, const std::vector<Bound>& variables);

/// The question for people.
std::vector<std::string> question_of(const DesignsFile& file);

const char* name_of_leg(int leg);
/// The legs of pair 0 to 20: three of external legs, then each of these with the six internal ones.
std::array<int, 2> legs_of_pair(int pair);

}  // namespace ninedof::checker::sets
