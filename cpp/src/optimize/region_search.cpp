#include "ninedof/optimize/region_search.hpp"

#include <algorithm>
#include <cmath>

#include "math/numbers.hpp"
#include "ninedof/math/error.hpp"
#include "ninedof/math/parallel.hpp"
#include "optimize/minimax/design_evaluation.hpp"
#include "optimize/region_sample.hpp"

namespace ninedof {
namespace {

constexpr long block = 2048;         // of samples
// Cells of the region, by the signs of its coordinates: a descent begins from the worst sample of a cell, so that no two
// begin next to each other.
constexpr std::size_t cells = 64;
constexpr long fewest_descents = 6, most_descents = 24;  // of a number; the most where there are many samples
constexpr double small = 0.1;  // margin from which a descent is not worth while, but for the least of all
constexpr double first_step = 0.2, last_step = 1e-5;  // of a descent, in parts of the region
constexpr double worthwhile = 1e-10;  // decrease of a descent's step
constexpr long most_evaluations = 2000;  // of a descent

/// The problem with one pose, off the axis so that the closed form is not used.
Problem with_one_pose(Problem problem) {
  problem.objective.aggregate = Aggregate::worst;
  problem.objective.poses = {{}};
  problem.objective.poses.front().position = Vec3(1.0, 0.5, 0.0);
  return problem;
}

/// A design at one pose after another, as numbers that are the worse the lower they are: the margins of all limits, minus
/// the logarithm of the index, and the length of each leg and its negative.
class OnePose {
 public:
  OnePose(const Problem& problem, const Eigen::VectorXd& variables)
      : p_(with_one_pose(problem)), specs_(p_.pose_specs) {
    p_.set_state(variables, design_.state);
    none_.spectra.assign(at_index(p_.evaluated_spectra()), false);
  }

  Eigen::Index margins() const { return static_cast<Eigen::Index>(p_.margins.size()); }
  Eigen::Index size() const { return margins() + 1 + 18; }
  RegionWorst::Limit limit(Eigen::Index k, double margin, const Vec6& at) const {
    const auto row = static_cast<int>(k);
    return {p_.margin_name(row), row, p_.shown_margin(row, margin).value, at};
  }

  void evaluate(const Pose& pose, Eigen::VectorXd& out) {
    for (std::size_t k = 1; k < specs_.size(); ++k) specs_[k].pose = pose;
    design_.state.set_poses(specs_);
    evaluate_rows(p_, design_, &none_);
    out.resize(size());
    const Vec9 lengths = design_.state.pose(1).legs.length / design_.state.unit;
    out << design_.margins, -design_.log_objective, lengths, -lengths;
  }

 private:
  PreparedProblem p_;
  std::vector<PoseSpec> specs_;
  DesignEvaluation design_;
  RowSelection none_;  // no derivatives
};

/// The least values met, and where.
struct Least {
  explicit Least(Eigen::Index size)
      : value(Eigen::VectorXd::Constant(size, infinity)), at(at_index(size), Vec6::Zero()) {}
  void take(Eigen::Index k, double v, const Vec6& x) {
    if (!(v < value[k])) return;
    value[k] = v;
    at[at_index(k)] = x;
  }
  Eigen::VectorXd value;
  std::vector<Vec6> at;
};

std::size_t cell_of(const Vec6& at) {
  std::size_t out = 0;
  for (Eigen::Index k = 0; k < 6; ++k) out += at[k] > 0.0 ? std::size_t{1} << static_cast<unsigned>(k) : 0;
  return out;
}

/// The cells where a number is least, the lowest first.
std::vector<std::size_t> lowest(const std::vector<Least>& least, Eigen::Index k, std::size_t count) {
  std::vector<std::size_t> out;
  for (std::size_t cell = 0; cell < cells; ++cell)
    if (std::isfinite(least[cell].value[k])) out.push_back(cell);
  std::ranges::stable_sort(out, {}, [&](std::size_t cell) { return least[cell].value[k]; });
  out.resize(std::min(out.size(), count));
  return out;
}

/// Lowers one number by moves both ways, and along the way that a round of moves has led: a ridge need not follow one
/// of the moves. A step is doubled where it helps and halved where none does.
class Descent {
 public:
  Descent(OnePose& design, const Region& region, Eigen::Index number) : design_(design), region_(region), k_(number) {}

  long run(double& value, Vec6& at) {
    for (double step = first_step; step >= last_step && count_ < most_evaluations; step *= 0.5)
      for (bool lower = true; lower && count_ < most_evaluations;) {
        const Vec6 before = at;
        lower = false;
        for (int move = 0; move < region_moves; ++move)
          for (const double side : {1.0, -1.0})
            for (double length = step; length < 2.0; length *= 2.0) {
              if (!takes(region_moved(region_, at, move, side * length), value, at)) break;
              lower = true;
            }
        const Vec6 way = at - before;
        for (double length = 1.0; lower && length < 1e6; length *= 2.0)
          if (!takes(at + length * way, value, at)) break;
      }
    return count_;
  }

 private:
  bool takes(const Vec6& to, double& value, Vec6& at) {
    const Vec6 next = region_.nearest(to);
    if ((next - at).isZero(0.0)) return false;
    design_.evaluate(region_.pose(next), all_);
    ++count_;
    if (!(all_[k_] < value - worthwhile * (1.0 + std::abs(value)))) return false;
    value = all_[k_];
    at = next;
    return true;
  }

  OnePose& design_;
  const Region& region_;
  Eigen::Index k_;
  Eigen::VectorXd all_;
  long count_ = 0;
};

}  // namespace

RegionWorst search_region(const Problem& problem, const Region& region, const Eigen::VectorXd& variables,
                          const RegionSettings& settings, const Control& control) {
  problem.validate();
  region.validate();
  require_full("variables", problem, variables);
  if (settings.samples < 1) throw InvalidArgument("samples", std::to_string(settings.samples), "one or more");
  const OnePose shape(problem, variables);
  const Eigen::Index size = shape.size();
  const long blocks = (settings.samples + block - 1) / block;

  std::vector<std::vector<Least>> of_block(at_index(blocks));
  parallel_for(blocks, 1, settings.threads, [&](long first, long) {
    if (control.stop.stop_requested()) return;
    OnePose design(problem, variables);
    std::vector<Least> least(cells, Least(size));
    Eigen::VectorXd all;
    for (long n = first * block; n < std::min(settings.samples, (first + 1) * block); ++n) {
      const Vec6 at = region_sample(region, n, settings.seed);
      design.evaluate(region.pose(at), all);
      const std::size_t cell = cell_of(at);
      for (Eigen::Index k = 0; k < size; ++k) least[cell].take(k, all[k], at);
    }
    of_block[at_index(first)] = std::move(least);
  });
  if (control.stop.stop_requested()) throw Stopped{};
  std::vector<Least> least(cells, Least(size));
  for (const std::vector<Least>& other : of_block)
    for (std::size_t cell = 0; cell < cells; ++cell)
      for (Eigen::Index k = 0; k < size; ++k) least[cell].take(k, other[cell].value[k], other[cell].at[at_index(k)]);

  const Eigen::Index index = shape.margins();
  const auto sampled = [&](Eigen::Index k) -> const Least& {
    return *std::ranges::min_element(least, {}, [k](const Least& l) { return l.value[k]; });
  };
  // The least margin is stated whatever it is.
  Eigen::Index tightest = -1;
  double tightest_margin = infinity;
  for (Eigen::Index k = 0; k < index; ++k) {
    const Least& at = sampled(k);
    if (const double margin = shape.limit(k, at.value[k], at.at[at_index(k)]).margin; margin < tightest_margin) {
      tightest_margin = margin;
      tightest = k;
    }
  }
  const auto descents = static_cast<std::size_t>(std::clamp(settings.samples / 4000, fewest_descents, most_descents));
  std::vector<std::vector<std::size_t>> starts(at_index(size));
  std::vector<long> counts(at_index(size), 0);
  parallel_for(size, 1, settings.threads, [&](long k, long) {
    OnePose design(problem, variables);
    for (const std::size_t cell : starts[at_index(k)] = lowest(least, k, descents)) {
      double& value = least[cell].value[k];
      if (!control.stop.stop_requested() && (k >= index || value < small || k == tightest))
        counts[at_index(k)] += Descent(design, region, k).run(value, least[cell].at[at_index(k)]);
    }
  });
  if (control.stop.stop_requested()) throw Stopped{};

  RegionWorst out;
  out.poses = settings.samples;
  for (const long count : counts) out.poses += count;
  // The neutral pose is among the samples: every number was met.
  for (Eigen::Index k = 0; k <= index; ++k)
    for (const std::size_t cell : starts[at_index(k)]) {
      const double value = least[cell].value[k];
      const Vec6& at = least[cell].at[at_index(k)];
      if (k < index) out.limits.push_back(shape.limit(k, value, at));
      else out.index.push_back({-value, at});
    }
  const auto worst = [&](Eigen::Index k) { return sampled(k).at[at_index(k)]; };
  for (Eigen::Index leg = 0; leg < 9; ++leg) {
    out.shortest_at[at_index(leg)] = worst(index + 1 + leg);
    out.longest_at[at_index(leg)] = worst(index + 10 + leg);
  }
  return out;
}

}  // namespace ninedof
