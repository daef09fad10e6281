#include "redundancy/map/lattice.hpp"

#include <algorithm>
#include <cmath>

namespace ninedof {

Lattice::Lattice(std::vector<std::size_t> shape, std::size_t every) : shape_(std::move(shape)) {
  const auto axes = std::ranges::count_if(shape_, [](std::size_t n) { return n > 1; });
  const double root =
      std::pow(static_cast<double>(every), 1.0 / static_cast<double>(std::max<std::ptrdiff_t>(1, axes)));
  const auto step = static_cast<std::size_t>(std::max(1.0, std::round(root)));
  for (const std::size_t n : shape_) step_.push_back(std::clamp<std::size_t>((n + 2) / 3, 1, step));
}

bool Lattice::has(std::size_t k) const {
  for (std::size_t axis = shape_.size(); axis-- > 0;) {
    const std::size_t place = k % shape_[axis];
    if (place % step_[axis] != step_[axis] / 2 && shape_[axis] > 1) return false;
    k /= shape_[axis];
  }
  return true;
}

bool Lattice::refine() {
  bool finer = false;
  for (std::size_t& step : step_) {
    finer |= step > 1;
    step = (step + 1) / 2;
  }
  return finer;
}

}  // namespace ninedof
