#pragma once
/// Cells of an octree on one integer lattice, and the margins at its points, each evaluated once.
///
/// If the best O is sought, it is mapped over the corners of level 0. Any later point lies half way between known ones:
/// the ends of an edge, opposite corners of a face or cell, or a corner and the centre of a larger cell.

#include <cstdint>
#include <memory>
#include <vector>

#include "workspace/cells/best_points.hpp"

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

/// From 64-bit keys to indices 0, 1, 2, ... in the order of insertion.
class KeyTable {
 public:
  KeyTable() : slots_(1024) {}
  /// The index of the key, which is added if it is new.
  std::uint32_t add(std::uint64_t key);
  /// The index of the key, or `absent`.
  std::uint32_t find(std::uint64_t key) const { return slots_[place(key)].index; }
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

/// The margins of the points, by number. Elements never move: copying millions would take seconds without interruption.
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

/// The eight corners of a cell, bit 0 of the number for x, 1 for y, 2 for z, then its centre.
using NinePoints = std::array<std::uint32_t, 9>;

class CellLattice {
 public:
  CellLattice(const LimitsAtPoints& margins, int resolution, int threads);

  static constexpr int deepest = 10;
  /// The cells of level 0, the first index running fastest.
  std::vector<Cell> roots() const;
  Vec3 centre(const Cell& c) const;
  Vec3 size(int level) const { return step_ * static_cast<double>(2 << (deepest - level)); }
  Vec3 at(std::uint64_t key) const;
  Vec3 point(std::uint32_t index) const { return at(table_.key(index)); }
  const PointMargins& margins(std::uint32_t index) const { return known_[index]; }

  /// Numbers the corners and centres of cells, to be evaluated next; first of all those of level 0. Throws Stopped.
  std::vector<NinePoints> points_of(const std::vector<Cell>& cells, const std::stop_token& stop = {});
  /// Evaluates the points numbered since the last call; `expected` and `volume` are reported. Throws Stopped.
  void evaluate(const Control& control, long expected, double volume);
  long evaluations() const { return evaluations_; }
  const MapAudit& audit() const { return best_.audit(); }

  /// The margins at one point x in each of some evaluated cells of level 0. Throws Stopped.
  std::vector<PointMargins> within(const std::vector<Cell>& cells, const std::vector<Vec3>& x,
                                   const std::stop_token& stop);

 private:
  void map_corners(const std::stop_token& stop);
  Anchor anchor(std::uint64_t key) const { return {at(key), table_.find(key)}; }
  Anchors around(std::uint64_t key) const;
  Anchors around(const Cell& cell, const Vec3& x) const;

  const LimitsAtPoints& margins_;
  BestPoints best_;
  Vec3 low_, step_;  // of the finest lattice, which contains the centres of the deepest cells
  int resolution_, threads_;
  KeyTable table_;
  PointStore known_;
  long evaluations_ = 0;  // finished
};

}  // namespace ninedof
