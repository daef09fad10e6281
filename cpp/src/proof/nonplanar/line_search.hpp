#pragma once
/// The proof of an optimum of the family "symmetric_nonplanar" at the neutral pose.

#include "ninedof/proof/optimum.hpp"

namespace ninedof::proof {

/// As `prove_optimum`, by one target after another up to that of the settings. The certificate is that of the last one
/// that was proved, and empty where its tree would have more than a gigabyte.
OptimumProof prove_nonplanar(const Problem& study, const OptimumSettings& settings, const Control& control);

}  // namespace ninedof::proof
