#include "proof/admissible/examine.hpp"

#include <algorithm>
#include <functional>
#include <numeric>

namespace ninedof::admissible {
namespace {

constexpr double point_width = 0.05;  // one design is searched as long as a box of this width
constexpr std::size_t most_open = 10'000;  // boxes of poses that a box of designs hands on

/// A few of each demand.
std::vector<Loss> some_losses(const std::vector<Loss>& losses) {
  constexpr int most_of_demand = 3;
  std::map<int, int> count;
  std::vector<Loss> out;
  for (const Loss& loss : losses)
    if (count[loss.demand]++ < most_of_demand) out.push_back(loss);
  return out;
}

}  // namespace

Examiner::Examiner(const DesignQuestion& question) : question_(question), poses_(question), demands_(question) {}

Met Examiner::meet(const DesignsAt& designs, const Spreads& spreads, const Loss& loss, bool closely) const {
  for (const Item& item : demands_.items)
    if (item.demand == loss.demand) return closely ? designs.meet_closely(item, loss.at) : designs.meet(item, loss.at);
  for (const Spread& spread : demands_.spreads)
    if (loss.longest >= 0 && loss.demand == spread.demand + (spread.row->each_leg ? loss.longest : 0))
      return spreads.meet(spread, loss);
  return {};
}

std::vector<Box> Examiner::roots_of(const Item& item) const {
  if (item.at_neutral) return poses_.neutral();
  std::vector<Box> out = poses_.all();
  if (item.with_neutral && !(out.size() == 1 && out.front().piece == -1))
    out.insert(out.end(), poses_.neutral().begin(), poses_.neutral().end());
  return out;
}

/// Positions as lengths, of the design in the middle where the region is in zp.
MetAt Examiner::met_at(const Box& point, const DesignBox& designs) const {
  MetAt out;
  if (point.piece < 0) {
    out.pose = -1 - point.piece;
    return out;
  }
  const DesignForms forms = design_forms(question_, middle_of(designs, question_.varied.size()));
  out.shift = centre(poses_.pose(point, forms).p) - centre(forms.home.p);
  out.tilt = Vec3(point.low[3], point.low[4], 0.0);
  out.yaw = point.low[5];
  return out;
}

std::vector<DesignPiece> Examiner::pieces_of(const std::vector<Piece>& pieces) const {
  std::vector<DesignPiece> out;
  for (const Piece& piece : pieces) {
    out.push_back({piece.box.low, piece.box.high, piece.state, -1, {}, {}});
    if (piece.loss == nullptr) continue;
    out.back().demand = piece.loss->demand;
    out.back().at = met_at(piece.loss->at, piece.box);
    out.back().other = met_at(piece.loss->longest < 0 ? piece.loss->at : piece.loss->other, piece.box);
  }
  return out;
}

bool Examiner::breaks(const DesignBox& box, const std::vector<Loss>& witnesses, const std::vector<int>& some,
                      Knowledge& known) const {
  const DesignsAt designs(question_, poses_, box);
  const auto took = [&](const Found& found) {
    known.losses.insert(known.losses.end(), found.losses.begin(), found.losses.end());
    return found.status == Found::Status::outside;
  };
  if (took(look_at_heights(designs.forms(), demands_.between_plates))) return true;
  for (const Alone& alone : demands_.alone)
    if (took(look_at(designs.forms(), alone))) return true;
  if (!designs.known()) return false;
  const std::stop_token never;
  const Spreads spreads(designs, never);
  for (const int k : some)
    if (is_lost(designs, spreads, witnesses[static_cast<std::size_t>(k)], true, known)) return true;
  return false;
}

bool Examiner::is_lost(const DesignsAt& designs, const Spreads& spreads, const Loss& witness, bool closely,
                       Knowledge& known) const {
  const Met met = meet(designs, spreads, witness, closely);
  if (!met.known || least_of(met.most) >= 0.0) return false;
  known.losses.push_back(witness);
  known.losses.back().most = met.most;
  return most_of(met.most) < 0.0;
}

std::vector<int> Examiner::worst_of(const DesignBox& design, const std::vector<Loss>& witnesses) const {
  const DesignsAt designs(question_, poses_, design);
  if (!designs.known()) return {};
  const std::stop_token never;
  const Spreads spreads(designs, never);
  std::map<int, std::pair<double, int>> worst;
  for (std::size_t k = 0; k < witnesses.size(); ++k) {
    const Met met = meet(designs, spreads, witnesses[k]);
    if (!met.known || met.most.c >= 0.0) continue;
    const auto [at, fresh] = worst.try_emplace(witnesses[k].demand, met.most.c, static_cast<int>(k));
    if (!fresh) at->second = std::min(at->second, std::pair(met.most.c, static_cast<int>(k)));
  }
  std::vector<int> out;
  for (const auto& [demand, one] : worst) out.push_back(one.second);
  return out;
}

Examined Examiner::examine(const ToExamine& asked, const std::stop_token& stop) const {
  Examined out;
  const DesignsAt designs(question_, poses_, asked.box);
  Knowledge& known = out.known;
  out.inherited = asked;
  std::vector<char>& kept = out.inherited.kept;
  kept.resize(1 + demands_.items.size() + demands_.spreads.size() + demands_.alone.size(), 0);
  bool all_looked_at = false, complete = designs.known();
  double width = 0.0;
  for (std::size_t k = 0; k < question_.varied.size(); ++k)
    width = std::max(width, (asked.box.high[k] - asked.box.low[k]) / (question_.high[k] - question_.low[k]));
  if (width == 0.0) width = point_width;
  // Takes what was found; whether no design of the box is inside.
  const auto took = [&](std::size_t n, Found found) {
    out.boxes += found.boxes;
    known.losses.insert(known.losses.end(), found.losses.begin(), found.losses.end());
    known.cuts.insert(known.cuts.end(), found.cuts.begin(), found.cuts.end());
    if (found.status == Found::Status::kept) kept[n] = 1;
    else if (!found.open.empty() && found.open.size() < most_open)
      out.inherited.open[n] = std::make_shared<const std::vector<Box>>(std::move(found.open));
    if (found.status == Found::Status::unknown) complete = false;
    return found.status == Found::Status::outside;
  };
  const auto all = [&] {
    std::size_t n = 0;
    if (kept[n] == 0 && took(n, look_at_heights(designs.forms(), demands_.between_plates))) return;
    ++n;
    for (const Alone& alone : demands_.alone) {
      if (kept[n] == 0 && took(n, look_at(designs.forms(), alone))) return;
      ++n;
    }
    if (!designs.known()) return;
    Spreads spreads(designs, stop);
    for (const Loss& loss : asked.near) {
      ++out.boxes;
      if (is_lost(designs, spreads, loss, false, known)) return;
    }
    for (const Spread& spread : demands_.spreads) {
      if (kept[n] == 0 && took(n, spreads.look_at(spread))) return;
      ++n;
    }
    // First those of which most was left open: where one is not known, the others are looked at less long.
    const auto left_open = [&](std::size_t k) {
      const auto left = asked.open.find(n + k);
      return left == asked.open.end() ? std::size_t{0} : left->second->size();
    };
    std::vector<std::size_t> order(demands_.items.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::stable_sort(order, std::greater(), left_open);
    for (const std::size_t k : order) {
      const auto left = asked.open.find(n + k);
      const Item& item = demands_.items[k];
      const std::vector<Box> roots = left != asked.open.end() ? *left->second : roots_of(item);
      if (kept[n + k] == 0 && took(n + k, climb(designs, item, roots, width, complete, stop))) return;
    }
    all_looked_at = true;
  };
  all();
  out.finished = !stop.stop_requested();
  known.complete = complete && all_looked_at;
  out.inherited.near = some_losses(known.losses);
  return out;
}

}  // namespace ninedof::admissible
