#pragma once
/// How the boxes of a proof were cut, and why each that was not cut holds no design below the target.

#include <cstddef>
#include <cstdint>
#include <vector>

namespace ninedof::proof {

using Bytes = std::vector<std::uint8_t>;

/// The lowest byte first.
void append(Bytes& out, float x);
void append(Bytes& out, double x);

class ProofTree {
 public:
  explicit ProofTree(std::size_t roots = 1) : nodes_(roots), roots_(roots) {}

  /// What is said of a box, at most 65535 bytes: that it is closed, or how it is cut. Then its lower half comes back;
  /// the upper half is the next node.
  void close(std::uint32_t node, const Bytes& reason);
  std::uint32_t cut(std::uint32_t node, const Bytes& cut);

  /// Root after root, depth first, the lower half before the upper. docs/certificate.md describes the bytes of nodes.
  Bytes bytes() const;
  std::size_t size() const { return said_.size() + nodes_.size() * sizeof(Node); }

 private:
  struct Node {
    std::uint32_t at = 0;     ///< where what is said of it begins, after its length
    std::uint32_t lower = 0;  ///< the lower half, 0 of closed boxes
  };
  std::vector<Node> nodes_;
  std::size_t roots_;
  Bytes said_;
};

}  // namespace ninedof::proof
