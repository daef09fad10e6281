#include "workspace/cells/octree.hpp"

#include <algorithm>
#include <cmath>

#include "math/numbers.hpp"
#include "ninedof/math/parallel.hpp"
#include "workspace/methods/audit.hpp"

namespace ninedof {
namespace {

constexpr double guard = 0.1;  // least error estimate, relative to the last change
constexpr long evaluations_a_cell = 15;  // of its eight children: centres, and corners shared with neighbours

class OctreeBuilder {
 public:
  OctreeBuilder(const Margins& margins, CellLattice& lattice, const WorkspaceSettings& settings, bool home_allowed,
                const Control& control)
      : m_(margins), settings_(settings), home_allowed_(home_allowed), control_(control), lattice_(lattice) {}

  WorkspaceStatus run(bool first_piece_alone) {
    try {
      Audit audit;
      std::vector<Cell> open = lattice_.roots();
      for (int level = 0;; ++level) {
        std::vector<Leaf> now = leaves_of(open);
        if (level == 0) {
          audit.begin(now, lattice_, m_, settings_, control_);
          evaluations_ = audit.count();
          tree.unseen = audit.unseen();
        }
        tree.disagreement = audit.open(now);
        open_home(now);
        if (tree.disagreement.coarse) open_all(now);
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
  std::vector<Leaf> leaves_of(const std::vector<Cell>& cells) {
    const std::vector<NinePoints> points = lattice_.points_of(cells, control_.stop);
    lattice_.evaluate(control_, expected_, volume_);
    std::vector<Leaf> out(cells.size());
    parallel_for(static_cast<long>(cells.size()), 256, settings_.threads, [&](long from, long to) {
      if (control_.stop.stop_requested()) throw Stopped{};
      for (auto n = at_index(from); n < at_index(to); ++n) out[n] = leaf_of(cells[n], points[n], lattice_, m_);
    });
    return out;
  }

  /// Divides the cell of an allowed home pose as long as it has no allowed corner.
  void open_home(std::vector<Leaf>& leaves) {
    if (!home_allowed_) return;
    for (Leaf& leaf : leaves) {
      const Vec3 away = (m_.home() - lattice_.centre(leaf.cell)).cwiseAbs(),
                 half = 0.5 * lattice_.size(leaf.cell.level);
      if ((away.array() > half.array()).any() || leaf.inside != 0 || leaf.proved) continue;
      leaf.state = CellState::boundary;
      tree.disagreement.measure += leaf.measure;
      tree.disagreement.coarse = true;
    }
  }

  /// Opens all cells outside: cells that miss most audit poses are too coarse to exclude any.
  static void open_all(std::vector<Leaf>& leaves) {
    for (Leaf& leaf : leaves)
      if (leaf.state == CellState::outside && !leaf.proved) leaf.state = CellState::boundary;
  }

  void keep(const std::vector<Leaf>& now) {
    tree.first_open = settled_.size();
    tree.leaves = settled_;
    tree.leaves.insert(tree.leaves.end(), now.begin(), now.end());
  }

  /// Keeps settled cells; returns the children of the others.
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

  void measure(bool first_piece_alone, const Audit& audit) {
    if (first_piece_alone) find_pieces(tree.leaves, settings_.resolution, m_.chart(), m_.home());
    double volume = 0.0, undecided = 0.0, change = 0.0;
    for (std::size_t n = 0; n < tree.leaves.size(); ++n) {
      const Leaf& leaf = tree.leaves[n];
      if (leaf.counts(first_piece_alone)) volume += leaf.fraction * leaf.measure;
      if (leaf.state != CellState::boundary) continue;
      if (leaf.counts(first_piece_alone) || leaf.inside == 0) undecided += leaf.measure;
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
    // The error falls by a factor of four from level to level, so that a third of the last change remains. It is
    // estimated by the difference of two such extrapolations, and by no less than parts of the change and of the
    // difference before: two extrapolations may agree by chance.
    const double better = parents_.empty() ? volume : volume + change / 3.0;
    const double moved = std::abs(better - volume_);
    error_ = parents_.empty()         ? 0.5 * undecided
             : tree.levels.size() < 2 ? std::abs(change) / 3.0
                                      : std::max({moved, 0.25 * moved_, guard * std::abs(change)});
    moved_ = tree.levels.size() < 2 ? 0.0 : moved;
    error_ = tree.disagreement.coarse ? std::max(error_, undecided) : error_ + tree.disagreement.measure;
    volume_ = std::clamp(better, 0.0, m_.chart().volume());
    // For one piece of several the audit gives only an upper bound of the volume.
    error_ = std::max(error_, audit.contradicts(volume_, first_piece_alone));
    tree.levels.push_back({static_cast<long>(tree.leaves.size() - tree.first_open), evaluations(), volume_, error_});
  }

  std::optional<WorkspaceStatus> finished(int level) {
    long open = 0;
    for (std::size_t n = tree.first_open; n < tree.leaves.size(); ++n)
      open += tree.leaves[n].state == CellState::boundary ? 1 : 0;
    if (open == 0) return WorkspaceStatus::converged;
    if (level > 0 && !tree.disagreement.coarse && error_ <= settings_.tolerance * volume_)
      return WorkspaceStatus::converged;
    if (level == CellLattice::deepest || evaluations() + evaluations_a_cell * open > settings_.most_evaluations)
      return WorkspaceStatus::limited;
    // From level to level the error falls and the work grows by a factor of four.
    long more = evaluations_a_cell * open;
    expected_ = evaluations() + more;
    for (double e = error_ / 4.0; e > settings_.tolerance * volume_ && expected_ < settings_.most_evaluations;
         e /= 4.0) {
      more *= 4;
      expected_ += more;
    }
    return {};
  }

  const Margins& m_;
  const WorkspaceSettings& settings_;
  const bool home_allowed_;
  const Control& control_;
  CellLattice& lattice_;
  std::vector<Leaf> settled_;  // the tree itself holds the state after the last complete level
  std::vector<double> parents_;
  long evaluations_ = 0, expected_ = 0;
  double moved_ = 0.0;  // last change of the extrapolated volume
  double volume_ = not_a_number, error_ = volume_;
};

}  // namespace

Octree grow_octree(const Margins& margins, CellLattice& lattice, const WorkspaceSettings& settings,
                   bool first_piece_alone, bool home_allowed, const Control& control) {
  OctreeBuilder builder(margins, lattice, settings, home_allowed, control);
  builder.tree.status = builder.run(first_piece_alone);
  builder.tree.evaluations = builder.evaluations();
  return std::move(builder.tree);
}

}  // namespace ninedof
