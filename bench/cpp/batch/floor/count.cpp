#define NINEDOF_LEVEL count  // a separate namespace for the counted kernels
#include "batch/floor/counting.hpp"
#include "batch/floor/floor.hpp"
#include "batch/kernels/conditioning_matrix.hpp"
#include "batch/kernels/quick_roots.hpp"
#include "ninedof/conditioning/conditioning.hpp"

namespace bench {
namespace {

namespace kernels = ninedof::kernels;

template <int N>
Count count_with(const File& file, long most) {
  using P = Counted<N>;
  kernels::Joints joints;
  static_assert(sizeof joints == 36 * sizeof(double));
  std::copy_n(file.numbers.data(), 36, &joints.base_external[0][0]);
  const auto g = file.geometry();
  const long packs = std::min(most, static_cast<long>(file.count())) / N;
  Count out{N, packs * N, 0, 0, 0, 0, 0, 0};
  done = {};
  for (long first = 0; first < packs * N; first += N) {
    const auto column = [&](std::size_t j) {
      P x;
      for (std::size_t k = 0; k < N; ++k) x.lane[k] = file.pose(static_cast<std::size_t>(first) + k)[j];
      return x;
    };
    kernels::Poses<P> c;
    c.p = {column(0), column(1), column(2)};
    for (std::size_t j = 0; j < 9; ++j) c.q[j] = column(3 + j);
    c.s = {column(12), column(13), column(14)};
    const P length = file.characteristic_length();
    // condition_numbers of kernels.cpp without its checks.
    P m[6][6];
    kernels::conditioning_matrix(joints, c, 1.0 / length, m);
    const auto [least, greatest] = kernels::extreme_roots(kernels::bidiagonalize(m));
    const P ratio = sqrt(greatest.x / least.x);
    for (std::size_t k = 0; k < N; ++k) {
      const double kappa = ninedof::condition_number(g, file.configuration(static_cast<std::size_t>(first) + k),
                                                     file.characteristic_length());
      if (kappa > 1e8) continue;  // recomputed by the accurate path
      const double error = std::abs(ratio.lane[k] / kappa - 1.0) / std::max(1.0, kappa / 1e3);
      if (!(error <= 1e-11)) throw std::runtime_error("the counted kernel is wrong: nothing it says is worth anything");
      out.worst = std::max(out.worst, error);
    }
  }
  const auto each = static_cast<double>(packs);
  out.multiplies = done.multiplies / each;
  out.additions = done.additions / each;
  out.divisions = done.divisions / each;
  out.roots = done.roots / each;
  out.others = done.others / each;
  return out;
}

}  // namespace

Count count_operations(const File& file, int lanes, long most) {
  switch (lanes) {
    case 1: return count_with<1>(file, most);
    case 4: return count_with<4>(file, most);
    case 8: return count_with<8>(file, most);
    case 16: return count_with<16>(file, most);
    default: throw std::runtime_error("no count for that many lanes");
  }
}

}  // namespace bench
