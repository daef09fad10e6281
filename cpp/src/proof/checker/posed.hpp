#pragma once
/// The machines of a box of designs, and their points over a box of poses.

#include "proof/checker/designs_file.hpp"

namespace ninedof::checker::sets {

using Cube = std::array<Range, most_varied_symbols>;

/// p, O and the columns of Q.
struct Stand {
  Arrow p, s;
  std::array<Arrow, 3> q;
};

/// Joints in the order base external, base internal, platform external, platform internal, three each.
struct Mount {
  std::array<Arrow, 12> plate, joint;  ///< the platform's in its own frame, and in that of the tool
  Stand home;
  Linear zp, zs;
};
Mount mount(const DesignsFile& file, const Cube& designs);

/// The poses of a patch. Its piece has to be one of the file; of a workspace it is a rotation.
Stand stand(const DesignsFile& file, const Mount& m, const Patch& patch);

/// The ends of a leg: l1 l2 l3 from the base to the platform, q1 q2 q3 from the platform and r1 r2 r3 from the base to
/// O.
struct LegLine {
  Arrow from, to;
  Arrow along() const { return to - from; }
};
LegLine leg_line(const Mount& m, const Stand& at, int leg);
/// A vector of the platform in the base frame.
Arrow carried(const Stand& at, const Arrow& v);

/// Refuses a file with an exempt pair of legs that share no joint in every machine.
void require_shared_joints(const DesignsFile& file, const Mount& m);

/// The patches of all poses; those of the neutral pose are one of piece -1.
std::vector<Patch> all_poses(const DesignsFile& file);
/// Whether a patch lies beside a round region.
bool beside(const DesignsFile& file, const Patch& patch);
/// The nearest pose of the file in these patches, a single one. Throws where its piece is none of theirs.
Patch drawn_in(const DesignsFile& file, const std::vector<Patch>& among, Patch pose);
/// At most the number at all poses of a patch that the file has, for all designs.
double least_over(const DesignsFile& file, const Linear& x, const Patch& patch);

}  // namespace ninedof::checker::sets
