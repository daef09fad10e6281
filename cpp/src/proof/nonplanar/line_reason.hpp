#pragma once
/// Why a box of non-planar designs became smaller or was closed, as bytes of a certificate: docs/certificate.md.

#include <array>
#include <utility>

#include "proof/optimum/proof_tree.hpp"

namespace ninedof::proof {

/// Beside these a byte is the coordinate of a cut.
namespace reasons {
inline constexpr std::uint8_t by_limits = 16, cut_by_limits = 17, closed_by_mixture = 18, cut_by_mixture = 19;
}  // namespace reasons

/// The sum of weight v v* over vectors v = (a, b + i c): [[m11, re - i im], [re + i im, m22]].
struct HermitianSum {
  double m11 = 0.0, re = 0.0, im = 0.0, m22 = 0.0;
};

/// Sums of the axial and the transverse block, first of the greatest, then of the least; numbers of limits with
/// weights.
void append_mixture(Bytes& out, const std::array<HermitianSum, 4>& sums,
                    const std::vector<std::pair<std::size_t, double>>& limits);

}  // namespace ninedof::proof
