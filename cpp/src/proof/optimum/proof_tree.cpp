#include "proof/optimum/proof_tree.hpp"

#include <bit>

namespace ninedof::proof {
namespace {

// Below these, a byte is the coordinate of a cut.
constexpr std::uint8_t outside = 16, by_ranges = 17, by_combination = 18, by_legs = 19;

void append(std::vector<std::uint8_t>& out, float x) {
  const auto bits = std::bit_cast<std::uint32_t>(x);
  for (int shift : {0, 8, 16, 24}) out.push_back(static_cast<std::uint8_t>(bits >> shift));
}

std::uint8_t code_of(const BoxBound& found) {
  switch (found.reason) {
    case Reason::domain: return outside;
    case Reason::combination:
      return found.combination.external != 0.0F || found.combination.upper != 0.0F ? by_legs : by_combination;
    case Reason::ranges: break;
  }
  return by_ranges;
}

}  // namespace

std::uint32_t ProofTree::cut(std::uint32_t node, std::size_t coordinate) {
  const auto first = static_cast<std::uint32_t>(nodes_.size());
  nodes_[node] = {first, static_cast<std::uint8_t>(coordinate)};
  nodes_.resize(nodes_.size() + 2);
  return first;
}

void ProofTree::close(std::uint32_t node, const BoxBound& found) {
  nodes_[node] = {static_cast<std::uint32_t>(combinations_.size()), code_of(found)};
  if (nodes_[node].code >= by_combination) combinations_.push_back(found.combination);
}

std::vector<std::uint8_t> ProofTree::bytes() const {
  std::vector<std::uint8_t> out;
  std::vector<std::uint32_t> ahead{0};
  while (!ahead.empty()) {
    const Node& node = nodes_[ahead.back()];
    ahead.pop_back();
    out.push_back(node.code);
    if (node.code < outside) {
      ahead.push_back(node.next + 1);
      ahead.push_back(node.next);
    } else if (node.code >= by_combination) {
      const Combination& by = combinations_[node.next];
      append(out, by.max);
      append(out, by.min);
      if (node.code == by_legs) {
        append(out, by.external);
        append(out, by.upper);
      }
    }
  }
  return out;
}

}  // namespace ninedof::proof
