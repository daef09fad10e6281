#include "workspace/cells/octree.hpp"

#include <algorithm>
#include <cmath>

#include "math/numbers.hpp"
#include "ninedof/math/parallel.hpp"
#include "workspace/cells/volume_estimate.hpp"
#include "workspace/methods/audit.hpp"

namespace ninedof {
namespace {

constexpr std::size_t blocks = 3;  // along each side, for the error of the volume
constexpr long evaluations_a_cell = 15;  // of its eight children: centres, and corners shared with neighbours

class OctreeBuilder {
 public:
  OctreeBuilder(const LimitsAtPoints& margins, CellLattice& lattice, const WorkspaceSettings& settings,
                bool home_allowed, const Control& control)
      : m_(margins), settings_(settings), home_allowed_(home_allowed), control_(control), lattice_(lattice) {}

  WorkspaceStatus run(bool first_piece_alone) {
    try {
      Audit audit(lattice_, m_, settings_, control_);
      std::vector<Cell> open = lattice_.roots();
      for (int level = 0;; ++level) {
        std::vector<Leaf> now = leaves_of(open);
        if (level == 0) audit.begin(now);
        judge(now, level, first_piece_alone, audit);
        if (const long poses = poses_wanted(level, audit); poses > 0) {
          audit.extend(settled_, now, poses);
          judge(now, level, first_piece_alone, audit);
        }
        estimate_.keep();
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

  /// Opens what poses contradict, and measures the level.
  void judge(std::vector<Leaf>& now, int level, bool first_piece_alone, const Audit& audit) {
    evaluations_ = audit.count();
    tree.disagreement = audit.open(now);
    open_home(now);
    if (tree.disagreement.coarse) open_all(now);
    keep(now);
    measure(first_piece_alone, audit);
    tree.levels.resize(at_index(level) + 1);
    tree.levels.back() = {static_cast<long>(now.size()), evaluations(), volume_, error_};
  }

  /// Divides the cell of an allowed home pose as long as it has no allowed corner.
  void open_home(std::vector<Leaf>& leaves) {
    if (!home_allowed_) return;
    for (Leaf& leaf : leaves) {
      const Vec3 away = (m_.home() - lattice_.centre(leaf.cell)).cwiseAbs(),
                 half = 0.5 * lattice_.size(leaf.cell.level);
      if ((away.array() > half.array()).any() || leaf.inside != 0 || leaf.proved) continue;
      leaf.state = CellState::boundary;
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
    audit.descend(now, rank);
    return next;
  }

  /// The block of the chart that holds a leaf.
  std::size_t block_of(const Leaf& leaf) const {
    const Cell& c = leaf.cell;
    const auto side = static_cast<std::uint32_t>(settings_.resolution);
    const auto at = [&](std::uint32_t n) { return (n >> c.level) * blocks / side; };
    return (at(c.k) * blocks + at(c.j)) * blocks + at(c.i);
  }

  void measure(bool first_piece_alone, const Audit& audit) {
    if (first_piece_alone) find_pieces(tree.leaves, settings_.resolution, m_.chart(), m_.home(), home_allowed_);
    LevelVolumes level{std::vector<double>(blocks * blocks * blocks, 0.0), {}, 0.0};
    level.change = level.held;
    double uncut = 0.0;
    unproved_ = 0.0;
    for (const Leaf& leaf : tree.leaves) {
      if (leaf.counts(first_piece_alone)) level.held[block_of(leaf)] += leaf.fraction * leaf.measure;
      if (!leaf.proved && (leaf.inside == 0 || leaf.inside == 255)) uncut += leaf.measure;
      if (!leaf.proved) unproved_ += lattice_.size(leaf.cell.level).prod();
      if (leaf.state == CellState::boundary && (leaf.counts(first_piece_alone) || leaf.inside == 0))
        level.undecided += leaf.measure;
    }
    for (std::size_t p = 0; p < parents_.size(); ++p) {
      const std::size_t first = tree.first_open + 8 * p;
      double held = 0.0;
      bool any = !first_piece_alone;
      for (std::size_t child = first; child < first + 8; ++child) {
        held += tree.leaves[child].fraction * tree.leaves[child].measure;
        any = any || tree.leaves[child].piece == 0;
      }
      if (any) level.change[block_of(tree.leaves[first])] += held - parents_[p];
    }
    estimate_.set(level);
    volume_ = std::clamp(estimate_.volume(), 0.0, m_.chart().volume());
    // For one piece of several the audit gives only an upper bound of the volume.
    resolved_ = std::max(estimate_.error(), audit.contradicts(volume_, first_piece_alone));
    if (tree.disagreement.coarse) resolved_ = std::max(resolved_, level.undecided);
    tree.unseen = std::min(audit.bound(tree.disagreement.poses), uncut);
    // Nothing is connected with a home pose that is not allowed.
    if (first_piece_alone && !home_allowed_ && !(volume_ > 0.0)) resolved_ = tree.unseen = 0.0;
    error_ = resolved_ + tree.unseen;
  }

  /// How many poses the audit needs for the tolerance, if those are what is missing and cost less than division does.
  long poses_wanted(int level, const Audit& audit) const {
    const double wanted = settings_.tolerance * volume_;
    const long cost = evaluations_a_cell * open_cells(), left = settings_.most_evaluations - evaluations();
    if (error_ <= wanted || resolved_ >= wanted || tree.disagreement.coarse || (level == 0 && cost > 0)) return 0;
    const long hits = tree.disagreement.poses;
    const double now = audit.more(hits, unproved_, wanted - resolved_), least = audit.more(0, unproved_, wanted);
    if (least > static_cast<double>(left)) return left;  // out of reach, but as near as possible
    const bool dividing_is_cheaper = cost > 0 && now - least > static_cast<double>(cost);
    return dividing_is_cheaper || now > static_cast<double>(left) ? 0 : std::lround(now);
  }

  long open_cells() const {
    return std::count_if(tree.leaves.begin() + static_cast<std::ptrdiff_t>(tree.first_open), tree.leaves.end(),
                         [](const Leaf& leaf) { return leaf.state == CellState::boundary; });
  }

  std::optional<WorkspaceStatus> finished(int level) {
    const long open = open_cells();
    const bool reached = error_ <= settings_.tolerance * volume_ && !tree.disagreement.coarse;
    if (open == 0) return reached || !(volume_ > 0.0) ? WorkspaceStatus::converged : WorkspaceStatus::limited;
    if (reached && (level > 0 || error_ == 0.0)) return WorkspaceStatus::converged;
    if (level == CellLattice::deepest || evaluations() + evaluations_a_cell * open > settings_.most_evaluations)
      return WorkspaceStatus::limited;
    // From level to level the work grows by a factor of four and the error falls as it did last, by 4 to 16: that of
    // the extrapolated volume by more than four. The error of the first level is a bound that tells nothing.
    long more = evaluations_a_cell * open;
    expected_ = evaluations() + more;
    if (level > 0) {
      const double fall = std::clamp(level > 1 ? before_ / error_ : 16.0, 4.0, 16.0);
      for (double e = error_ / fall; e > settings_.tolerance * volume_ && expected_ < settings_.most_evaluations;
           e /= fall) {
        more *= 4;
        expected_ += more;
      }
    }
    expected_ = std::min(expected_, settings_.most_evaluations);
    before_ = error_;
    return {};
  }

  const LimitsAtPoints& m_;
  const WorkspaceSettings& settings_;
  const bool home_allowed_;
  const Control& control_;
  CellLattice& lattice_;
  std::vector<Leaf> settled_;  // the tree itself holds the state after the last complete level
  std::vector<double> parents_;
  VolumeEstimate estimate_;
  long evaluations_ = 0, expected_ = 0;
  double unproved_ = 0.0;  // volume, in coordinates, of the cells that are not proved
  double volume_ = not_a_number, error_ = volume_;
  double resolved_ = error_;  // the error without what may be unseen
  double before_ = error_;  // that of the level before
};

}  // namespace

Octree grow_octree(const LimitsAtPoints& margins, CellLattice& lattice, const WorkspaceSettings& settings,
                   bool first_piece_alone, bool home_allowed, const Control& control) {
  OctreeBuilder builder(margins, lattice, settings, home_allowed, control);
  builder.tree.status = builder.run(first_piece_alone);
  builder.tree.evaluations = builder.evaluations();
  return std::move(builder.tree);
}

}  // namespace ninedof
