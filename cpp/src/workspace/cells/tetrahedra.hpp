#pragma once
/// The allowed part of a cell, with a boundary that is plane in each of six tetrahedra.

#include <array>
#include <vector>

#include "workspace/criteria/limits_at_points.hpp"

namespace ninedof {

/// Corners of a cell by number (bit 0 for x, 1 for y, 2 for z).
using Corners = std::array<const PointMargins*, 8>;

/// The intersection of the boundary with an edge: the distance from its allowed end (0 to 1), and the limit met first.
struct Crossing {
  double t = 0.0;
  int limit = -1;
};

/// A cell divided into six tetrahedra about the diagonal from corner 0 to corner 7 (Kuhn).
class CutCell {
 public:
  CutCell(const Corners& corners, int groups);

  /// Bit n: corner n is allowed.
  unsigned inside() const { return inside_; }
  /// Share of the cell that is allowed: exact for margins that are linear in it.
  double fraction();

  struct Piece {
    double area;
    int limit;
  };
  /// Appends the boundary: the area of each polygon, divided equally among its corners, each with its limit.
  void boundary(const Vec3& size, std::vector<Piece>& out);
  /// Appends the crossings of the three edges at corner 0, in sides of the cell; neighbours have the other edges.
  void crossings(std::vector<Vec3>& out);

 private:
  const Crossing& crossing(int allowed, int forbidden);
  Vec3 crossing_point(int allowed, int forbidden);
  bool allowed(int corner) const { return ((inside_ >> corner) & 1U) != 0; }

  Corners corners_;
  int groups_;
  unsigned inside_ = 0;
  std::array<Crossing, 64> edge_;
};

}  // namespace ninedof
