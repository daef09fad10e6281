#include "workspace/drawing/raster.hpp"

#include <algorithm>

namespace ninedof {
namespace {

/// Weights of a value and of those before and after it.
struct Stencil {
  double before, here, after;
};

/// Replaces each value by one of each stencil, along an axis.
template <std::size_t many>
std::vector<double> along(const Raster& from, std::size_t axis, const std::array<Stencil, many>& stencils) {
  const std::size_t length = from.count[axis], stride = strides(from.count)[axis];
  std::vector<double> out;
  out.reserve(many * from.values.size());
  for (std::size_t begin = 0; begin < from.values.size(); begin += length * stride)
    for (std::size_t n = 0; n < length; ++n)
      for (const Stencil& w : stencils) {
        const double* here = &from.values[begin + n * stride];
        const double* before = n == 0 ? here : here - stride;
        const double* after = n + 1 == length ? here : here + stride;
        for (std::size_t k = 0; k < stride; ++k)
          out.push_back(w.before * before[k] + w.here * here[k] + w.after * after[k]);
      }
  return out;
}

template <std::size_t many>
Raster along_each_axis(Raster raster, const std::array<Stencil, many>& stencils) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    raster.values = along(raster, axis, stencils);
    raster.count[axis] *= many;
  }
  return raster;
}

}  // namespace

Raster padded(const Raster& raster, std::optional<double> outside) {
  Raster out = raster;
  for (std::size_t& count : out.count) count += 2;
  out.first -= raster.step;
  out.values.assign(out.count[0] * out.count[1] * out.count[2], outside.value_or(0.0));
  const auto stride = strides(raster.count);
  const auto inner = [&](std::size_t at, std::size_t axis) {
    return std::clamp<std::size_t>(at, 1, raster.count[axis]) - 1;
  };
  const auto is_edge = [&](std::size_t at, std::size_t axis) { return at == 0 || at > raster.count[axis]; };
  for_each_point(out.count, out.count, [&](std::size_t i, std::size_t j, std::size_t k, std::size_t n) {
    if (outside && (is_edge(i, 0) || is_edge(j, 1) || is_edge(k, 2))) return;
    out.values[n] = raster.values[inner(i, 0) * stride[0] + inner(j, 1) * stride[1] + inner(k, 2)];
  });
  return out;
}

Raster refined(const Raster& raster) {
  Raster out = along_each_axis(raster, std::array<Stencil, 2>{{{0.25, 0.75, 0.0}, {0.0, 0.75, 0.25}}});
  out.first -= 0.25 * raster.step;
  out.step *= 0.5;
  return out;
}

Raster averaged(const Raster& raster) {
  return along_each_axis(raster, std::array<Stencil, 1>{{{0.25, 0.5, 0.25}}});
}

}  // namespace ninedof
