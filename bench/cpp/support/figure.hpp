#pragma once
/// A figure: one piece of work done by the library and by a baseline on the same data, with the claim made about it.
///
/// Work comes in `pieces` that are timed one by one, each of `items` equal items: blocks of many short calls, or single
/// optimizations. The Google Benchmark table and the summary are both made from this list.

#include <cmath>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

#include "ninedof/math/error.hpp"

namespace bench {

/// Nanoseconds an item.
struct Times {
  double ours_median, ours_p99, baseline_median;
  double speedup;  ///< median of the paired ratios baseline / ours
};

/// What is claimed, in words and as a test of the times.
struct Target {
  std::string text = "-";
  std::function<bool(const Times&)> met = nullptr;
};

struct Figure {
  std::string name, baseline_name;
  std::size_t pieces, items;
  std::function<void(std::size_t piece)> ours, baseline;
  Target target = {};
  bool as_cost = false;  ///< ours does more than the baseline: the ratio is shown as what that costs
  int most_rounds = 1'000'000;  ///< fewer rounds for what takes seconds
};

/// A figure that is no time: how many of `total` did what was asked. The claim, where one is made, is all of them.
struct Count {
  std::string name;
  int good, total;
  bool all_claimed;
};

/// What a concept contributes. Making it runs the checks: see `require`.
struct Figures {
  std::vector<Figure> timed;
  std::vector<Count> counted;
};

Figures legs();
Figures velocity();
Figures position();
Figures acceleration();
Figures conditioning();
Figures batch();
Figures sensitivity();
Figures redundancy();
Figures symmetric();
Figures proof();
Figures optimization();
Figures studies();

/// A benchmark of wrong results is worthless: throws, and main aborts, unless `ours` and `baseline` agree.
inline void require_close(const std::string& what, double ours, double baseline, double tolerance) {
  if (!(std::abs(ours - baseline) <= tolerance))
    throw std::runtime_error(what + ": ours " + ninedof::format_number(ours) + ", baseline " +
                             ninedof::format_number(baseline) + ", more than " + ninedof::format_number(tolerance) +
                             " apart");
}
inline void require(bool agreed, const std::string& what) {
  if (!agreed) throw std::runtime_error(what);
}

}  // namespace bench
