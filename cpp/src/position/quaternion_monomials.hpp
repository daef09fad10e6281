#pragma once
/// Numbered monomials in the four components of a quaternion, and the numbers of their products. All at compile time.

#include <array>
#include <cstddef>

namespace ninedof::monomials {

/// Exponents of (w, x, y, z).
using Exponents = std::array<int, 4>;

/// Number of monomials of a degree: (degree + 3) choose 3.
constexpr std::size_t count(int degree) {
  return static_cast<std::size_t>((degree + 1) * (degree + 2) * (degree + 3) / 6);
}

/// All monomials of a degree; for degree 1 in the order w, x, y, z.
template <int Degree>
constexpr auto all() {
  std::array<Exponents, count(Degree)> out{};
  std::size_t n = 0;
  for (int w = Degree; w >= 0; --w)
    for (int x = Degree - w; x >= 0; --x)
      for (int y = Degree - w - x; y >= 0; --y) out[n++] = {w, x, y, Degree - w - x - y};
  return out;
}

template <int Degree>
constexpr int index_of(const Exponents& e) {
  constexpr auto list = all<Degree>();
  int n = 0;
  while (list[static_cast<std::size_t>(n)] != e) ++n;
  return n;
}

/// Entry [a][b]: the number of the product, of degree A + B, of monomial a of degree A and monomial b of degree B.
template <int A, int B>
constexpr auto products() {
  std::array<std::array<int, count(B)>, count(A)> out{};
  constexpr auto left = all<A>();
  constexpr auto right = all<B>();
  for (std::size_t a = 0; a < left.size(); ++a)
    for (std::size_t b = 0; b < right.size(); ++b) {
      Exponents sum{};
      for (std::size_t k = 0; k < 4; ++k) sum[k] = left[a][k] + right[b][k];
      out[a][b] = index_of<A + B>(sum);
    }
  return out;
}

}  // namespace ninedof::monomials
