#include "support/summary.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <chrono>
#include <cstdio>

namespace bench {
namespace {

#ifdef __clang__
constexpr const char* compiler = __VERSION__;
#else
constexpr const char* compiler = "GCC " __VERSION__;
#endif

double nanoseconds(const std::function<void(std::size_t)>& work, std::size_t piece) {
  const auto start = std::chrono::steady_clock::now();
  work(piece);
  return std::chrono::duration<double, std::nano>(std::chrono::steady_clock::now() - start).count();
}

double quantile(std::vector<double> values, double fraction) {
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(fraction * static_cast<double>(values.size() - 1) + 0.5);
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

std::string time_text(double ns) {
  char text[32];
  const auto print = [&](double value, const char* unit) {
    std::snprintf(text, sizeof text, value < 100.0 ? "%.1f %s" : "%.0f %s", value, unit);
    return std::string(text);
  };
  if (ns < 1e3) return print(ns, "ns");
  if (ns < 1e6) return print(ns / 1e3, "us");
  return ns < 1e9 ? print(ns / 1e6, "ms") : print(ns / 1e9, "s");
}

}  // namespace

Times paired_times(const Figure& f, int rounds) {
  std::vector<double> ours, baseline, ratio;
  for (int round = -1; round < std::min(rounds, f.most_rounds); ++round)
    for (std::size_t piece = 0; piece < f.pieces; ++piece) {
      const bool ours_first =
          (static_cast<std::size_t>(round + 1) + piece) % 2 == 0;  // neither always runs on a warm cache
      const double first = nanoseconds(ours_first ? f.ours : f.baseline, piece);
      const double second = nanoseconds(ours_first ? f.baseline : f.ours, piece);
      if (round < 0) continue;  // warm up
      ours.push_back((ours_first ? first : second) / static_cast<double>(f.items));
      baseline.push_back((ours_first ? second : first) / static_cast<double>(f.items));
      ratio.push_back(baseline.back() / ours.back());
    }
  return {quantile(ours, 0.5), quantile(ours, 0.99), quantile(baseline, 0.5), quantile(ratio, 0.5)};
}

void print_summary(const Figures& figures, int rounds) {
  std::printf(
      "\n| figure | ours | p99 | baseline | its time | ratio | target | |\n|---|---|---|---|---|---|---|---|\n");
  for (const Figure& f : figures.timed) {
    const Times t = paired_times(f, rounds);
    const char* verdict = !f.target.met ? "" : f.target.met(t) ? "met" : "missed";
    std::printf("| %s | %s | %s | %s | %s | %.2f x %s | %s | %s |\n", f.name.c_str(), time_text(t.ours_median).c_str(),
                time_text(t.ours_p99).c_str(), f.baseline_name.c_str(), time_text(t.baseline_median).c_str(),
                f.as_cost ? 1.0 / t.speedup : t.speedup, f.as_cost ? "the time" : "as fast", f.target.text.c_str(),
                verdict);
    std::fflush(stdout);
  }
  for (const Count& c : figures.counted)
    std::printf("| %s | %d of %d | | | | | %s | %s |\n", c.name.c_str(), c.good, c.total, c.all_claimed ? "all" : "",
                !c.all_claimed      ? ""
                : c.good == c.total ? "met"
                                    : "missed");
  std::printf(
      "\nMedians an item over %d rounds, fewer of what takes seconds. p99: of blocks of 256 items, of single runs for "
      "optimizations.\n"
      "Compiler %s; Eigen %d.%d.%d.\n",
      rounds, compiler, EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION);
}

}  // namespace bench
