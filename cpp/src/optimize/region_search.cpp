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
constexpr std::size_t subsets = 6;           // of the samples: a descent begins from the worst of each
constexpr double small = 0.1;       // margin from which a descent is not worth while
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
    out << design_.margins, -design_.log_objective, design_.state.pose(1).legs.length,
        -design_.state.pose(1).legs.length;
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

/// Lowers one number by moves both ways; a step is doubled where it helps and halved where none does.
long descend(OnePose& design, const Region& region, Eigen::Index k, double& value, Vec6& at) {
  Eigen::VectorXd all;
  long count = 0;
  for (double step = first_step; step >= last_step && count < most_evaluations; step *= 0.5) {
    bool lower = true;
    while (lower && count < most_evaluations) {
      lower = false;
      for (int move = 0; move < region_moves; ++move)
        for (const double side : {1.0, -1.0})
          for (double length = step; length < 2.0; length *= 2.0) {
            const Vec6 next = region.nearest(region_moved(region, at, move, side * length));
            if ((next - at).isZero(0.0)) break;
            design.evaluate(region.pose(next), all);
            ++count;
            if (!(all[k] < value - worthwhile * (1.0 + std::abs(value)))) break;
            value = all[k];
            at = next;
            lower = true;
          }
    }
  }
  return count;
}

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
    std::vector<Least> least(subsets, Least(size));
    Eigen::VectorXd all;
    for (long n = first * block; n < std::min(settings.samples, (first + 1) * block); ++n) {
      const Vec6 at = region_sample(region, n, settings.seed);
      design.evaluate(region.pose(at), all);
      for (Eigen::Index k = 0; k < size; ++k) least[at_index(n) % subsets].take(k, all[k], at);
    }
    of_block[at_index(first)] = std::move(least);
  });
  if (control.stop.stop_requested()) throw Stopped{};
  std::vector<Least> starts(subsets, Least(size));
  for (const std::vector<Least>& least : of_block)
    for (std::size_t subset = 0; subset < subsets; ++subset)
      for (Eigen::Index k = 0; k < size; ++k)
        starts[subset].take(k, least[subset].value[k], least[subset].at[at_index(k)]);

  const Eigen::Index index = shape.margins();
  std::vector<long> counts(at_index(size), 0);
  parallel_for(size, 1, settings.threads, [&](long k, long) {
    OnePose design(problem, variables);
    for (Least& start : starts) {
      double& value = start.value[k];
      if (!control.stop.stop_requested() && std::isfinite(value) && (k >= index || value < small))
        counts[at_index(k)] += descend(design, region, k, value, start.at[at_index(k)]);
    }
  });
  if (control.stop.stop_requested()) throw Stopped{};

  RegionWorst out;
  out.poses = settings.samples;
  for (const long count : counts) out.poses += count;
  // The neutral pose is among the samples: every number was met.
  const auto worst = [&](Eigen::Index k) {
    return std::ranges::min(starts, {}, [k](const Least& l) { return l.value[k]; }).at[at_index(k)];
  };
  for (const Least& end : starts) {
    for (Eigen::Index k = 0; k < index; ++k)
      if (end.value[k] < infinity) out.limits.push_back(shape.limit(k, end.value[k], end.at[at_index(k)]));
    if (end.value[index] < infinity) out.index.push_back({-end.value[index], end.at[at_index(index)]});
  }
  for (Eigen::Index leg = 0; leg < 9; ++leg) {
    out.shortest_at[at_index(leg)] = worst(index + 1 + leg);
    out.longest_at[at_index(leg)] = worst(index + 10 + leg);
  }
  return out;
}

}  // namespace ninedof
