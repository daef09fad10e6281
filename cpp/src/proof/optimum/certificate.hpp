#pragma once
/// The file of a proof: what is stated, and the tree. docs/certificate.md describes it.

#include <string>
#include <vector>

#include "ninedof/proof/optimum.hpp"

namespace ninedof::proof {

/// A number in the one spelling of certificates.
std::string hexadecimal(double x);
/// A file of a kind: its first line, a checksum, and the rest.
std::string sealed(const std::string& kind, const std::string& body);

/// The bytes of the file. Numbers are hexadecimal: what is checked is what was proved, to the last bit.
std::string certificate(const Problem& study, double target, const std::vector<std::string>& left_out,
                        const std::vector<std::uint8_t>& tree);

}  // namespace ninedof::proof
