#include "proof/optimum/proof_tree.hpp"

#include <bit>

namespace ninedof::proof {

void append(Bytes& out, float x) {
  const auto bits = std::bit_cast<std::uint32_t>(x);
  for (int shift = 0; shift < 32; shift += 8) out.push_back(static_cast<std::uint8_t>(bits >> shift));
}
void append(Bytes& out, double x) {
  const auto bits = std::bit_cast<std::uint64_t>(x);
  for (int shift = 0; shift < 64; shift += 8) out.push_back(static_cast<std::uint8_t>(bits >> shift));
}

void ProofTree::close(std::uint32_t node, const Bytes& reason) {
  nodes_[node].at = static_cast<std::uint32_t>(said_.size());
  for (int shift : {0, 8}) said_.push_back(static_cast<std::uint8_t>(reason.size() >> shift));
  said_.insert(said_.end(), reason.begin(), reason.end());
}

std::uint32_t ProofTree::cut(std::uint32_t node, const Bytes& cut) {
  close(node, cut);
  const auto lower = static_cast<std::uint32_t>(nodes_.size());
  nodes_[node].lower = lower;
  nodes_.resize(nodes_.size() + 2);
  return lower;
}

Bytes ProofTree::bytes() const {
  Bytes out;
  for (std::uint32_t root = 0; root < roots_; ++root) {
    std::vector<std::uint32_t> ahead{root};
    while (!ahead.empty()) {
      const Node& node = nodes_[ahead.back()];
      ahead.pop_back();
      const auto at = said_.begin() + node.at;
      out.insert(out.end(), at + 2, at + 2 + at[0] + (at[1] << 8));
      if (node.lower == 0) continue;
      ahead.push_back(node.lower + 1);
      ahead.push_back(node.lower);
    }
  }
  return out;
}

}  // namespace ninedof::proof
