#pragma once
/// A pack that counts its operations. The kernels are templates over their pack: with this one the operations of the
/// actual source are counted while it runs.

#include <array>
#include <cmath>

#include "batch/kernels/pack.hpp"

namespace bench {

/// Numbers of operations on packs.
struct Operations {
  double multiplies = 0, additions = 0, divisions = 0, roots = 0;
  double others = 0;  ///< comparisons, selections, signs
};
inline Operations done;

template <int N>
struct CountedMask {
  std::array<bool, N> lane{};

  friend CountedMask operator&(const CountedMask& a, const CountedMask& b) {
    return each([&](std::size_t k) { return a.lane[k] && b.lane[k]; });
  }
  friend CountedMask operator|(const CountedMask& a, const CountedMask& b) {
    return each([&](std::size_t k) { return a.lane[k] || b.lane[k]; });
  }
  friend CountedMask operator!(const CountedMask& a) {
    return each([&](std::size_t k) { return !a.lane[k]; });
  }
  friend bool any(const CountedMask& a) {
    for (const bool x : a.lane)
      if (x) return true;
    return false;
  }
  template <class Make>
  static CountedMask each(const Make& make) {
    ++done.others;
    CountedMask out;
    for (std::size_t k = 0; k < N; ++k) out.lane[k] = make(k);
    return out;
  }
};

template <int N>
struct Counted {
  using Mask = CountedMask<N>;
  static constexpr int lanes = N;
  std::array<double, N> lane{};

  Counted() = default;
  Counted(double x) { lane.fill(x); }  // NOLINT(google-explicit-constructor)

  template <class Make>
  static Counted each(double& counter, const Make& make) {
    ++counter;
    Counted out;
    for (std::size_t k = 0; k < N; ++k) out.lane[k] = make(k);
    return out;
  }
  using C = const Counted&;
  friend Counted operator+(C a, C b) {
    return each(done.additions, [&](auto k) { return a.lane[k] + b.lane[k]; });
  }
  friend Counted operator-(C a, C b) {
    return each(done.additions, [&](auto k) { return a.lane[k] - b.lane[k]; });
  }
  friend Counted operator*(C a, C b) {
    return each(done.multiplies, [&](auto k) { return a.lane[k] * b.lane[k]; });
  }
  friend Counted operator/(C a, C b) {
    return each(done.divisions, [&](auto k) { return a.lane[k] / b.lane[k]; });
  }
  friend Counted operator-(C a) {
    return each(done.others, [&](auto k) { return -a.lane[k]; });
  }
  Counted& operator+=(C b) { return *this = *this + b; }
  Counted& operator-=(C b) { return *this = *this - b; }
  Counted& operator*=(C b) { return *this = *this * b; }
  friend Mask operator<(C a, C b) {
    return Mask::each([&](auto k) { return a.lane[k] < b.lane[k]; });
  }
  friend Mask operator>(C a, C b) {
    return Mask::each([&](auto k) { return a.lane[k] > b.lane[k]; });
  }
  friend Mask operator<=(C a, C b) {
    return Mask::each([&](auto k) { return a.lane[k] <= b.lane[k]; });
  }
  friend Mask operator>=(C a, C b) {
    return Mask::each([&](auto k) { return a.lane[k] >= b.lane[k]; });
  }
  friend Counted select(const Mask& m, C a, C b) {
    return each(done.others, [&](auto k) { return m.lane[k] ? a.lane[k] : b.lane[k]; });
  }
  friend Counted sqrt(C a) {
    return each(done.roots, [&](auto k) { return std::sqrt(a.lane[k]); });
  }
  friend Counted abs(C a) {
    return each(done.others, [&](auto k) { return std::abs(a.lane[k]); });
  }
  friend Counted copysign(C a, C b) {
    return each(done.others, [&](auto k) { return std::copysign(a.lane[k], b.lane[k]); });
  }
  friend Counted min(C a, C b) { return select(a < b, a, b); }
  friend Counted max(C a, C b) { return select(a < b, b, a); }
  friend Counted square(C a) { return a * a; }
};

}  // namespace bench
