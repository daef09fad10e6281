#pragma once
/// A workspace of positions with a proof: boxes in which every pose is allowed, boxes in which none is, and bounds of
/// the volume. The set of poses, the rule for O and the criteria are those of workspace.hpp.
///
/// Assumed: the arithmetic of interval.hpp.

#include "ninedof/workspace/workspace.hpp"

namespace ninedof {

struct CertifySettings {
  double gap = 0.05;       ///< the search ends when the bounds of the volume differ by this part of the upper one
  double seconds = 60.0;   ///< of wall time
  int threads = 0;         ///< 0: one per processor
  long boxes = 4'000'000;  ///< looked at, at most
};

/// A plane across a box, t from -1 to 1 over each side: as far as one criterion goes, poses with slope . t >= allowed
/// are allowed and poses with slope . t <= forbidden are not.
struct BoxCut {
  Vec3 slope = Vec3::Zero();
  double allowed = std::numeric_limits<double>::infinity();
  double forbidden = -std::numeric_limits<double>::infinity();
};

struct VolumeBounds {
  double low = 0.0, high = 0.0;
};

struct CertifiedWorkspace {
  enum class End : std::uint8_t { gap, time, boxes, stopped, smallest };
  End end = End::gap;
  VolumeBounds volume;  ///< of all allowed positions in the box
  /// Of those connected with home, of which nothing is known where home itself is not proved to be allowed.
  VolumeBounds home_volume;
  bool home_inside = false;   ///< home is proved to be allowed
  bool home_outside = false;  ///< home is proved not to be allowed, or not in the box
  /// What lies outside the box: nothing allowed, proved; something, proved; or not known.
  enum class Beyond : std::uint8_t { nothing, something, unknown };
  Beyond beyond = Beyond::unknown;
  Vec3 box_low = Vec3::Zero(), box_high = Vec3::Zero();  ///< the box asked for
  Vec3 low = Vec3::Zero(), high = Vec3::Zero();  ///< of the box divided: nothing else in the box asked for is allowed
  std::vector<Vec3> inner_low, inner_high;  ///< every pose is allowed
  std::vector<Vec3> open_low, open_high;  ///< all others are in these boxes
  /// The cuts of open box n are those from first_cut[n] to first_cut[n + 1]: poses allowed by all are allowed, and
  /// those forbidden by one are not.
  std::vector<std::int64_t> first_cut;
  std::vector<BoxCut> cuts;
  std::vector<VolumeBounds> open_volume;  ///< of the allowed part of each
  long looked = 0;  ///< boxes
};

/// Boxes are halved, those first whose share of the gap between the bounds is the greatest, until the gap is small
/// enough. Reports boxes looked at, 0, and the lower bound of the volume. A stop returns what is known. Throws
/// InvalidArgument naming the argument that is not valid: orientations and the best O have no proof. The same bits for
/// any number of threads, unless the time ends the search.
CertifiedWorkspace certified_workspace(const Geometry& g, const WorkspaceDomain& domain, const InternalPointRule& rule,
                                       const WorkspaceCriteria& criteria, const CertifySettings& settings = {},
                                       const std::optional<Configuration>& home = {}, const Control& control = {});

/// The proof as a file that the checker (ninedof/proof/checker.hpp) replays: the question, and every box with its share
/// of allowed positions. It is about `volume` alone, not about what is connected with home or lies outside the box.
/// Throws InvalidArgument for limits with duties that differ, and for boxes that are not those of the question.
std::string workspace_certificate(const Geometry& g, const WorkspaceDomain& domain, const InternalPointRule& rule,
                                  const WorkspaceCriteria& criteria, const CertifiedWorkspace& found,
                                  const std::optional<Configuration>& home = {});

/// What is proved of positions: 1 where the pose is allowed, -1 where it is not, 0 where nothing is known. It does not
/// say whether the pose is connected with home. Roundings count against both proofs. The inner and the open boxes do
/// not overlap, but for their faces.
/// Throws Stopped.
std::vector<std::int8_t> proved_states(const CertifiedWorkspace& found, const std::vector<Vec3>& points,
                                       const std::stop_token& stop = {});

}  // namespace ninedof
