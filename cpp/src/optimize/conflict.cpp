#include "optimize/conflict.hpp"

#include <algorithm>
#include <numeric>

#include "math/sort_by.hpp"
#include "ninedof/math/parallel.hpp"
#include "optimize/minimax/relaxation.hpp"

namespace ninedof {
namespace {

/// Starts of a question whether a design satisfies some demands, besides designs already known: within the bounds of
/// the study, and as many far beyond. So many times as many where a conflict is confirmed.
constexpr int most_starts = 4, thorough = 4;
/// Of the designs already known, so many; and so many starts at once, until one satisfies the demands.
constexpr std::size_t most_known = 4, at_once = 4;
/// As the logarithm of a ratio: a hundred times.
constexpr double most_give = 4.605170185988091;
/// Conflicts that may turn out to be none before the search ends.
constexpr int attempts = 4;
/// Violation that counts as none.
constexpr double satisfied = 1e-7;

using Indices = std::vector<std::size_t>;

class Search {
 public:
  Search(const Problem& problem, const std::vector<Eigen::VectorXd>& ends, const Settings& settings,
         const Control& control)
      : study(problem), settings_(settings), control_(control), none_(study.demands().size(), false) {
    for (const Eigen::VectorXd& x : ends) known_.push_back(study.coordinates(x));
    limits_ = none_;
    for (std::size_t d = 0; d < none_.size(); ++d) limits_[d] = !study.demands()[d].is_bound();
  }

  const Relaxation study;
  long evaluations = 0;
  Eigen::VectorXd nearest_to_all;

  bool stopped() const { return control_.stop.stop_requested(); }
  Demands of(const Indices& demands) const {
    Demands out = none_;
    for (const std::size_t d : demands) out[d] = true;
    return out;
  }

  /// The design found that violates the demands least. The designs found last are starts too.
  Eigen::VectorXd nearest(const Demands& demands, int times = 1) {
    for (const Eigen::VectorXd& y : known_)
      if (study.violation(y, demands) <= satisfied) return y;
    std::vector<Eigen::VectorXd> starts = last_known();
    const int fresh = times * std::min(settings_.starts, most_starts);
    for (int k = 0; k < fresh; ++k) {
      starts.push_back(study.start(k, settings_.seed));
      starts.push_back(study.far_start(k, settings_.seed));
    }
    std::vector<Eigen::VectorXd> ends(starts.size());
    std::vector<double> violations(starts.size(), infinity);
    std::vector<long> counts(starts.size(), 0);
    for (std::size_t first = 0; first < starts.size(); first += at_once) {
      const std::size_t count = std::min(at_once, starts.size() - first);
      parallel_for(static_cast<long>(count), 1, settings_.threads, [&](long k, long) {
        const std::size_t at = first + at_index(k);
        ends[at] = study.least(starts[at], demands, limits_, settings_.max_evaluations, control_.stop, counts[at]);
        violations[at] = study.violation(ends[at], demands);
      });
      if (*std::ranges::min_element(violations) <= satisfied) break;
    }
    evaluations += std::accumulate(counts.begin(), counts.end(), 0L);
    known_.push_back(ends[at_index(std::ranges::min_element(violations) - violations.begin())]);
    return known_.back();
  }
  bool possible(const Demands& demands, int times = 1) {
    return study.violation(nearest(demands, times), demands) <= satisfied;
  }

  /// A smallest set of `demands`, the first ones preferred, that is impossible with `background` (QuickXplain, Junker
  /// 2004). `demands` are impossible with it; `changed` tells whether the background alone may be.
  Indices smallest(const Indices& background, bool changed, const Indices& demands) {
    if (stopped() || (changed && !possible(of(background)))) return {};
    if (demands.size() <= 1) return demands;
    const auto half = demands.begin() + static_cast<std::ptrdiff_t>(demands.size() / 2);
    const Indices first(demands.begin(), half), second(half, demands.end());
    const Indices of_second = smallest(joined(background, first), true, second);
    const Indices of_first = smallest(joined(background, of_second), !of_second.empty(), first);
    return joined(of_first, of_second);
  }

  /// What one of the demands would have to be with all the others kept, in words; empty where that is not enough, or no
  /// practical way: more than a hundred times the limit.
  std::string enough(std::size_t demand, Demands counted) {
    counted[demand] = false;
    const Eigen::VectorXd from = nearest(counted);
    if (study.violation(from, counted) > satisfied || stopped()) return "";
    counted[demand] = true;
    Demands give = none_;
    give[demand] = true;
    Demands others = counted;
    others[demand] = false;
    std::vector<Eigen::VectorXd> starts = last_known();
    starts.push_back(from);
    starts.push_back(nearest_to_all);
    for (int k = 0; k < most_starts; ++k) starts.push_back(study.start(k, settings_.seed));
    std::vector<Eigen::VectorXd> ends(starts.size());
    std::vector<long> counts(starts.size(), 0);
    parallel_for(static_cast<long>(starts.size()), 1, settings_.threads, [&](long k, long) {
      const std::size_t at = at_index(k);
      ends[at] = study.least(starts[at], counted, give, settings_.max_evaluations, control_.stop, counts[at]);
    });
    evaluations += std::accumulate(counts.begin(), counts.end(), 0L);
    Eigen::VectorXd best = from;
    for (const Eigen::VectorXd& end : ends)
      if (study.violation(end, others) <= satisfied && study.violations(end)[demand] < study.violations(best)[demand])
        best = end;
    return study.violations(best)[demand] <= most_give ? study.enough(study.demands()[demand], best) : "";
  }

  static Indices joined(Indices a, const Indices& b) {
    a.insert(a.end(), b.begin(), b.end());
    return a;
  }

 private:
  std::vector<Eigen::VectorXd> last_known() const {
    return {known_.end() - static_cast<std::ptrdiff_t>(std::min(most_known, known_.size())), known_.end()};
  }

  Settings settings_;
  const Control& control_;
  Demands none_, limits_;
  std::vector<Eigen::VectorXd> known_;
};

/// "a, b and c".
std::string listed(const std::vector<std::string>& words, const std::string& last) {
  std::string out;
  for (std::size_t k = 0; k < words.size(); ++k)
    out += (k == 0 ? "" : k + 1 < words.size() ? ", " : " " + last + " ") + words[k];
  return out;
}

std::string sentence(Search& search, const Indices& conflict, bool poses) {
  std::vector<std::string> demanded, enough;
  for (const std::size_t d : conflict) demanded.push_back(search.study.demands()[d].words);
  const auto ask = [&](const Demands& counted) {
    for (const std::size_t d : conflict)
      if (std::string words = search.enough(d, counted); !words.empty()) enough.push_back(std::move(words));
  };
  ask(search.study.all());
  const bool further = enough.empty();
  if (further) ask(search.of(conflict));
  const bool several = conflict.size() > 1;
  std::string out = "no design found has " + listed(demanded, "and") + (several ? " together" : "");
  if (poses) (out += ' ') += in_these_poses;
  if (!enough.empty()) out += "; the nearest found " + std::string(several ? "have " : "has ") + listed(enough, "or");
  if (!enough.empty() && several) out += " instead";
  if (!further) return out;
  Demands others = search.study.all();
  for (const std::size_t d : conflict) others[d] = false;
  const std::vector<double> left = search.study.violations(search.nearest(others));
  std::vector<std::string> broken;
  for (std::size_t d = 0; d < left.size(); ++d)
    if (others[d] && left[d] > satisfied) broken.push_back(search.study.demands()[d].words);
  out += "; other limits of the study are in conflict besides";
  return broken.empty() ? out : out + ": the nearest found without these violates " + listed(broken, "and");
}

}  // namespace

Conflict find_conflict(const Problem& problem, const std::vector<Eigen::VectorXd>& ends, const Settings& settings,
                       const Control& control) {
  Search search(problem, ends, settings, control);
  Conflict out;
  const Eigen::VectorXd nearest = search.nearest(search.study.all(), 2);
  search.nearest_to_all = nearest;
  const std::vector<double> violations = search.study.violations(nearest);
  if (search.study.violation(nearest, search.study.all()) <= satisfied) out.allowed = search.study.variables(nearest);
  else if (!settings.explain) out.reason = "no design found has all limits";
  else {
    // Limits are named before bounds, and what is at its limit at the least violation before the rest.
    const double worst = search.study.violation(nearest, search.study.all());
    const std::vector<StudyDemand>& demands = search.study.demands();
    Indices order(demands.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    const auto touched = [&](std::size_t d) {
      const StudyDemand& demand = demands[d];
      if (!demand.is_bound()) return violations[d] >= worst - same_violation;
      const double y = nearest[demand.coordinate];
      return y - demand.low <= same_violation || demand.high - y <= same_violation;
    };
    sort_by(order, [&](std::size_t d) { return 2 * demands[d].is_bound() + !touched(d); });
    Indices likely;
    std::ranges::copy_if(order, std::back_inserter(likely), touched);
    if (likely.empty() || search.possible(search.of(likely))) likely = order;
    Indices conflict;
    bool confirmed = false;
    for (int k = 0; k < attempts && !confirmed && !search.stopped(); ++k) {
      conflict = search.smallest({}, false, likely);
      confirmed = !search.possible(search.of(conflict), thorough);
      likely = order;  // a design that satisfies them is known from now on
    }
    if (!confirmed) conflict = order;  // of all of them it remains true
    for (const std::size_t d : conflict)
      if (std::ranges::find(out.causes, demands[d].name) == out.causes.end()) out.causes.push_back(demands[d].name);
    out.poses = search.study.poses(search.nearest(search.of(conflict)), search.of(conflict));
    if (!search.stopped()) out.reason = sentence(search, conflict, !problem.objective.poses.empty());
  }
  out.evaluations = search.evaluations;
  if (search.stopped())
    out = {.causes = {}, .poses = {}, .reason = "", .allowed = {}, .evaluations = search.evaluations};
  return out;
}

}  // namespace ninedof
