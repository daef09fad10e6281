/// The least time of the arithmetic of the vector kernels, and their accuracy, as JSON. Run by
/// bench/python/comparison.py.
///
///     ninedof_floor FILE

#include <cstdio>
#include <exception>

#include "batch/floor/floor.hpp"
#include "batch/floor/throughput.hpp"
#include "batch/kernels/dispatch.hpp"
#include "ninedof/batch/batch.hpp"

namespace {

void print(const char* level, int lanes, const bench::Throughput& t, bool last) {
  std::printf("    \"%s\": {\"lanes\": %d, \"multiply\": %.6g, \"add\": %.6g, \"both\": %.6g, \"fused\": %.6g, ", level,
              lanes, t.multiply, t.add, t.both, t.fused);
  std::printf("\"divide\": %.6g, \"root\": %.6g}%s\n", t.divide, t.root, last ? "" : ",");
}

void print(const bench::Count& c, bool last) {
  std::printf("    {\"lanes\": %d, \"poses\": %ld, \"multiplies\": %.6g, \"additions\": %.6g, \"divisions\": %.6g, ",
              c.lanes, c.poses, c.multiplies, c.additions, c.divisions);
  std::printf("\"roots\": %.6g, \"others\": %.6g, \"worst\": %.3g}%s\n", c.roots, c.others, c.worst, last ? "" : ",");
}

void print(const char* name, const bench::Accuracy& a, bool last) {
  std::printf("    \"%s\": {\"error\": %.3g, \"most_condition\": %.3g, \"handed_over\": %ld}%s\n", name, a.error,
              a.most_condition, a.handed_over, last ? "" : ",");
}

}  // namespace

int main(int argc, char** argv) try {
  if (argc != 2) throw std::runtime_error("usage: ninedof_floor FILE");
  const bench::File file(argv[1]);
  std::printf("{\n  \"compiler\": \"%s\",\n  \"eigen\": \"%d.%d.%d\",\n  \"level\": \"%s\",\n", __VERSION__,
              EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION, ninedof::batch::simd_level());
  std::printf("  \"throughput\": {\n");
  const auto* v3 = ninedof::kernels::table_of("v3");
  const auto* v4 = ninedof::kernels::table_of("v4");
  print("base", ninedof::kernels::table_of("base")->lanes, bench::base::throughput(), v3 == nullptr && v4 == nullptr);
#ifdef BENCH_HAS_v3
  if (v3 != nullptr) print("v3", v3->lanes, bench::v3::throughput(), v4 == nullptr);
#endif
#ifdef BENCH_HAS_v4
  if (v4 != nullptr) print("v4", v4->lanes, bench::v4::throughput(), true);
#endif
  std::printf("  },\n  \"operations\": [\n");
  constexpr long most = 100'000;
  for (const int lanes : {1, 4, 8, 16}) print(bench::count_operations(file, lanes, most), lanes == 16);
  std::printf("  ],\n  \"accuracy\": {\n");
  print("random", bench::accuracy(file, false), false);
  print("near_singular", bench::accuracy(file, true), true);
  std::printf("  }\n}\n");
  return 0;
} catch (const std::exception& e) {
  std::fprintf(stderr, "%s\n", e.what());
  return 1;
}
