#include "proof/nonplanar/line_search.hpp"

#include <chrono>
#include <optional>

#include "domains/bound.hpp"
#include "math/time_limit.hpp"
#include "proof/nonplanar/line_domain.hpp"
#include "proof/nonplanar/line_reason.hpp"
#include "proof/nonplanar/line_test.hpp"
#include "proof/optimum/certificate.hpp"

namespace ninedof::proof {
namespace {

struct OpenLines {
  LineBox box;
  SidesOfO sides;
  std::uint32_t node = 0;
};

/// The box of all designs, cut by the sides of O and by the signs of the places on the line, where squares have kinks
/// in their slopes.
std::vector<OpenLines> whole(const LineLimits& limits, double target) {
  const LineBox box = line_box(limits, target);
  if (std::ranges::any_of(box, [](const Interval& x) { return x.lo > x.hi; })) return {};
  std::vector<OpenLines> out;
  for (unsigned n = 0; n < 16; ++n) {
    OpenLines one{box, {(n & 1U) != 0U ? -1.0 : 1.0, (n & 2U) != 0U ? -1.0 : 1.0}, n};
    for (const auto& [k, bit] : {std::pair(line::base, 4U), {line::platform, 8U}})
      ((n & bit) != 0U ? one.box[k].hi : one.box[k].lo) = 0.0;
    out.push_back(one);
  }
  return out;
}

/// Designs below a target: depth first.
struct LineSearch : BoxSearch {
  OpenStack<OpenLines> open;
  const LineLimits& limits;
  double target, proved;
  long box_limit;
  std::optional<ProofTree> tree = std::nullopt;  ///< unless it is too large or not asked for
  double better = infinity;
  bool divisible = true;
  static constexpr std::size_t most_bytes = std::size_t{1} << 30U;

  std::size_t together() const { return 4096; }
  bool enough() const { return !divisible || better < infinity || looked >= box_limit; }
  std::optional<LineVerdict> look(OpenLines& one, const std::stop_token&) const {
    return test_box(one.box, limits, one.sides, target, tree.has_value());
  }
  void merge(const OpenLines& one, const LineVerdict& seen) {
    ++looked;
    if (tree && tree->size() > most_bytes) tree.reset();
    if (seen.empty) {
      if (tree) tree->close(one.node, seen.reasons);
      return;
    }
    if (seen.at_middle < target) better = std::min(better, seen.at_middle);
    divisible = divisible && seen.divisible;
    const double middle = cut_at(one.box, seen.cut);
    std::uint32_t lower = 0;
    if (tree) {
      Bytes said = seen.reasons;
      said.push_back(static_cast<std::uint8_t>(seen.cut));
      append(said, middle);
      lower = tree->cut(one.node, said);
    }
    for (const bool upper : {false, true}) {
      open.push(one);
      open.back().node = lower + (upper ? 1 : 0);
      Interval& side = open.back().box[seen.cut];
      (upper ? side.lo : side.hi) = middle;
    }
  }
  double value() const { return proved; }
};

}  // namespace

OptimumProof prove_nonplanar(const Problem& study, const OptimumSettings& settings, const Control& control) {
  const auto begin = std::chrono::steady_clock::now();
  const TimeLimit limit(settings.time_limit > 0.0 ? settings.time_limit : infinity, control.stop);
  OptimumProof out;
  const LineLimits limits = line_limits(study, out.left_out);
  // Bounds that are there when the time ends; each takes less than the next one.
  for (const double gap : {0.3, 0.1, 0.02, 0.005, 0.0}) {
    const double target = settings.target * (1.0 - gap);
    if (!(target > 1.0)) continue;
    LineSearch search{{.looked = out.boxes}, {whole(limits, target)}, limits, target,
                      out.lower_bound,       settings.box_limit};
    if (settings.keep_tree) search.tree.emplace(std::max<std::size_t>(search.open.size(), 1));
    if (search.tree && search.open.empty()) search.tree->close(0, {reasons::by_limits});
    bound(search, {limit.stop(), control.progress}, settings.threads, 64);
    out.boxes = search.looked;
    out.better = search.better;
    out.open = std::ssize(search.open);
    if (out.open > 0) break;
    out.lower_bound = target;
    out.certificate = search.tree ? certificate(study, target, out.left_out, search.tree->bytes()) : "";
  }
  out.complete = out.lower_bound == settings.target;
  out.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return out;
}

}  // namespace ninedof::proof
