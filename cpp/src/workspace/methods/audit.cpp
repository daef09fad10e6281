#include "workspace/methods/audit.hpp"

#include <algorithm>
#include <cmath>

#include "math/numbers.hpp"
#include "workspace/sequence.hpp"

namespace ninedof {
namespace {

/// Upper bound, at about 95 % confidence, of the mean of a Poisson distribution that gave `hits`: 3 for none.
double most_expected(long hits) {
  return 3.0 + static_cast<double>(hits) + 1.7 * std::sqrt(static_cast<double>(hits));
}

}  // namespace

void Audit::draw(const std::vector<const Leaf*>& leaves, const std::vector<long>& number, long count) {
  double total = 0.0;
  for (const Leaf* leaf : leaves) total += volume_of(*leaf);
  const double share = total / static_cast<double>(count);
  const Vec3 shift = sequence_shift(settings_.seed, batches_++);
  std::size_t which = 0;
  double before = 0.0;
  // In slices, to save memory: only whether a pose is allowed is kept.
  constexpr long slice = 16384;
  for (long first = 0; first < count; first += slice) {
    std::vector<Cell> roots;
    std::vector<Vec3> at;
    for (long n = first; n < std::min(first + slice, count); ++n) {
      const double wanted = (static_cast<double>(n) + 0.5) * share;
      while (which + 1 < leaves.size() && before + volume_of(*leaves[which]) <= wanted)
        before += volume_of(*leaves[which++]);
      const Cell& in = leaves[which]->cell;
      cell_.push_back(number[which]);
      roots.push_back({in.i >> in.level, in.j >> in.level, in.k >> in.level, 0});
      at.push_back(lattice_.centre(in) +
                   (sequence_point(n, shift) - Vec3::Constant(0.5)).cwiseProduct(lattice_.size(in.level)));
    }
    for (const PointMargins& known : lattice_.within(roots, at, control_.stop))
      allowed_.push_back(known.allowed(m_.groups()));
    at_.insert(at_.end(), at.begin(), at.end());
  }
  density_ += 1.0 / share;
}

void Audit::begin(const std::vector<Leaf>& roots) {
  std::vector<const Leaf*> leaves;
  std::vector<long> number;
  for (std::size_t n = 0; n < roots.size(); ++n) {
    if (roots[n].proved) volume_ += roots[n].fraction * roots[n].measure;
    if (roots[n].proved) continue;
    leaves.push_back(&roots[n]);
    number.push_back(static_cast<long>(n));
  }
  if (leaves.empty()) return;
  draw(leaves, number, settings_.points);
  first_ = bound(0);
  for (std::size_t n = 0; n < at_.size(); ++n) {
    if (allowed_[n] == 0) continue;
    const double measure = m_.chart().density(at_[n]) / density_;
    volume_ += measure;
    squares_ += measure * measure;
  }
}

void Audit::extend(std::vector<Leaf>& settled, std::vector<Leaf>& now, long count) {
  // Leaves are numbered through: those of the last level first, then settled ones.
  std::vector<const Leaf*> leaves;
  std::vector<long> number;
  const auto add = [&](const std::vector<Leaf>& some, std::size_t first) {
    for (std::size_t n = 0; n < some.size(); ++n) {
      if (some[n].proved) continue;
      leaves.push_back(&some[n]);
      number.push_back(static_cast<long>(first + n));
    }
  };
  add(now, 0);
  add(settled, now.size());
  if (leaves.empty()) return;
  const std::size_t known = at_.size(), open = now.size();
  draw(leaves, number, count);
  std::vector<long> moved(settled.size(), -1);  // place in `now`
  for (std::size_t n = known; n < at_.size(); ++n) {
    const auto at = at_index(cell_[n]);
    if (at < open) continue;
    const std::size_t s = at - open;
    if (moved[s] < 0 && settled[s].inside != (allowed_[n] != 0 ? 255 : 0)) {
      moved[s] = static_cast<long>(now.size());
      now.push_back(settled[s]);
    }
  }
  std::vector<Leaf> rest;
  for (std::size_t s = 0; s < settled.size(); ++s)
    if (moved[s] < 0) rest.push_back(settled[s]);
  settled = std::move(rest);
  for (std::size_t n = known; n < at_.size(); ++n)
    if (at_index(cell_[n]) >= open) cell_[n] = moved[at_index(cell_[n]) - open];
}

double Audit::bound(long hits) const {
  return density_ > 0.0 ? most_expected(hits) / density_ : 0.0;
}

double Audit::more(long hits, double where, double wanted) const {
  return wanted > 0.0 ? std::max(1.01 * most_expected(hits) / wanted - density_, 0.0) * where + 1.0 : infinity;
}

double Audit::contradicts(double volume, bool only_if_less) const {
  if (at_.empty() || (only_if_less && volume <= volume_)) return 0.0;
  const double away = std::abs(volume - volume_);
  return away > 3.0 * std::sqrt(squares_) + first_ ? away : 0.0;
}

Disagreement Audit::open(std::vector<Leaf>& leaves) const {
  Disagreement out;
  long allowed = 0;
  for (std::size_t n = 0; n < at_.size(); ++n) {
    allowed += allowed_[n] != 0 ? 1 : 0;
    if (cell_[n] < 0) continue;
    const auto at = at_index(cell_[n]);
    Leaf& leaf = leaves[at];
    if (leaf.proved || leaf.inside == (allowed_[n] != 0 ? 255 : 0)) continue;
    leaf.state = CellState::boundary;
    if (leaf.inside != 0 && leaf.inside != 255) continue;
    ++out.poses;
  }
  constexpr double too_many = 0.05;  // a share of the allowed poses
  out.coarse = static_cast<double>(out.poses) > too_many * static_cast<double>(allowed);
  return out;
}

void Audit::descend(const std::vector<Leaf>& leaves, const std::vector<long>& rank) {
  for (std::size_t n = 0; n < at_.size(); ++n) {
    if (cell_[n] < 0) continue;
    const auto at = at_index(cell_[n]);
    const Vec3 middle = lattice_.centre(leaves[at].cell);
    int octant = 0;
    for (int k = 0; k < 3; ++k) octant |= (at_[n][k] >= middle[k] ? 1 : 0) << k;
    cell_[n] = rank[at] < 0 ? -1 : 8 * rank[at] + octant;
  }
}

}  // namespace ninedof
