#pragma once
/// Whether a certificate of a workspace is a proof.

#include "ninedof/proof/checker.hpp"
#include "proof/checker/wants.hpp"

namespace ninedof::checker::sets {

/// Between which numbers the part of the box -1 to 1 is where c + a . t < 0, for every c within its error.
Range share_below_zero(const Linear& x);

/// Reads the tree. Throws where the file is refused.
void replay_workspace(const DesignsFile& file, Stream& stream, const Reading& reading, Verdict& out);

}  // namespace ninedof::checker::sets
