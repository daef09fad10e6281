#include "ninedof/optimize/trace.hpp"
#include "support/baseline.hpp"
#include "support/data.hpp"
#include "support/figure.hpp"

namespace bench {
namespace {

constexpr std::size_t random_start_count = 200;

using ninedof::Candidate;
using ninedof::Formulation;

Candidate run(const ninedof::Problem& problem, const Eigen::VectorXd& start, Formulation formulation) {
  return ninedof::trace(problem, start, formulation).end;
}

ninedof::Result multi_start(const ninedof::Problem& problem, int threads) {
  ninedof::Settings settings;
  settings.starts = multi_start_count;
  settings.threads = threads;
  return ninedof::optimize(problem, settings);
}

/// The same starts without the minimax form: the best of as many runs on the condition number itself.
double plain_multi_start(const ninedof::Problem& problem, const Eigen::MatrixXd& starts) {
  double best = std::numeric_limits<double>::infinity();
  for (Eigen::Index k = 0; k < starts.cols(); ++k) {
    const Candidate end = run(problem, starts.col(k), Formulation::plain);
    if (end.feasible()) best = std::min(best, end.condition_number);
  }
  return best;
}

/// What either formulation ends with must be true (the general path, which knows nothing of symmetry, finds the same
/// condition number there) and cannot be below the least value.
void require_true(const Candidate& c) {
  if (!c.feasible()) return;
  const auto& family = ninedof::design_family("hexagonal");
  const std::span<const double> x(c.variables.data(), static_cast<std::size_t>(c.variables.size()));
  const double kappa = plain::condition_number(family.geometry(x), family.configuration(x), 1.0);
  require_close("condition number of an optimum", c.condition_number, kappa, 1e-13 * kappa * kappa);
  require(kappa >= paper_optimum - 1e-6, "an optimum below the least condition number");
}

bool reached_optimum(const Candidate& c) {
  return c.feasible() && std::abs(c.condition_number - paper_optimum) <= 1e-6;
}

void require_same(const ninedof::Result& one, const ninedof::Result& two) {
  require(one.candidates.size() == two.candidates.size(), "multi-start: one and two threads find different optima");
  for (std::size_t k = 0; k < one.candidates.size(); ++k)
    require(one.candidates[k].variables == two.candidates[k].variables, "multi-start: the threads change the bits");
}

}  // namespace

Figures optimization() {
  const ninedof::Problem problem = paper_study();
  const std::vector<Eigen::VectorXd> starts = random_starts(problem, random_start_count);

  Count by_minimax{"random starts that reach 3.762659 (1e-6)", 0, random_start_count, true};
  Count by_plain{"the same, SLSQP on the condition number itself", 0, random_start_count, false};
  for (const Eigen::VectorXd& start : starts) {
    const Candidate ours = run(problem, start, Formulation::minimax);
    const Candidate theirs = run(problem, start, Formulation::plain);
    by_minimax.good += reached_optimum(ours);
    by_plain.good += reached_optimum(theirs);
    require_true(ours);
    require_true(theirs);
  }

  const ninedof::Result one = multi_start(problem, 1);
  require(one.status == ninedof::Status::optimal && reached_optimum(one.candidates.front()),
          "multi-start: not the optimum");
  require_same(one, multi_start(problem, 2));
  const Eigen::MatrixXd low_discrepancy = ninedof::starts(problem, {.starts = multi_start_count});
  require(one.candidates.front().condition_number <= plain_multi_start(problem, low_discrepancy) + 1e-6,
          "multi-start: the plain formulation ends lower");

  const auto optimization_of = [=](Formulation f) { return [=](std::size_t k) { run(problem, starts[k], f); }; };
  const auto multi_start_on = [=](int threads) { return [=](std::size_t) { multi_start(problem, threads); }; };
  const Target target{"300 us", [](const Times& t) { return t.ours_median <= 300e3; }};
  const Target on_two{"12 ms", [](const Times& t) { return t.ours_median <= 12e6; }};
  return {{{"one optimization, random start", "SLSQP on the condition number itself", random_start_count, 1,
            optimization_of(Formulation::minimax), optimization_of(Formulation::plain), target},
           {"multi-start of 64, 1 thread", "64 runs of that SLSQP", 1, 1, multi_start_on(1),
            [=](std::size_t) { plain_multi_start(problem, low_discrepancy); }},
           {"multi-start of 64, 2 threads", "the same, 1 thread", 1, 1, multi_start_on(2), multi_start_on(1), on_two}},
          {by_minimax, by_plain}};
}

}  // namespace bench
