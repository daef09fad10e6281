#pragma once
/// Cells of an octree on one integer lattice, and the margins at its points, each evaluated once.

#include <cstdint>
#include <vector>

#include "workspace/pose_margins.hpp"

namespace ninedof {

/// A cube of the lattice: its indices among the cells of its level.
struct Cell {
  std::uint32_t i = 0, j = 0, k = 0;
  std::uint8_t level = 0;

  Cell child(int octant) const {
    const auto bit = [&](int b) { return static_cast<std::uint32_t>((octant >> b) & 1); };
    return {2 * i + bit(0), 2 * j + bit(1), 2 * k + bit(2), static_cast<std::uint8_t>(level + 1)};
  }
};

/// From 64-bit keys to indices 0, 1, 2, ... in the order of their arrival.
class KeyTable {
 public:
  KeyTable() : slots_(1024) {}
  /// The index of the key, which is added if it is new.
  std::uint32_t add(std::uint64_t key);
  /// The index of the key, or `absent`.
  std::uint32_t find(std::uint64_t key) const;
  static constexpr std::uint32_t absent = 0xFFFFFFFFU;
  std::size_t size() const { return keys_.size(); }
  std::uint64_t key(std::uint32_t index) const { return keys_[index]; }

 private:
  struct Slot {
    std::uint64_t key = 0;
    std::uint32_t index = absent;
  };
  std::size_t place(std::uint64_t key) const;
  void grow();
  std::vector<Slot> slots_;
  std::vector<std::uint64_t> keys_;
};

/// The eight corners of a cell, bit 0 of the number for x, 1 for y, 2 for z, then its centre.
using NinePoints = std::array<std::uint32_t, 9>;

class CellLattice {
 public:
  CellLattice(const Margins& margins, int resolution, int threads);

  static constexpr int deepest = 10;
  Vec3 centre(const Cell& c) const;
  Vec3 size(int level) const;
  Vec3 at(std::uint64_t key) const;
  Vec3 point(std::uint32_t index) const { return at(table_.key(index)); }
  const PointMargins& margins(std::uint32_t index) const { return known_[index]; }

  /// The corners and centres of cells, numbered; evaluate() must follow.
  std::vector<NinePoints> points_of(const std::vector<Cell>& cells);
  void evaluate(const WorkspaceControl& control, long expected, double volume);
  long evaluations() const { return static_cast<long>(known_.size()); }

 private:
  const Margins& margins_;
  Vec3 low_, step_;  // of the finest lattice, which has the centres of the deepest cells
  int resolution_, threads_;
  KeyTable table_;
  std::vector<PointMargins> known_;
};

}  // namespace ninedof
