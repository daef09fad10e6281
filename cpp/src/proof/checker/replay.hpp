#pragma once
/// Whether a certificate of a set of admissible designs is a proof.

#include "ninedof/proof/checker.hpp"
#include "proof/checker/wants.hpp"

namespace ninedof::checker::sets {

/// Throws where the file is refused.
void replay(const DesignsFile& file, const Reading& reading, Verdict& out);

}  // namespace ninedof::checker::sets
