#include "workspace/methods/audit.hpp"

#include <algorithm>
#include <cmath>

#include "workspace/sequence.hpp"

namespace ninedof {

void Audit::begin(const std::vector<Leaf>& roots, CellLattice& lattice, const Margins& m,
                  const WorkspaceSettings& settings, const Control& control) {
  std::vector<long> judged;
  for (std::size_t n = 0; n < roots.size(); ++n)
    if (!roots[n].proved) judged.push_back(static_cast<long>(n));
  if (judged.empty()) return;
  const Vec3 shift = sequence_shift(settings.seed, 0), size = lattice.size(0);
  const double cells = static_cast<double>(judged.size()), poses = static_cast<double>(settings.points);
  const double share = cells * size.prod() / poses;
  for (const Leaf& root : roots)
    if (root.proved) volume_ += root.fraction * root.measure;
  // In slices, to save memory: only whether a pose is allowed is kept.
  constexpr long slice = 16384;
  for (long first = 0; first < settings.points; first += slice) {
    std::vector<Cell> in;
    std::vector<Vec3> at;
    for (long n = first; n < std::min(first + slice, settings.points); ++n) {
      const auto which = static_cast<std::size_t>((static_cast<double>(n) + 0.5) * cells / poses);
      cell_.push_back(judged[which]);
      in.push_back(roots[at_index(cell_.back())].cell);
      at.push_back(lattice.centre(in.back()) + (sequence_point(n, shift) - Vec3::Constant(0.5)).cwiseProduct(size));
    }
    const std::vector<PointMargins> known = lattice.within(in, at, control.stop);
    for (std::size_t n = 0; n < known.size(); ++n) {
      allowed_.push_back(known[n].allowed(m.groups()));
      if (allowed_.back() == 0) continue;
      const double measure = share * m.chart().density(at[n]);
      volume_ += measure;
      squares_ += measure * measure;
    }
    at_.insert(at_.end(), at.begin(), at.end());
  }
  // Rule of three: a feature missed by all n poses has, at 95 % confidence, less than 3 / n of the volume sampled.
  unseen_ = 3.0 / poses * cells * size.prod();
}

double Audit::contradicts(double volume, bool only_if_less) const {
  if (at_.empty() || (only_if_less && volume <= volume_)) return 0.0;
  const double away = std::abs(volume - volume_);
  return away > 3.0 * std::sqrt(squares_) + unseen_ ? away : 0.0;
}

Disagreement Audit::open(std::vector<Leaf>& leaves) const {
  Disagreement out;
  long allowed = 0;
  std::vector<char> counted(leaves.size());
  for (std::size_t n = 0; n < at_.size(); ++n) {
    allowed += allowed_[n] != 0 ? 1 : 0;
    if (cell_[n] < 0) continue;
    const auto at = at_index(cell_[n]);
    Leaf& leaf = leaves[at];
    if (leaf.proved || leaf.inside == (allowed_[n] != 0 ? 255 : 0)) continue;
    leaf.state = CellState::boundary;
    if (leaf.inside != 0 && leaf.inside != 255) continue;
    ++out.poses;
    if (counted[at] == 0) out.measure += leaf.measure;
    counted[at] = 1;
  }
  constexpr double too_many = 0.05;  // a share of the allowed poses
  out.coarse = static_cast<double>(out.poses) > too_many * static_cast<double>(allowed);
  return out;
}

void Audit::descend(const std::vector<Leaf>& leaves, const std::vector<long>& rank, const CellLattice& lattice) {
  for (std::size_t n = 0; n < at_.size(); ++n) {
    if (cell_[n] < 0) continue;
    const auto at = at_index(cell_[n]);
    const Vec3 middle = lattice.centre(leaves[at].cell);
    int octant = 0;
    for (int k = 0; k < 3; ++k) octant |= (at_[n][k] >= middle[k] ? 1 : 0) << k;
    cell_[n] = rank[at] < 0 ? -1 : 8 * rank[at] + octant;
  }
}

}  // namespace ninedof
