/// Whether any design of a box is inside. Declared in ninedof/proof/admissible.hpp.

#include <algorithm>
#include <cmath>
#include <numeric>

#include "math/time_limit.hpp"
#include "ninedof/math/parallel.hpp"
#include "proof/admissible/examine.hpp"

namespace ninedof {
namespace admissible {
namespace {

constexpr std::size_t boxes_of_round = 256;  // of a round: the result does not depend on the number of threads
constexpr std::size_t most_waiting = 8'000'000, most_hints = 6;

using Witnesses = std::vector<Loss>;  ///< where designs broke demands

struct Unrefuted {
  DesignBox box;
  double volume;
  double away = 0.0;          ///< its middle from a design that keeps all that was lost, in ranges
  std::vector<int> hints = {};  ///< witnesses of the box around it
};

struct Refutation {
  std::vector<Unrefuted> rests;
  Witnesses found;
  std::vector<DesignPiece> outside;
  bool inside = false;  ///< the middle
  bool finished = false;
};

class Existence {
 public:
  Existence(const DesignQuestion& question, bool keep_outside)
      : examiner_(question), dimensions_(question.varied.size()), range_(range_of(question)), keep_(keep_outside) {}
  const std::vector<Demand>& names() const { return examiner_.names(); }
  Unrefuted whole() const { return {range_, volume_of(range_, dimensions_)}; }
  bool divisible(const DesignBox& box, double resolution) const {
    return is_divisible(box, dimensions_, range_, resolution);
  }
  DesignBox middle(const DesignBox& box) const { return middle_of(box, dimensions_); }
  Refutation look(const Unrefuted& one, const Witnesses& witnesses, const Stop& stop) const {
    Refutation out;
    Knowledge known;
    std::vector<int> hints = one.hints;
    bool outside = examiner_.breaks(one.box, witnesses, hints, known);
    if (!outside) {
      const bool lost = std::ranges::any_of(known.losses, [](const Loss& loss) { return loss.most.c < 0.0; });
      std::vector<int> worst = examiner_.worst_of(middle(one.box), witnesses);
      if (worst.empty() && !lost) {
        const Examined found = examiner_.examine({middle(one.box), {}, {}, {}}, stop);
        if (!found.finished) return out;
        out.inside = found.known.complete && found.known.cuts.empty() && found.known.losses.empty();
        for (const int k : examiner_.worst_of(middle(one.box), found.known.losses))
          out.found.push_back(found.known.losses[static_cast<std::size_t>(k)]);
        std::vector<int> all(out.found.size());
        std::iota(all.begin(), all.end(), 0);
        outside = !out.inside && examiner_.breaks(one.box, out.found, all, known);
      } else {
        std::erase_if(worst, [&](int k) { return std::ranges::count(one.hints, k) > 0; });
        outside = examiner_.breaks(one.box, witnesses, worst, known);
        hints.insert(hints.begin(), worst.begin(), worst.end());
        hints.resize(std::min(hints.size(), most_hints));
      }
    }
    out.finished = true;
    if (outside && keep_) out.outside = examiner_.pieces_of({{one.box, Membership::outside, &known.losses.back()}});
    if (outside || out.inside) return out;
    const Divided parts = divided(one.box, dimensions_, range_, known);
    if (keep_) out.outside = examiner_.pieces_of(parts.decided);
    for (const Rest& rest : parts.rests)
      out.rests.push_back({rest.box, rest.undecided, away(rest.box, known.losses, one.box), hints});
    return out;
  }

 private:
  double away(const DesignBox& part, const std::vector<Loss>& losses, const DesignBox& of) const {
    double most = 0.0;
    for (const Loss& loss : losses) {
      double value = loss.most.c, slopes = 0.0;
      for (std::size_t k = 0; k < dimensions_; ++k) {
        const double half = 0.5 * (of.high[k] - of.low[k]);
        value += loss.most.a[k] * (0.5 * (part.low[k] + part.high[k]) - of.low[k] - half) / half;
        slopes += std::abs(loss.most.a[k]) / half * (range_.high[k] - range_.low[k]);
      }
      if (slopes > 0.0) most = std::max(most, -value / slopes);
    }
    return most;
  }

  Examiner examiner_;
  std::size_t dimensions_;
  DesignBox range_;
  bool keep_;
};

}  // namespace
}  // namespace admissible

DesignExistence any_admissible(const DesignQuestion& question, const DesignSettings& settings, const Control& control) {
  using namespace admissible;
  question.validate();
  const TimeLimit limit(settings.seconds, control.stop);
  const auto stopped = [stop = limit.stop()] { return stop.stop_requested(); };
  const Existence search(question, settings.keep_outside);
  DesignExistence out;
  out.refuted.demands = search.names();
  Witnesses witnesses;
  // The nearest to a design that keeps all comes next.
  const auto later = [](const Unrefuted& a, const Unrefuted& b) {
    return a.away != b.away ? a.away > b.away : a.volume < b.volume;
  };
  std::vector<Unrefuted> waiting{search.whole()};
  const double whole = waiting.front().volume;
  double left = whole;
  while (!waiting.empty() && waiting.size() < most_waiting && !stopped()) {
    std::vector<Unrefuted> now;
    while (!waiting.empty() && now.size() < boxes_of_round) {
      std::ranges::pop_heap(waiting, later);
      now.push_back(std::move(waiting.back()));
      waiting.pop_back();
    }
    std::vector<Refutation> found(now.size());
    parallel_for(static_cast<long>(now.size()), 1, settings.threads, [&](long first, long last) {
      for (long n = first; n < last; ++n)
        found[static_cast<std::size_t>(n)] = search.look(now[static_cast<std::size_t>(n)], witnesses, stopped);
    });
    for (std::size_t n = 0; n < found.size(); ++n) {
      if (!found[n].finished) {
        waiting.push_back(std::move(now[n]));
        std::ranges::push_heap(waiting, later);
        continue;
      }
      ++out.looked_at;
      if (found[n].inside) {
        out.design = search.middle(now[n].box).low;
        out.state = DesignExistence::State::exists;
        return out;
      }
      witnesses.insert(witnesses.end(), found[n].found.begin(), found[n].found.end());
      out.refuted.pieces.insert(out.refuted.pieces.end(), found[n].outside.begin(), found[n].outside.end());
      left -= now[n].volume;
      for (Unrefuted& rest : found[n].rests) {
        left += rest.volume;
        if (!search.divisible(rest.box, settings.resolution)) {
          ++out.open;
          continue;
        }
        waiting.push_back(std::move(rest));
        std::ranges::push_heap(waiting, later);
      }
    }
    if (control.progress) control.progress(out.looked_at, 0, left / whole);
  }
  out.interrupted = control.stop.stop_requested();
  out.open += std::ssize(waiting);
  if (out.open > 0) return out;
  out.state = DesignExistence::State::none;
  out.refuted.outside = 1.0;
  out.refuted.undecided = 0.0;
  return out;
}

}  // namespace ninedof
