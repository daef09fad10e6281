/// Whole studies beyond the paper's: the free triples, many poses with every kind of limit, and one look at one pose.

#include <memory>

#include "ninedof/optimize/evaluate.hpp"
#include "ninedof/optimize/optimize.hpp"
#include "support/baseline.hpp"
#include "support/over_poses.hpp"

namespace bench {
namespace {

using ninedof::Bounds;
using ninedof::Candidate;
using ninedof::Problem;
using ninedof::Result;

constexpr double free_triples_optimum = 2.3430924;  // to the digits given

Problem symmetric_problem(Bounds radius, Bounds height) {
  Problem problem;
  problem.family = "symmetric";
  for (const auto& v : ninedof::design_family(problem.family).variables())
    problem.variables.push_back(v.kind == ninedof::VariableKind::angle ? Bounds{v.low, v.high}
                                : v.name.starts_with("z")              ? height
                                                                       : radius);
  return problem;
}

/// Planar triples, base at most twice the platform, longest leg at most three times the shortest.
Problem free_triples() {
  Problem problem = symmetric_problem({0.05, 12.0}, {0.05, 20.0});
  problem.limits = {{"radius_ratio", 0.0, 2.0}, {"leg_ratio", 0.0, 3.0}};
  return problem;
}

/// The worst of 27 poses, a cube of 0.2 zp about the neutral one, with the limits real legs and joints have.
Problem cube_of_poses() {
  using ninedof::Unit;
  Problem problem = symmetric_problem({0.3, 4.0}, {1.0, 5.0});
  problem.limits = {{.name = "leg_ratio", .high = 3.0},
                    {.name = "stroke_ratio", .high = 1.6},
                    {.name = "leg_length", .low = 0.2, .of = Unit::zp},
                    {.name = "joint_spacing", .low = 0.25},
                    {.name = "leg_clearance", .low = 0.05, .of = Unit::zp},
                    {.name = "base_cone", .high = 0.96, .axis = {0.0, 0.0, 1.0}},
                    {.name = "platform_cone", .high = 0.96, .axis = {0.0, 0.0, -1.0}},
                    {.name = "singularity_free", .low = 1e-3},
                    {.name = "zs_fraction", .low = 0.15, .high = 0.85}};
  for (const double x : {-0.1, 0.0, 0.1})
    for (const double y : {-0.1, 0.0, 0.1})
      for (const double z : {-0.1, 0.0, 0.1}) problem.objective.poses.push_back({.position = {x, y, z}, .in_zp = true});
  return problem;
}

Result solve(const Problem& problem, int threads) {
  return ninedof::optimize(problem, {.starts = multi_start_count, .threads = threads});
}

double plain_worst(const Problem& problem, const Eigen::VectorXd& x) {
  const auto& family = ninedof::design_family(problem.family);
  const ninedof::Geometry g = family.geometry({x.data(), family.variables().size()});
  const std::vector<ninedof::Configuration> at = ninedof::configurations(problem, x);
  double worst = 0.0;
  for (std::size_t k = at.size() > 1 ? 1 : 0; k < at.size(); ++k)
    worst = std::max(worst, plain::condition_number(g, at[k], 1.0));
  return worst;
}

/// Optimal, with the objective that plain Eigen finds there, and the same from one thread as from two.
void require_answer(const char* study, const Problem& problem, const Result& r) {
  require(r.status == ninedof::Status::optimal, std::string(study) + ": not optimal: " + r.reason);
  const Candidate& best = r.candidates.front();
  const double kappa = plain_worst(problem, best.variables);
  require_close(study, best.objective, kappa, 1e-13 * kappa * kappa);
  for (const auto& margin : ninedof::evaluate(problem, best.variables).margins)
    require(margin.value >= -1e-8, std::string(study) + ": violates " + margin.name);
}

void require_same_answer(const Result& one, const Result& two) {
  require(one.candidates.size() == two.candidates.size() &&
              one.candidates.front().variables == two.candidates.front().variables,
          "studies: the threads change the answer");
}

/// One displaced pose of planar triples, and designs to look at.
Problem one_pose() {
  Problem problem = free_triples();
  problem.objective.poses = {{.position = {0.1, -0.05, 0.05}, .rotation = {0.1, 0.05, -0.1}, .in_zp = true}};
  return problem;
}

std::vector<Eigen::VectorXd> designs_to_look_at() {
  Random random(4);
  std::vector<Eigen::VectorXd> out(blocks * block_size, Eigen::VectorXd(9));
  for (Eigen::VectorXd& x : out)
    x << random(2.0, 4.0), random(2.0, 4.0), random(-3.0, 3.0), random(1.0, 2.0), random(-3.0, 3.0), random(1.0, 2.0),
        random(-3.0, 3.0), random(3.0, 5.0), random(1.0, 2.5);
  return out;
}

Eigen::VectorXd differences(const Problem& problem, Eigen::VectorXd x) {
  Eigen::VectorXd out(x.size());
  for (Eigen::Index k = 0; k < x.size(); ++k) {
    constexpr double step = 1e-6;
    const double at = x[k];
    x[k] = at + step;
    const double ahead = std::log(plain_worst(problem, x));
    x[k] = at - step;
    out[k] = (ahead - std::log(plain_worst(problem, x))) / (2.0 * step);
    x[k] = at;
  }
  return out;
}

Figure look_at_one_pose() {
  const Problem problem = one_pose();
  const auto designs = std::make_shared<const std::vector<Eigen::VectorXd>>(designs_to_look_at());
  std::size_t compared = 0;
  for (const Eigen::VectorXd& x : *designs) {
    const ninedof::Evaluation e = ninedof::evaluate(problem, x);
    const double kappa = plain_worst(problem, x);
    require_close("evaluate", std::exp(e.log_objective), kappa, 1e-13 * kappa * kappa);
    if (kappa > 30.0) continue;
    compared += (e.gradient - differences(problem, x)).cwiseAbs().maxCoeff() <= 1e-6 * kappa * kappa;
  }
  require(compared > designs->size() / 4, "evaluate: derivatives are not those of plain Eigen");
  return {"evaluate one pose: objective, 9 derivatives, 2 margins",
          "central differences of plain Eigen",
          blocks,
          block_size,
          each_in_block(designs, [=](const Eigen::VectorXd& x) { return ninedof::evaluate(problem, x); }),
          each_in_block(designs, [=](const Eigen::VectorXd& x) { return differences(problem, x); }),
          {},
          false,
          3};
}

}  // namespace

Figures studies() {
  const Problem triples = free_triples(), cube = cube_of_poses();
  const Result one = solve(triples, 1), poses = solve(cube, 2);
  require_answer("free triples", triples, one);
  require_close("free triples", one.candidates.front().objective, free_triples_optimum, 1e-7);
  require_same_answer(one, solve(triples, 2));
  require_answer("27 poses", cube, poses);
  require_same_answer(poses, solve(cube, 1));

  const auto on = [](const Problem& p, int threads) { return [=](std::size_t) { solve(p, threads); }; };
  return {{look_at_one_pose(),
           {"64 starts of free triples, 2 threads",
            "the same, 1 thread",
            1,
            1,
            on(triples, 2),
            on(triples, 1),
            {"40 ms", [](const Times& t) { return t.ours_median <= 40e6; }}},
           {"27 poses, nine kinds of limits, 64 starts, 2 threads",
            "the same, 1 thread",
            1,
            1,
            on(cube, 2),
            on(cube, 1),
            {"5 s", [](const Times& t) { return t.ours_median <= 5e9; }},
            false,
            3}},
          {}};
}

}  // namespace bench
