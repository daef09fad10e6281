#pragma once
/// Packs: several doubles in one or more vector registers, computed lane by lane.
///
/// No operation mixes lanes, and each is rounded according to IEEE 754, so that the bits of a result depend neither on
/// the number of lanes nor on the instruction set.
///
/// Kernel sources include only the headers of this folder, templates over the number type (xyz.hpp, hexagon.hpp) and
/// constants (short_leg.hpp), and call no function of another file: code compiled here for AVX-512 must never be linked
/// into code for other processors.

#ifndef NINEDOF_LEVEL
#error "compile kernel sources with -DNINEDOF_LEVEL=<name>"
#endif

namespace ninedof::kernels::inline NINEDOF_LEVEL {

#if defined(__AVX512F__)
constexpr int register_bytes = 64;
#elif defined(__AVX__)
constexpr int register_bytes = 32;
#else
constexpr int register_bytes = 16;
#endif

using Register = double __attribute__((vector_size(register_bytes)));
using RegisterMask = decltype(Register{} < Register{});
constexpr int per_register = register_bytes / static_cast<int>(sizeof(double));

#define NINEDOF_INLINE [[gnu::always_inline]] inline

/// Vectors from and to memory that is aligned for one number only. One instruction each; clang forgets in templates
/// what alignment a vector type was declared with.
template <class V>
NINEDOF_INLINE V vector_at(const double* from) {
  V v;
  __builtin_memcpy(&v, from, sizeof v);
  return v;
}
template <class V>
NINEDOF_INLINE void put_vector(V v, double* to) {
  __builtin_memcpy(to, &v, sizeof v);
}

/// One truth value per lane.
template <int N>
struct MaskOf {
  static constexpr int registers = N / per_register;
  RegisterMask part[registers];

  NINEDOF_INLINE friend MaskOf operator&(const MaskOf& a, const MaskOf& b) {
    return each([&](int i) { return a.part[i] & b.part[i]; });
  }
  NINEDOF_INLINE friend MaskOf operator|(const MaskOf& a, const MaskOf& b) {
    return each([&](int i) { return a.part[i] | b.part[i]; });
  }
  NINEDOF_INLINE friend MaskOf operator!(const MaskOf& a) {
    return each([&](int i) { return ~a.part[i]; });
  }
  NINEDOF_INLINE friend bool any(const MaskOf& a) {
    RegisterMask all = a.part[0];
    for (int i = 1; i < registers; ++i) all |= a.part[i];
    long long bits = 0;
    for (int k = 0; k < per_register; ++k) bits |= all[k];
    return bits != 0;
  }

  template <class Make>
  NINEDOF_INLINE static MaskOf each(const Make& make) {
    MaskOf out;
    for (int i = 0; i < registers; ++i) out.part[i] = make(i);
    return out;
  }
};

template <int N>
struct PackOf {
  static constexpr int lanes = N;
  static constexpr int registers = N / per_register;
  using Mask = MaskOf<N>;
  Register part[registers];

  PackOf() = default;
  // The same number in every lane.
  NINEDOF_INLINE PackOf(double x) {  // NOLINT(google-explicit-constructor)
    for (int i = 0; i < registers; ++i) part[i] = Register{} + x;
  }

  template <class Make>
  NINEDOF_INLINE static PackOf each(const Make& make) {
    PackOf out;
    for (int i = 0; i < registers; ++i) out.part[i] = make(i);
    return out;
  }

  NINEDOF_INLINE friend PackOf operator+(const PackOf& a, const PackOf& b) {
    return each([&](int i) { return a.part[i] + b.part[i]; });
  }
  NINEDOF_INLINE friend PackOf operator-(const PackOf& a, const PackOf& b) {
    return each([&](int i) { return a.part[i] - b.part[i]; });
  }
  NINEDOF_INLINE friend PackOf operator*(const PackOf& a, const PackOf& b) {
    return each([&](int i) { return a.part[i] * b.part[i]; });
  }
  NINEDOF_INLINE friend PackOf operator/(const PackOf& a, const PackOf& b) {
    return each([&](int i) { return a.part[i] / b.part[i]; });
  }
  NINEDOF_INLINE friend PackOf operator-(const PackOf& a) {
    return each([&](int i) { return -a.part[i]; });
  }
  NINEDOF_INLINE PackOf& operator+=(const PackOf& b) { return *this = *this + b; }
  NINEDOF_INLINE PackOf& operator-=(const PackOf& b) { return *this = *this - b; }
  NINEDOF_INLINE PackOf& operator*=(const PackOf& b) { return *this = *this * b; }
  NINEDOF_INLINE friend Mask operator<(const PackOf& a, const PackOf& b) {
    return Mask::each([&](int i) { return a.part[i] < b.part[i]; });
  }
  NINEDOF_INLINE friend Mask operator>(const PackOf& a, const PackOf& b) {
    return Mask::each([&](int i) { return a.part[i] > b.part[i]; });
  }
  NINEDOF_INLINE friend Mask operator<=(const PackOf& a, const PackOf& b) {
    return Mask::each([&](int i) { return a.part[i] <= b.part[i]; });
  }
  NINEDOF_INLINE friend Mask operator>=(const PackOf& a, const PackOf& b) {
    return Mask::each([&](int i) { return a.part[i] >= b.part[i]; });
  }

  /// a where the mask is set, else b.
  NINEDOF_INLINE friend PackOf select(const Mask& m, const PackOf& a, const PackOf& b) {
    return each([&](int i) { return m.part[i] ? a.part[i] : b.part[i]; });
  }
  NINEDOF_INLINE friend PackOf sqrt(const PackOf& a) {
    return each([&](int i) {
      Register root;
      for (int k = 0; k < per_register; ++k) root[k] = __builtin_sqrt(a.part[i][k]);
      return root;
    });
  }
  NINEDOF_INLINE friend PackOf abs(const PackOf& a) {
    return each([&](int i) { return (Register)((RegisterMask)a.part[i] & ~sign()); });
  }
  /// |a| with the sign of b.
  NINEDOF_INLINE friend PackOf copysign(const PackOf& a, const PackOf& b) {
    return each(
        [&](int i) { return (Register)(((RegisterMask)a.part[i] & ~sign()) | ((RegisterMask)b.part[i] & sign())); });
  }
  NINEDOF_INLINE friend PackOf min(const PackOf& a, const PackOf& b) { return select(a < b, a, b); }
  NINEDOF_INLINE friend PackOf max(const PackOf& a, const PackOf& b) { return select(a < b, b, a); }
  NINEDOF_INLINE friend PackOf square(const PackOf& a) { return a * a; }

  NINEDOF_INLINE static PackOf load(const double* from) {
    return each([&](int i) { return vector_at<Register>(from + i * per_register); });
  }
  NINEDOF_INLINE friend void store(const PackOf& a, double* to) {
    for (int i = 0; i < registers; ++i) put_vector(a.part[i], to + i * per_register);
  }

 private:
  NINEDOF_INLINE static RegisterMask sign() { return (RegisterMask)(-Register{}); }
};

}  // namespace ninedof::kernels::inline NINEDOF_LEVEL
