#pragma once
/// The margins of the points of a lattice, by number. It grows without moving its elements: a copy of millions of
/// points would take seconds that cannot be interrupted.

#include <memory>
#include <vector>

#include "workspace/criteria/pose_margins.hpp"

namespace ninedof {

class PointStore {
 public:
  const PointMargins& operator[](std::size_t number) const { return blocks_[number / block][number % block]; }
  PointMargins& operator[](std::size_t number) { return blocks_[number / block][number % block]; }

  /// Makes room for numbers below `size`.
  void grow(std::size_t size) {
    while (blocks_.size() * block < size) blocks_.push_back(std::make_unique<PointMargins[]>(block));
  }

 private:
  static constexpr std::size_t block = 4096;
  std::vector<std::unique_ptr<PointMargins[]>> blocks_;
};

}  // namespace ninedof
