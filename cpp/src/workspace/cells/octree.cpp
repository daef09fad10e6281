#include "workspace/cells/octree.hpp"

#include <algorithm>
#include <cmath>

#include "math/numbers.hpp"
#include "ninedof/math/parallel.hpp"
#include "workspace/cells/tetrahedra.hpp"
#include "workspace/methods/audit.hpp"

namespace ninedof {
namespace {

constexpr double curvature_room =
    2.0;  // how much more than the corners and the centre show a margin may curve between them
constexpr double guard = 0.1;
constexpr long evaluations_a_cell = 15;  // of its eight children: centres, and corners shared with neighbours

class Grower {
 public:
  Grower(const Margins& margins, CellLattice& lattice, const WorkspaceSettings& settings,
         const std::optional<Vec3>& home, const Control& control)
      : m_(margins), settings_(settings), home_(home), control_(control), lattice_(lattice) {}

  WorkspaceStatus run(bool first_piece_alone) {
    try {
      PointMargins at_home;
      m_.evaluate(&m_.home(), 1, &at_home, control_.stop);
      home_allowed_ = m_.in_chart(m_.home()) && at_home.allowed(m_.groups());
      Audit audit;
      std::vector<Cell> open = roots();
      for (int level = 0;; ++level) {
        std::vector<Leaf> now = judged(open);
        if (level == 0) {
          audit.begin(now, lattice_, m_, settings_, control_);
          evaluations_ = audit.count();
          tree.unseen = audit.unseen();
        }
        tree.doubt = audit.open(now);
        open_home(now);
        if (tree.doubt.coarse) open_all(now);
        keep(now);
        measure(first_piece_alone, audit);
        if (const std::optional<WorkspaceStatus> end = finished(level)) return *end;
        open = divided(now, audit);
      }
    } catch (const Stopped&) {
      return WorkspaceStatus::stopped;
    }
  }
  long evaluations() const { return evaluations_ + lattice_.evaluations(); }

  Octree tree;

 private:
  std::vector<Cell> roots() const {
    std::vector<Cell> out;
    const auto n = static_cast<std::uint32_t>(settings_.resolution);
    for (std::uint32_t k = 0; k < n; ++k)
      for (std::uint32_t j = 0; j < n; ++j)
        for (std::uint32_t i = 0; i < n; ++i) out.push_back({i, j, k, 0});
    return out;
  }

  std::vector<Leaf> judged(const std::vector<Cell>& cells) {
    const std::vector<NinePoints> points = lattice_.points_of(cells, control_.stop);
    lattice_.evaluate(control_, expected_, volume_);
    std::vector<Leaf> out(cells.size());
    parallel_for(static_cast<long>(cells.size()), 256, settings_.threads, [&](long from, long to) {
      if (control_.stop.stop_requested()) throw Stopped{};
      for (auto n = static_cast<std::size_t>(from); n < static_cast<std::size_t>(to); ++n)
        out[n] = judge(cells[n], points[n]);
    });
    return out;
  }

  Leaf judge(const Cell& cell, const NinePoints& points) const;
  void weigh(Leaf& leaf, const NinePoints& points) const;

  /// The home pose is to be found in a cell with an allowed corner.
  void open_home(std::vector<Leaf>& leaves) {
    if (!home_allowed_) return;
    for (Leaf& leaf : leaves) {
      const Vec3 away = (m_.home() - lattice_.centre(leaf.cell)).cwiseAbs(),
                 half = 0.5 * lattice_.size(leaf.cell.level);
      if ((away.array() > half.array()).any() || leaf.inside != 0 || leaf.proved) continue;
      leaf.state = CellState::boundary;
      tree.doubt.measure += leaf.measure;
      tree.doubt.coarse = true;
    }
  }

  /// Cells that miss most of the set where they can be checked say nothing about where it is not.
  static void open_all(std::vector<Leaf>& leaves) {
    for (Leaf& leaf : leaves)
      if (leaf.state == CellState::outside && !leaf.proved) leaf.state = CellState::boundary;
  }

  void keep(const std::vector<Leaf>& now) {
    tree.first_open = settled_.size();
    tree.leaves = settled_;
    tree.leaves.insert(tree.leaves.end(), now.begin(), now.end());
  }

  /// Settled cells stay, children of the others are next.
  std::vector<Cell> divided(const std::vector<Leaf>& now, Audit& audit) {
    std::vector<Cell> next;
    std::vector<long> rank(now.size(), -1);
    parents_.clear();
    for (std::size_t n = 0; n < now.size(); ++n) {
      if (now[n].state != CellState::boundary) {
        settled_.push_back(now[n]);
        continue;
      }
      rank[n] = static_cast<long>(parents_.size());
      parents_.push_back(now[n].fraction * now[n].measure);
      for (int octant = 0; octant < 8; ++octant) next.push_back(now[n].cell.child(octant));
    }
    audit.descend(now, rank, lattice_);
    return next;
  }

  void measure(bool first_piece_alone, const Audit& audit);
  std::optional<WorkspaceStatus> finished(int level);

  const Margins& m_;
  const WorkspaceSettings& settings_;
  std::optional<Vec3> home_;
  bool home_allowed_ = false;
  const Control& control_;
  CellLattice& lattice_;
  std::vector<Leaf> settled_;  // the tree itself stays as it was after the last whole level
  std::vector<double> parents_;
  long evaluations_ = 0, expected_ = 0;
  double moved_ = 0.0;  // the last change of the extrapolated volume
  double volume_ = not_a_number, error_ = volume_;
};

Leaf Grower::judge(const Cell& cell, const NinePoints& points) const {
  Leaf leaf;
  leaf.cell = cell;
  const int groups = m_.groups();
  Corners corners;
  for (std::size_t n = 0; n < 8; ++n) corners[n] = &lattice_.margins(points[n]);
  const PointMargins& centre = lattice_.margins(points[8]);
  CutCell cut(corners, groups);
  leaf.inside = static_cast<std::uint8_t>(cut.inside());
  leaf.fraction = cut.fraction();
  leaf.condition_number = centre.condition_number;

  const double reach = m_.leg_speed() * 0.5 * lattice_.size(cell.level).norm();
  bool all_in = leaf.inside == 255, all_out = false;
  for (int g = 0; g < groups; ++g) {
    const auto k = static_cast<std::size_t>(g);
    double least = centre.margin[k], most = least, mean = 0.0;
    for (const PointMargins* corner : corners) {
      least = std::min(least, corner->margin[k]);
      most = std::max(most, corner->margin[k]);
      mean += 0.125 * corner->margin[k];
    }
    const double curve = std::isfinite(mean) ? curvature_room * std::abs(mean - centre.margin[k]) : 0.0;
    if (!(least >= curve)) all_in = false;
    if (most < -curve) all_out = true;
  }
  leaf.proved = centre.proof < -reach || (m_.legs_alone() && centre.proof > reach);
  if (leaf.proved) {
    all_in = centre.proof > 0.0;
    all_out = !all_in;
    leaf.inside = all_in ? 255 : 0;
    leaf.fraction = all_in ? 1.0 : 0.0;
  }
  leaf.state = all_in ? CellState::inside : all_out ? CellState::outside : CellState::boundary;
  if (leaf.state == CellState::outside) leaf.limit = static_cast<std::int16_t>(m_.violated(centre));
  if (leaf.state == CellState::boundary && leaf.inside != 0 && leaf.inside != 255) {
    std::vector<CutCell::Piece> pieces;
    cut.boundary(Vec3::Ones(), pieces);
    std::array<double, 64> area{};
    for (const CutCell::Piece& piece : pieces) area[static_cast<std::size_t>(piece.limit)] += piece.area;
    leaf.limit = static_cast<std::int16_t>(std::max_element(area.begin(), area.end()) - area.begin());
  } else if (leaf.state == CellState::boundary) {
    leaf.limit = static_cast<std::int16_t>(m_.violated(centre));
  }
  weigh(leaf, points);
  return leaf;
}

/// Measure, and integrals by the corners and the centre: trapezium and midpoint rule together are exact for cubics.
void Grower::weigh(Leaf& leaf, const NinePoints& points) const {
  const Chart& chart = m_.chart();
  const double volume = lattice_.size(leaf.cell.level).prod();
  double corner_density = 0.0, corner_sum = 0.0, corner_weight = 0.0;
  const auto inverse = [](double kappa) { return std::isnan(kappa) ? 0.0 : 1.0 / kappa; };
  for (std::size_t n = 0; n < 9; ++n) {
    const PointMargins& at = lattice_.margins(points[n]);
    const double density = chart.positional() ? 1.0 : chart.density(lattice_.point(points[n]));
    const bool allowed = at.allowed(m_.groups());
    if (allowed && at.condition_number > leaf.worst) {
      leaf.worst = at.condition_number;
      leaf.worst_point = points[n];
    }
    if (n == 8) {
      leaf.measure = volume * (2.0 * density + corner_density) / 3.0;
      const double centre = allowed ? density * inverse(at.condition_number) : 0.0;
      const double mean = corner_weight > 0.0 ? corner_sum / corner_weight : centre / density;
      leaf.conditioning_coarse = leaf.fraction * leaf.measure * mean;
      leaf.conditioning = leaf.inside == 255 && allowed
                              ? volume * (2.0 * centre + corner_sum / 8.0) / 3.0 * leaf.fraction
                              : leaf.conditioning_coarse;
      break;
    }
    corner_density += 0.125 * density;
    if (!allowed) continue;
    corner_sum += density * inverse(at.condition_number);
    corner_weight += density;
  }
}

void Grower::measure(bool first_piece_alone, const Audit& audit) {
  if (first_piece_alone) find_pieces(tree.leaves, settings_.resolution, m_.chart(), home_);
  const auto counted = [&](const Leaf& leaf) { return !first_piece_alone || leaf.piece == 0; };
  double volume = 0.0, undecided = 0.0, change = 0.0;
  for (std::size_t n = 0; n < tree.leaves.size(); ++n) {
    const Leaf& leaf = tree.leaves[n];
    if (counted(leaf)) volume += leaf.fraction * leaf.measure;
    if (leaf.state != CellState::boundary) continue;
    if (counted(leaf) || leaf.inside == 0) undecided += leaf.measure;
  }
  for (std::size_t p = 0; p < parents_.size(); ++p) {
    double held = 0.0;
    bool any = !first_piece_alone;
    for (std::size_t child = 0; child < 8; ++child) {
      const Leaf& leaf = tree.leaves[tree.first_open + 8 * p + child];
      held += leaf.fraction * leaf.measure;
      any = any || leaf.piece == 0;
    }
    if (!any) continue;
    change += held - parents_[p];
  }
  // The error falls fourfold from level to level: what is left of it is a third of the last change. Two such extrapolations
  // tell how well that holds. A share of the change, and of how they differed before, guard against their agreeing by chance.
  const double better = parents_.empty() ? volume : volume + change / 3.0;
  const double moved = std::abs(better - volume_);
  error_ = parents_.empty()         ? 0.5 * undecided
           : tree.levels.size() < 2 ? std::abs(change) / 3.0
                                    : std::max({moved, 0.25 * moved_, guard * std::abs(change)});
  moved_ = tree.levels.size() < 2 ? 0.0 : moved;
  error_ = tree.doubt.coarse ? std::max(error_, undecided) : error_ + tree.doubt.measure;
  volume_ = std::clamp(better, 0.0, m_.chart().volume());
  // Of one piece among several the poses only know that it is not the larger.
  error_ = std::max(error_, audit.contradicts(volume_, first_piece_alone));
  tree.levels.push_back({static_cast<long>(tree.leaves.size() - tree.first_open), evaluations(), volume_, error_});
}

std::optional<WorkspaceStatus> Grower::finished(int level) {
  long open = 0;
  for (std::size_t n = tree.first_open; n < tree.leaves.size(); ++n)
    open += tree.leaves[n].state == CellState::boundary ? 1 : 0;
  if (open == 0) return WorkspaceStatus::converged;
  if (level > 0 && !tree.doubt.coarse && error_ <= settings_.tolerance * volume_) return WorkspaceStatus::converged;
  if (level == CellLattice::deepest || evaluations() + evaluations_a_cell * open > settings_.most_evaluations)
    return WorkspaceStatus::limited;
  // Both the error and, upside down, the work change fourfold from level to level.
  long more = evaluations_a_cell * open;
  expected_ = evaluations() + more;
  for (double e = error_ / 4.0; e > settings_.tolerance * volume_ && expected_ < settings_.most_evaluations; e /= 4.0) {
    more *= 4;
    expected_ += more;
  }
  return {};
}

}  // namespace

Octree grow_octree(const Margins& margins, CellLattice& lattice, const WorkspaceSettings& settings,
                   bool first_piece_alone, const std::optional<Vec3>& home, const Control& control) {
  Grower grower(margins, lattice, settings, home, control);
  grower.tree.status = grower.run(first_piece_alone);
  grower.tree.evaluations = grower.evaluations();
  return std::move(grower.tree);
}

}  // namespace ninedof
