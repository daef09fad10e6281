#pragma once
/// How the boxes of a proof were cut, and why each that was not cut holds no design below the target.

#include <cstdint>
#include <vector>

#include "proof/optimum/box_bound.hpp"

namespace ninedof::proof {

class ProofTree {
 public:
  ProofTree() : nodes_(1) {}

  /// Cuts a node along a coordinate. Returns the lower half; the upper half is the next node.
  std::uint32_t cut(std::uint32_t node, std::size_t coordinate);
  void close(std::uint32_t node, const BoxBound& found);

  /// Depth first, the lower half before the upper. One byte for each node, which docs/certificate.md describes, and
  /// after it the two or four floats of a combination, little-endian.
  std::vector<std::uint8_t> bytes() const;

 private:
  struct Node {
    std::uint32_t next = 0;  ///< the lower half, or the place of the combination of a leaf
    std::uint8_t code = 0;
  };
  std::vector<Node> nodes_;
  std::vector<Combination> combinations_;
};

}  // namespace ninedof::proof
