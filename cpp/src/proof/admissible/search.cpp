/// The box of designs, the largest undecided part next. Declared in ninedof/proof/admissible.hpp.

#include <algorithm>
#include <cmath>

#include "math/time_limit.hpp"
#include "ninedof/math/parallel.hpp"
#include "proof/admissible/examine.hpp"

namespace ninedof {
namespace admissible {
namespace {

constexpr std::size_t boxes_at_once = 64;  // of a round: the result does not depend on the number of threads

/// A box that is to be looked at.
struct Waiting {
  ToExamine asked;
  double undecided;                 ///< volume
  std::vector<DesignPiece> pieces;  ///< what is known of it
};

/// What one look gives.
struct LookedAt {
  std::vector<DesignPiece> decided;
  std::vector<Waiting> rests;
  long boxes = 0;
  bool finished = false;
};

class Search {
 public:
  explicit Search(const DesignQuestion& question)
      : examiner_(question), dimensions_(question.varied.size()), range_(range_of(question)) {}
  const std::vector<Demand>& names() const { return examiner_.names(); }
  double volume() const { return volume_of(range_, dimensions_); }
  Waiting whole() const { return again({range_.low, range_.high, Membership::undecided, -1, {}, {}}); }
  Waiting again(const DesignPiece& piece) const {
    const DesignBox box{piece.low, piece.high};
    return {{box, {}, {}, {}}, volume_of(box, dimensions_), {piece}};
  }
  bool divisible(const Waiting& one, double resolution) const {
    return is_divisible(one.asked.box, dimensions_, range_, resolution);
  }
  LookedAt look(const Waiting& one, const Stop& stop) const {
    LookedAt out;
    const Examined found = examiner_.examine(one.asked, stop);
    out.finished = found.finished;
    if (!out.finished) return out;  // what was known stays
    out.boxes = found.boxes;
    const Divided parts = divided(one.asked.box, dimensions_, range_, found.known);
    out.decided = examiner_.pieces_of(parts.decided);
    for (const Rest& rest : parts.rests) {
      ToExamine next = found.inherited;
      next.box = rest.box;
      out.rests.push_back({std::move(next), rest.undecided, examiner_.pieces_of(rest.pieces)});
    }
    return out;
  }

 private:
  Examiner examiner_;
  std::size_t dimensions_;
  DesignBox range_;
};

}  // namespace
}  // namespace admissible

DesignSet admissible_designs(const DesignQuestion& question, const DesignSettings& settings,
                             const std::vector<DesignPiece>& from, const Control& control) {
  using namespace admissible;
  question.validate();
  const TimeLimit limit(settings.seconds, control.stop);
  const auto stopped = [stop = limit.stop()] { return stop.stop_requested(); };
  const Search search(question);
  DesignSet out;
  out.demands = search.names();
  const double whole = search.volume();
  std::vector<Waiting> waiting, small;
  if (from.empty()) waiting.push_back(search.whole());
  for (const DesignPiece& piece : from) {
    Waiting one = search.again(piece);
    if (piece.state != Membership::undecided) out.pieces.push_back(piece);
    else (search.divisible(one, settings.resolution) ? waiting : small).push_back(std::move(one));
  }
  const auto fewer = [](const Waiting& a, const Waiting& b) { return a.undecided < b.undecided; };
  std::ranges::make_heap(waiting, fewer);
  double undecided = 0.0;
  for (const Waiting& one : waiting) undecided += one.undecided;
  while (!waiting.empty() && undecided > settings.undecided * whole && !stopped()) {
    std::vector<Waiting> now;
    while (!waiting.empty() && now.size() < boxes_at_once) {
      std::ranges::pop_heap(waiting, fewer);
      now.push_back(std::move(waiting.back()));
      waiting.pop_back();
    }
    std::vector<LookedAt> found(now.size());
    parallel_for(static_cast<long>(now.size()), 1, settings.threads, [&](long first, long last) {
      for (long n = first; n < last; ++n)
        found[static_cast<std::size_t>(n)] = search.look(now[static_cast<std::size_t>(n)], stopped);
    });
    for (std::size_t n = 0; n < found.size(); ++n) {
      if (!found[n].finished) {
        small.push_back(std::move(now[n]));
        continue;
      }
      ++out.looked_at;
      out.boxes += found[n].boxes;
      undecided -= now[n].undecided;
      out.pieces.insert(out.pieces.end(), found[n].decided.begin(), found[n].decided.end());
      for (Waiting& rest : found[n].rests) {
        undecided += rest.undecided;
        if (!search.divisible(rest, settings.resolution)) {
          small.push_back(std::move(rest));
          continue;
        }
        waiting.push_back(std::move(rest));
        std::ranges::push_heap(waiting, fewer);
      }
    }
    if (control.progress) control.progress(out.looked_at, 0, undecided / whole);
  }
  out.interrupted = control.stop.stop_requested();
  for (const std::vector<Waiting>* all : {&waiting, &small})
    for (const Waiting& one : *all) out.pieces.insert(out.pieces.end(), one.pieces.begin(), one.pieces.end());
  out.inside = out.outside = out.undecided = 0.0;
  for (const DesignPiece& piece : out.pieces) {
    const double share = volume_of({piece.low, piece.high}, question.varied.size()) / whole;
    (piece.state == Membership::inside    ? out.inside
     : piece.state == Membership::outside ? out.outside
                                          : out.undecided) += share;
  }
  return out;
}

}  // namespace ninedof
