/// Compiled once for each instruction set, like the kernels.

#include "batch/floor/throughput.hpp"

#include <algorithm>
#include <chrono>
#ifdef __SSE2__
#include <immintrin.h>
#endif

#include "batch/kernels/pack.hpp"

namespace bench::NINEDOF_LEVEL {
namespace {

using ninedof::kernels::per_register;
using ninedof::kernels::Register;

/// Independent chains of each of two kinds: enough to hide the latency of two units, few enough for the registers.
constexpr int chains = per_register == 8 ? 10 : 6;
constexpr int steps = 4000;

#if defined(__x86_64__)
#define BENCH_KEEP(x) asm volatile("" : "+x"(x))
#if defined(__AVX512F__)
#undef BENCH_KEEP
#define BENCH_KEEP(x) asm volatile("" : "+v"(x))
#endif
#else
#define BENCH_KEEP(x) asm volatile("" : "+w"(x))
#endif

/// The best of many short runs, to exclude the load of other programs.
template <class Step>
double best(const Step& step) {
  Register x[chains], y[chains];
  for (int i = 0; i < chains; ++i) {
    x[i] = Register{} + (1.0 + 0.01 * i);
    y[i] = Register{} + (2.0 + 0.01 * i);
  }
  double least = 1e9;
  for (int run = 0; run < 3000; ++run) {
    const auto begin = std::chrono::steady_clock::now();
    for (int k = 0; k < steps; ++k) {
#pragma GCC unroll 16
      for (int i = 0; i < chains; ++i) step(x[i], y[i]);
    }
    const std::chrono::duration<double, std::nano> taken = std::chrono::steady_clock::now() - begin;
    for (int i = 0; i < chains; ++i) {
      BENCH_KEEP(x[i]);
      BENCH_KEEP(y[i]);
    }
    least = std::min(least, taken.count());
  }
  return least / (double(steps) * chains * per_register);
}

#if defined(__AVX512F__)
Register root_of(const Register& x) {
  return (Register)_mm512_maskz_sqrt_pd(0xff, (__m512d)x);
}
Register fused_of(const Register& x, const Register& a, const Register& b) {
  return (Register)_mm512_fmadd_pd((__m512d)x, (__m512d)a, (__m512d)b);
}
#elif defined(__AVX__)
Register root_of(const Register& x) {
  return (Register)_mm256_sqrt_pd((__m256d)x);
}
Register fused_of(const Register& x, const Register& a, const Register& b) {
  return (Register)_mm256_fmadd_pd((__m256d)x, (__m256d)a, (__m256d)b);
}
#elif defined(__SSE2__)
Register root_of(const Register& x) {
  return (Register)_mm_sqrt_pd((__m128d)x);
}
#else
Register root_of(const Register& x) {
  Register root;
  for (int k = 0; k < per_register; ++k) root[k] = __builtin_sqrt(x[k]);
  return root;
}
#endif

/// The same operation on both numbers of a step: twice as many chains.
template <class Step>
double best_alone(const Step& step) {
  return 0.5 * best([&](Register& x, Register& y) {
           step(x);
           step(y);
         });
}

}  // namespace

Throughput throughput() {
  Register one = Register{} + 1.0, zero = Register{};
  BENCH_KEEP(one);  // hides the values from the compiler
  BENCH_KEEP(zero);
  Throughput t{};
  t.multiply = best_alone([&](Register& x) { x *= one; });
  t.add = best_alone([&](Register& x) { x += zero; });
  t.both = best([&](Register& x, Register& y) {
    x *= one;
    y += zero;
  });
#if defined(__FMA__)
  t.fused = best_alone([&](Register& x) { x = fused_of(x, one, zero); });
#endif
  t.divide = best_alone([&](Register& x) { x /= one; });
  t.root = best_alone([&](Register& x) { x = root_of(x); });
  return t;
}

}  // namespace bench::NINEDOF_LEVEL
