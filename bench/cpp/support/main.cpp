/// Every figure beside its baseline: first the checks, then Google Benchmark's table, then the table of ratios.
///
/// --rounds=N sets how often the summary repeats each pair (0: no summary); the other options are Google Benchmark's
/// own. A wrong result aborts with status 1. A missed target does not: it may be the machine.

#include <benchmark/benchmark.h>

#include <Eigen/Core>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <iterator>
#include <set>
#include <string>
#include <vector>

#include "support/summary.hpp"

namespace {

using bench::Figure;
using bench::Figures;

Figures all_figures() {
  Figures all;
  for (Figures (*make)() :
       {bench::legs, bench::velocity, bench::acceleration, bench::position, bench::conditioning, bench::batch,
        bench::sensitivity, bench::redundancy, bench::symmetric, bench::proof, bench::optimization, bench::studies}) {
    Figures f = make();
    std::move(f.timed.begin(), f.timed.end(), std::back_inserter(all.timed));
    std::move(f.counted.begin(), f.counted.end(), std::back_inserter(all.counted));
  }
  return all;
}

/// Google Benchmark sees pieces; the counter gives the time of one item. Wall time: threads are part of some figures.
void add_to_table(const std::string& name, const Figure& f, const std::function<void(std::size_t)>& work) {
  static std::set<std::string> names;
  if (!names.insert(name).second) return;  // one figure may meet several baselines
  const auto run = [&f, &work](benchmark::State& state) {
    std::size_t piece = 0;
    for (auto _ : state) work(piece++ % f.pieces);
    using benchmark::Counter;
    state.counters["item"] =
        Counter(static_cast<double>(f.items), Counter::kIsIterationInvariantRate | Counter::kInvert);
  };
  benchmark::RegisterBenchmark(name.c_str(), run)->UseRealTime();
}

/// Takes "--rounds=N" out of the arguments.
int take_rounds(int& argc, char** argv) {
  int rounds = 31, kept = 1;
  for (int k = 1; k < argc; ++k)
    if (std::strncmp(argv[k], "--rounds=", 9) == 0) rounds = std::atoi(argv[k] + 9);
    else argv[kept++] = argv[k];
  argc = kept;
  return rounds;
}

}  // namespace

int main(int argc, char** argv) {
  const int rounds = take_rounds(argc, argv);
  std::vector<char*> arguments(argv, argv + argc);
  char quick[] = "--benchmark_min_time=0.05";  // each; an option on the command line overrides it
  arguments.insert(arguments.begin() + 1, quick);
  int count = static_cast<int>(arguments.size());
  benchmark::Initialize(&count, arguments.data());
  if (benchmark::ReportUnrecognizedArguments(count, arguments.data())) return EXIT_FAILURE;

  Figures figures;
  try {
    figures = all_figures();
  } catch (const std::exception& e) {
    std::fprintf(stderr, "ninedof_bench: wrong result, nothing is timed: %s\n", e.what());
    return EXIT_FAILURE;
  }
  for (const Figure& f : figures.timed) {
    add_to_table(f.name, f, f.ours);
    add_to_table(f.name + ": " + f.baseline_name, f, f.baseline);
  }
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  if (rounds > 0) bench::print_summary(figures, rounds);
  return EXIT_SUCCESS;
}
