/// The box of designs, the largest undecided part next. Declared in ninedof/proof/admissible.hpp.

#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>

#include "math/numbers.hpp"
#include "ninedof/math/error.hpp"
#include "ninedof/math/parallel.hpp"
#include "proof/admissible/demands.hpp"
#include "proof/admissible/pieces.hpp"

namespace ninedof {
namespace admissible {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::size_t boxes_at_once = 64;  // of a round: the result does not depend on the number of threads

/// A box that is to be looked at.
struct Waiting {
  DesignBox box;
  double undecided;
  std::vector<char> kept;         ///< of each item, spread and limit alone: kept by all designs of the box
  std::vector<Loss> near;         ///< where designs around it broke items
  std::vector<DesignPiece> pieces;  ///< what is known of it
};

/// What one look gives.
struct LookedAt {
  std::vector<DesignPiece> decided;
  std::vector<Waiting> rests;
  long boxes = 0;
};

class Search {
 public:
  explicit Search(const DesignQuestion& question)
      : question_(question), poses_(question), demands_(question), dimensions_(question.varied.size()) {
    std::copy(question.low.begin(), question.low.end(), range_.low.begin());
    std::copy(question.high.begin(), question.high.end(), range_.high.begin());
  }
  const std::vector<Demand>& names() const { return demands_.names; }
  double volume() const { return volume_of(range_, dimensions_); }
  std::size_t items() const { return demands_.items.size() + demands_.spreads.size() + demands_.alone.size(); }
  Waiting whole() const {
    return {range_, volume(), std::vector<char>(items(), 0), {}, {{range_.low, range_.high, Membership::undecided, -1, {}}}};
  }
  Waiting again(const DesignPiece& piece) const {
    const DesignBox box{piece.low, piece.high};
    return {box, volume_of(box, dimensions_), std::vector<char>(items(), 0), {}, {piece}};
  }
  bool divisible(const Waiting& one, double resolution) const {
    bool wide = false;
    for (std::size_t k = 0; k < dimensions_; ++k) {
      const double width = one.box.high[k] - one.box.low[k], range = range_.high[k] - range_.low[k];
      wide = wide || width > std::max(resolution, 1e-9) * range;
    }
    return wide;
  }

  LookedAt look(const Waiting& one) const {
    LookedAt out;
    const DesignsAt designs(question_, poses_, one.box);
    Knowledge known;
    std::vector<char> kept = one.kept;
    bool complete = designs.known();
    // Takes what was found; whether the search of this box is over.
    const auto took = [&](std::size_t n, Found found) {
      out.boxes += found.boxes;
      known.losses.insert(known.losses.end(), found.losses.begin(), found.losses.end());
      known.cuts.insert(known.cuts.end(), found.cuts.begin(), found.cuts.end());
      if (found.status == Found::Status::kept) kept[n] = 1;
      if (found.status == Found::Status::unknown) complete = false;
      return found.status == Found::Status::outside;
    };
    const auto all = [&] {
      std::size_t n = 0;
      for (const Alone& alone : demands_.alone) {
        if (kept[n] == 0 && took(n, look_at(designs.forms(), alone))) return;
        ++n;
      }
      if (!designs.known()) return;
      Spreads spreads(designs);
      for (Loss loss : one.near) {
        const Met met = meet(designs, spreads, loss);
        ++out.boxes;
        if (!met.known || least_of(met.most) >= 0.0) continue;
        loss.most = met.most;
        known.losses.push_back(loss);
        if (most_of(met.most) < 0.0) return;
      }
      for (const Spread& spread : demands_.spreads) {
        if (kept[n] == 0 && took(n, spreads.look_at(spread))) return;
        ++n;
      }
      for (const Item& item : demands_.items) {
        if (kept[n] == 0 && took(n, climb(designs, item, roots_of(item)))) return;
        ++n;
      }
    };
    all();
    known.complete = complete;
    const Divided parts = divided(one.box, dimensions_, range_, known);
    for (const Piece& piece : parts.decided) out.decided.push_back(piece_of(piece));
    std::vector<Loss> near = nearest_losses(known.losses);
    for (const Rest& rest : parts.rests) {
      Waiting next{rest.box, rest.undecided, kept, near, {}};
      for (const Piece& piece : rest.pieces) next.pieces.push_back(piece_of(piece));
      out.rests.push_back(std::move(next));
    }
    return out;
  }

 private:
  Met meet(const DesignsAt& designs, const Spreads& spreads, const Loss& loss) const {
    for (const Item& item : demands_.items)
      if (item.demand == loss.demand) return designs.meet(item, loss.at);
    for (const Spread& spread : demands_.spreads)
      if (loss.longest >= 0 && loss.demand == spread.demand + (spread.row->each_leg ? loss.longest : 0))
        return spreads.meet(spread, loss);
    return {};
  }
  std::vector<Box> roots_of(const Item& item) const {
    if (item.at_neutral) return poses_.neutral();
    std::vector<Box> out = poses_.all();
    if (item.with_neutral && !(out.size() == 1 && out.front().piece == -1))
      out.insert(out.end(), poses_.neutral().begin(), poses_.neutral().end());
    return out;
  }
  /// A few of each demand.
  static std::vector<Loss> nearest_losses(const std::vector<Loss>& losses) {
    constexpr int most_of_demand = 3;
    std::map<int, int> count;
    std::vector<Loss> out;
    for (const Loss& loss : losses)
      if (count[loss.demand]++ < most_of_demand) out.push_back(loss);
    return out;
  }
  DesignPiece piece_of(const Piece& piece) const {
    DesignPiece out{piece.box.low, piece.box.high, piece.state, -1, {}};
    if (piece.loss == nullptr) return out;
    out.demand = piece.loss->demand;
    out.at.pose = piece.loss->at.piece < 0 ? -1 - piece.loss->at.piece : -1;
    if (piece.loss->at.piece >= 0) out.at = met_at(piece.loss->at);
    return out;
  }
  /// Positions in the unit of the region.
  MetAt met_at(const Box& point) const {
    MetAt out;
    out.shift = Vec3(point.low[0], point.low[1], point.low[2]);
    out.tilt = Vec3(point.low[3], point.low[4], 0.0);
    out.yaw = point.low[5];
    return out;
  }

  const DesignQuestion& question_;
  Poses poses_;
  Demands demands_;
  std::size_t dimensions_;
  DesignBox range_;
};

}  // namespace
}  // namespace admissible

void DesignQuestion::validate() const {
  problem.validate();
  const auto& variables = design_family(problem.family).variables();
  if (at.size() != variables.size())
    throw InvalidArgument("at", std::to_string(at.size()) + " values", std::to_string(variables.size()));
  if (varied.empty() || varied.size() > most_varied)
    throw InvalidArgument("vary", std::to_string(varied.size()) + " variables", "one to four");
  if (low.size() != varied.size() || high.size() != varied.size())
    throw InvalidArgument("low, high", "other sizes", "an end for each variable that varies");
  for (std::size_t k = 0; k < varied.size(); ++k) {
    const int index = varied[k];
    if (index < 0 || static_cast<std::size_t>(index) >= variables.size() ||
        std::ranges::count(varied, index) != 1)
      throw InvalidArgument("vary", std::to_string(index), "variables of the family, each once");
    if (!(low[k] < high[k] && std::isfinite(low[k]) && std::isfinite(high[k])))
      throw InvalidArgument(variables[static_cast<std::size_t>(index)].name, format_interval(low[k], high[k]),
                            "low < high, both finite");
  }
  for (std::size_t k = 0; k < at.size(); ++k) require_finite(variables[k].name.c_str(), at[k]);
  for (const Region& one : region) {
    one.validate();
    if (one.placed) throw InvalidArgument("region", "O placed anew at every pose", "O shifted with p, or held");
  }
  for (const Pose& pose : problem.objective.poses)
    if (pose.best_internal) throw InvalidArgument("poses", "O chosen at a pose", "poses that say where O is");
  if (!(condition > 1.0)) throw InvalidArgument("condition", format_number(condition), "a number above 1");
  const bool bounded = std::isfinite(condition) || std::isfinite(problem.objective.condition_limit) ||
                       std::isfinite(problem.objective.neutral_condition_limit);
  bool locked = false;
  for (const Limit& limit : problem.limits) {
    const LimitRow& row = limit_row(limit.name);
    if (row.pose != nullptr && row.pose->first_locked >= 0) locked = true;
    else if (row.pose != nullptr && !row.pose->pairs && row.pose->design_form == nullptr)
      throw InvalidArgument(limit.label(), "a limit without bounds over boxes of designs", "a study without it");
    if (row.spread != nullptr && limit.low > 0.0)
      throw InvalidArgument(limit.label(), "a least value", "a greatest value alone");
  }
  if ((bounded || locked) && problem.characteristic_length.choice != StudyLength::Choice::number)
    throw InvalidArgument("characteristic_length", "one that depends on the design",
                          "a number, where the condition number is limited");
}

DesignSet admissible_designs(const DesignQuestion& question, const DesignSettings& settings,
                             const std::vector<DesignPiece>& from, const Control& control) {
  using namespace admissible;
  question.validate();
  const Clock::time_point start = Clock::now();
  const auto stopped = [&] {
    return control.stop.stop_requested() ||
           std::chrono::duration<double>(Clock::now() - start).count() > settings.seconds;
  };
  const Search search(question);
  DesignSet out;
  out.demands = search.names();
  const double whole = search.volume();
  std::vector<Waiting> waiting, small;
  if (from.empty()) waiting.push_back(search.whole());
  for (const DesignPiece& piece : from) {
    if (piece.state == Membership::undecided) waiting.push_back(search.again(piece));
    else out.pieces.push_back(piece);
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
      for (long n = first; n < last; ++n) found[static_cast<std::size_t>(n)] = search.look(now[static_cast<std::size_t>(n)]);
    });
    for (std::size_t n = 0; n < found.size(); ++n) {
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
