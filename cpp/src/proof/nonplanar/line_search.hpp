#pragma once
/// The proof of an optimum of the family "symmetric_nonplanar" at the neutral pose.

#include "ninedof/proof/optimum.hpp"

namespace ninedof::proof {

/// As `prove_optimum`, by one target after another up to that of the settings. Without a certificate.
OptimumProof prove_nonplanar(const Problem& study, const OptimumSettings& settings, const Control& control);

}  // namespace ninedof::proof
