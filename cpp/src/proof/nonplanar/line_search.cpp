#include "proof/nonplanar/line_search.hpp"

#include <chrono>

#include "math/time_limit.hpp"
#include "ninedof/math/parallel.hpp"
#include "proof/nonplanar/line_domain.hpp"
#include "proof/nonplanar/line_test.hpp"

namespace ninedof::proof {
namespace {

struct OpenLines {
  LineBox box;
  SidesOfO sides;
};

/// The box of all designs, cut by the sides of O and by the signs of the places on the line, where squares have kinks
/// in their slopes.
std::vector<OpenLines> whole(const LineLimits& limits, double target) {
  const LineBox box = line_box(limits, target);
  if (std::ranges::any_of(box, [](const Interval& x) { return x.lo > x.hi; })) return {};
  std::vector<OpenLines> out;
  for (unsigned n = 0; n < 16; ++n) {
    OpenLines one{box, {(n & 1U) != 0U ? -1.0 : 1.0, (n & 2U) != 0U ? -1.0 : 1.0}};
    for (const auto& [k, bit] : {std::pair(line::base, 4U), {line::platform, 8U}})
      ((n & bit) != 0U ? one.box[k].hi : one.box[k].lo) = 0.0;
    out.push_back(one);
  }
  return out;
}

class LineSearch {
 public:
  LineSearch(const LineLimits& limits, const OptimumSettings& settings, const Control& control)
      : limits_(limits), settings_(settings), control_(control) {}

  /// Whether no design of the study is below the target. Depth first, a fixed number of boxes at a time: the result
  /// does not depend on the number of threads.
  bool proves(double target, OptimumProof& out, const std::stop_token& stop) const {
    std::vector<OpenLines> open = whole(limits_, target), batch;
    std::vector<LineVerdict> found;
    while (!open.empty() && out.boxes < settings_.box_limit && !stop.stop_requested()) {
      const std::size_t count = std::min<std::size_t>(open.size(), 4096);
      batch.assign(open.end() - static_cast<std::ptrdiff_t>(count), open.end());
      open.resize(open.size() - count);
      found.resize(count);
      parallel_for(static_cast<long>(count), 64, settings_.threads, [&](long first, long last) {
        for (auto i = static_cast<std::size_t>(first); i < static_cast<std::size_t>(last); ++i)
          found[i] = test_box(batch[i].box, limits_, batch[i].sides, target);
      });
      out.boxes += static_cast<long>(count);
      bool divisible = true;
      for (std::size_t i = 0; i < count; ++i) {
        if (found[i].empty) continue;
        if (found[i].at_middle < target) out.better = std::min(out.better, found[i].at_middle);
        divisible = divisible && found[i].divisible;
        const double middle = cut_at(batch[i].box, found[i].cut);
        for (const bool upper : {false, true}) {
          open.push_back(batch[i]);
          Interval& side = open.back().box[found[i].cut];
          (upper ? side.lo : side.hi) = middle;
        }
      }
      if (control_.progress) control_.progress(out.boxes, 0, out.lower_bound);
      if (!divisible || out.better < infinity) break;
    }
    out.open = static_cast<long>(open.size());
    return open.empty();
  }

 private:
  const LineLimits& limits_;
  const OptimumSettings& settings_;
  const Control& control_;
};

}  // namespace

OptimumProof prove_nonplanar(const Problem& study, const OptimumSettings& settings, const Control& control) {
  const auto begin = std::chrono::steady_clock::now();
  const TimeLimit limit(settings.time_limit > 0.0 ? settings.time_limit : infinity, control.stop);
  OptimumProof out;
  const LineLimits limits = line_limits(study, out.left_out);
  const LineSearch search(limits, settings, control);
  // Bounds that are there when the time ends; each takes less than the next one.
  for (const double gap : {0.3, 0.1, 0.02, 0.005, 0.0}) {
    const double target = settings.target * (1.0 - gap);
    if (!(target > 1.0)) continue;
    if (!search.proves(target, out, limit.stop())) break;
    out.lower_bound = target;
  }
  out.complete = out.lower_bound == settings.target;
  out.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return out;
}

}  // namespace ninedof::proof
