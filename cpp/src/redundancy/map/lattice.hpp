#pragma once
/// A grid of any number of axes, and coarser lattices of its points.

#include <cstddef>
#include <vector>

namespace ninedof {

class Lattice {
 public:
  /// About one point in `every` of a grid of this shape, the last axis fastest; two or more along each axis of as many.
  Lattice(std::vector<std::size_t> shape, std::size_t every);

  /// Whether point k of the grid is on the lattice.
  bool has(std::size_t k) const;

  /// Halves the distances; false if the lattice was the whole grid.
  bool refine();

  /// Calls visit(j, beyond) for each neighbour j of point k; `beyond` is the next point on the same line, or `none`.
  template <class Visit>
  void neighbours(std::size_t k, Visit visit) const {
    std::size_t stride = 1;
    for (std::size_t axis = shape_.size(); axis-- > 0;) {
      const std::size_t n = shape_[axis], place = k / stride % n;
      if (place > 0) visit(k - stride, place > 1 ? k - 2 * stride : none);
      if (place + 1 < n) visit(k + stride, place + 2 < n ? k + 2 * stride : none);
      stride *= n;
    }
  }

  static constexpr std::size_t none = static_cast<std::size_t>(-1);

 private:
  std::vector<std::size_t> shape_, step_;
};

}  // namespace ninedof
