/// Whether any design of a box is inside. Declared in ninedof/proof/admissible.hpp.

#include <algorithm>
#include <cmath>
#include <numeric>

#include "domains/bound.hpp"
#include "math/time_limit.hpp"
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
  /// The nearest to a design that keeps all comes next.
  bool operator<(const Unrefuted& other) const {
    return away != other.away ? away > other.away : volume < other.volume;
  }
};

struct Refutation {
  std::vector<Unrefuted> rests;
  Witnesses found;
  std::vector<DesignPiece> outside;
  bool inside = false;  ///< the middle
};

class Existence : public BoxSearch {
 public:
  Existence(const DesignQuestion& question, const DesignSettings& settings)
      : examiner_(question),
        dimensions_(question.varied.size()),
        range_(range_of(question)),
        whole_(volume_of(range_, dimensions_)),
        settings_(settings) {
    open.push({range_, whole_});
  }

  DesignExistence found() {
    out_.refuted.demands = examiner_.names();
    out_.looked_at = looked;
    if (exists()) return std::move(out_);
    out_.open += std::ssize(open);
    if (out_.open == 0) {
      out_.state = DesignExistence::State::none;
      out_.refuted.outside = 1.0;
      out_.refuted.undecided = 0.0;
    }
    return std::move(out_);
  }

  OpenHeap<Unrefuted> open;
  std::size_t together() const { return boxes_of_round; }
  bool enough() const { return exists() || open.size() >= most_waiting; }
  std::optional<Refutation> look(const Unrefuted& one, const std::stop_token& stop) const {
    Refutation out;
    Knowledge known;
    std::vector<int> hints = one.hints;
    bool outside = examiner_.breaks(one.box, witnesses_, hints, known);
    if (!outside) {
      const bool lost = std::ranges::any_of(known.losses, [](const Loss& loss) { return loss.most.c < 0.0; });
      std::vector<int> worst = examiner_.worst_of(middle(one.box), witnesses_);
      if (worst.empty() && !lost) {
        const Examined found = examiner_.examine({middle(one.box), {}, {}, {}}, stop);
        if (!found.finished) return {};
        out.inside = found.known.complete && found.known.cuts.empty() && found.known.losses.empty();
        for (const int k : examiner_.worst_of(middle(one.box), found.known.losses))
          out.found.push_back(found.known.losses[static_cast<std::size_t>(k)]);
        std::vector<int> all(out.found.size());
        std::iota(all.begin(), all.end(), 0);
        outside = !out.inside && examiner_.breaks(one.box, out.found, all, known);
      } else {
        std::erase_if(worst, [&](int k) { return std::ranges::count(one.hints, k) > 0; });
        outside = examiner_.breaks(one.box, witnesses_, worst, known);
        hints.insert(hints.begin(), worst.begin(), worst.end());
        hints.resize(std::min(hints.size(), most_hints));
      }
    }
    if (outside && settings_.keep_outside)
      out.outside = examiner_.pieces_of({{one.box, Membership::outside, &known.losses.back()}});
    if (outside || out.inside) return out;
    const Divided parts = divided(one.box, dimensions_, range_, known);
    if (settings_.keep_outside) out.outside = examiner_.pieces_of(parts.decided);
    for (const Rest& rest : parts.rests)
      out.rests.push_back({rest.box, rest.undecided, away(rest.box, known.losses, one.box), hints});
    return out;
  }

  void merge(const Unrefuted& one, Refutation seen) {
    if (exists()) return;
    ++looked;
    if (seen.inside) {
      out_.design = middle(one.box).low;
      out_.state = DesignExistence::State::exists;
      return;
    }
    witnesses_.insert(witnesses_.end(), seen.found.begin(), seen.found.end());
    out_.refuted.pieces.insert(out_.refuted.pieces.end(), seen.outside.begin(), seen.outside.end());
    left_ -= one.volume;
    for (Unrefuted& rest : seen.rests) {
      left_ += rest.volume;
      if (is_divisible(rest.box, dimensions_, range_, settings_.resolution)) open.push(std::move(rest));
      else ++out_.open;
    }
  }
  double value() const { return left_ / whole_; }

 private:
  bool exists() const { return out_.state == DesignExistence::State::exists; }
  DesignBox middle(const DesignBox& box) const { return middle_of(box, dimensions_); }
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
  double whole_;
  const DesignSettings& settings_;
  double left_ = whole_;
  Witnesses witnesses_;
  DesignExistence out_;
};

}  // namespace
}  // namespace admissible

DesignExistence any_admissible(const DesignQuestion& question, const DesignSettings& settings, const Control& control) {
  using namespace admissible;
  question.validate();
  const TimeLimit limit(settings.seconds, control.stop);
  Existence search(question, settings);
  bound(search, {limit.stop(), control.progress}, settings.threads);
  DesignExistence out = search.found();
  out.interrupted = out.state != DesignExistence::State::exists && control.stop.stop_requested();
  return out;
}

}  // namespace ninedof
