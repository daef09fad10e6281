#include "batch/kernels/dispatch.hpp"

#include <cstdlib>

#include "ninedof/math/error.hpp"

namespace ninedof::kernels {

namespace base {
extern const Table level_table;
}
#ifdef NINEDOF_HAS_v3
namespace v3 {
extern const Table level_table;
}
#endif
#ifdef NINEDOF_HAS_v4
namespace v4 {
extern const Table level_table;
}
#endif

namespace {

#if defined(NINEDOF_HAS_v3) || defined(NINEDOF_HAS_v4)
bool runs_v3() {
  return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") && __builtin_cpu_supports("bmi") &&
         __builtin_cpu_supports("bmi2");
}
#endif
#ifdef NINEDOF_HAS_v4
bool runs_v4() {
  return runs_v3() && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
         __builtin_cpu_supports("avx512cd") && __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl");
}
#endif

const Table& choose() {
  const char* forced = std::getenv("NINEDOF_SIMD");
  if (forced == nullptr || *forced == '\0') {
    for (const char* level : {"v4", "v3"})
      if (const Table* found = table_of(level)) return *found;
    return base::level_table;
  }
  if (const Table* found = table_of(forced)) return *found;
  std::string expected;
  for (const char* level : {"base", "v3", "v4"})
    if (table_of(level) != nullptr) expected += (expected.empty() ? "" : ", ") + std::string(level);
  throw InvalidArgument("NINEDOF_SIMD", forced, "a level that this build and this processor have: " + expected);
}

}  // namespace

const Table* table_of(const std::string& level) {
  // No instruction of v2 helps these kernels.
  if (level == "base" || level == "v2") return &base::level_table;
#ifdef NINEDOF_HAS_v3
  if (level == "v3" && runs_v3()) return &v3::level_table;
#endif
#ifdef NINEDOF_HAS_v4
  if (level == "v4" && runs_v4()) return &v4::level_table;
#endif
  return nullptr;
}

const Table& table() {
  static const Table& chosen = choose();
  return chosen;
}

}  // namespace ninedof::kernels
