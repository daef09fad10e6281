/// trace.hpp, and the starts of optimize.hpp. The minimax form converges where the plain condition number stops at
/// kinks.

#include "ninedof/optimize/trace.hpp"

#include <doctest/doctest.h>

#include "support/studies.hpp"

using namespace studies;
using ninedof::Formulation;
using ninedof::starts;
using ninedof::trace;
using ninedof::Trace;

namespace {

/// Runs from 200 random starts on the paper's study: how many reached the optimum, and evaluations in all. The starts
/// are drawn here, not by the library: sides by their logarithm from `smallest` up, O below the platform.
struct Tally {
  int reached = 0;
  std::size_t evaluations = 0;
};
Tally tally(Formulation formulation, double smallest, std::uint64_t seed) {
  const Problem p = paper_study();
  Random random(seed);
  Tally out;
  for (int n = 0; n < 200; ++n) {
    Eigen::VectorXd x(7);
    for (Eigen::Index k = 0; k < 4; ++k) x[k] = random.log_uniform(smallest, 60.0);
    x[4] = random.log_uniform(0.1, 80.0);
    x[5] = std::max(0.05, x[4] * random.uniform(0.05, 0.95));
    x[6] = 0.0;
    const Trace t = trace(p, x, formulation);
    out.evaluations += t.best.size();
    out.reached += std::abs(t.end.condition_number - paper_optimum) <= 1e-6 && allowed(p, t.end.variables, 1e-8);
  }
  return out;
}

}  // namespace

TEST_SUITE("trace") {
  TEST_CASE(
      "200 random starts on the paper's study: minimax converges from all; plain stops at kinks, and takes longer") {
    const Tally minimax = tally(Formulation::minimax, 0.1, 171), plain = tally(Formulation::plain, 0.1, 171);
    MESSAGE("minimax " << minimax.reached << " of 200 in " << minimax.evaluations / 200 << " evaluations each, plain "
                       << plain.reached << " in " << plain.evaluations / 200);
    CHECK(minimax.reached == 200);
    CHECK(plain.reached < 195);
    CHECK(minimax.evaluations < plain.evaluations);
  }

  TEST_CASE("also from robots down to a thousandth of their final size") {
    CHECK(tally(Formulation::minimax, 0.005, 172).reached == 200);
  }

  TEST_CASE("the recorded objective never rises, ends at the end point, and is repeatable") {
    const Problem p = paper_study();
    const Eigen::MatrixXd x = starts(p, {.starts = 20});
    for (Eigen::Index k = 0; k < x.cols(); ++k)
      for (const Formulation formulation : {Formulation::minimax, Formulation::plain}) {
        const Trace t = trace(p, x.col(k), formulation), again = trace(p, x.col(k), formulation);
        REQUIRE(!t.best.empty());
        CHECK(std::is_sorted(t.best.begin(), t.best.end(), std::greater<>()));
        CHECK(t.best == again.best);
        CHECK(t.end.variables == again.end.variables);
        if (t.end.feasible()) CHECK(t.best.back() <= t.end.condition_number * (1.0 + 1e-8));
        const double kappa = studies::condition_number(p, t.end.variables);
        CHECK(relative_error(t.end.condition_number, kappa) <= 64.0 * eps * kappa);
      }
  }

  TEST_CASE(
      "starts keep bounds and order, are all different, follow the seed, and do not depend on how many are asked for") {
    Problem p = paper_study();
    p.variables[6] = {-1.0, 2.0};
    p.variables[0] = {0.5, 0.5};
    const Eigen::MatrixXd x = starts(p, {.starts = 200});
    REQUIRE(x.rows() == 7);
    REQUIRE(x.cols() == 200);
    for (Eigen::Index n = 0; n < x.cols(); ++n) {
      for (std::size_t k = 0; k < 7; ++k) {
        const double value = x(static_cast<Eigen::Index>(k), n);
        CHECK((value >= p.variables[k].low && value <= p.variables[k].high));
      }
      CHECK(x(5, n) < x(4, n));
      for (Eigen::Index m = 0; m < n; ++m) CHECK((x.col(n) - x.col(m)).norm() > 1e-3);
    }
    CHECK(starts(p, {.starts = 50}) == x.leftCols(50));
    CHECK(starts(p, {.starts = 200, .threads = 2}) == x);
    CHECK((starts(p, {.starts = 200, .seed = 1}) - x).cwiseAbs().minCoeff() == 0.0);  // a1 is fixed
    CHECK((starts(p, {.starts = 200, .seed = 1}) - x).bottomRows(6).cwiseAbs().minCoeff() > 0.0);
  }

  TEST_CASE("starts are spread evenly: each tenth of a variable's range in solver coordinates gets its share") {
    const Problem p = paper_study();
    const Eigen::MatrixXd x = starts(p, {.starts = 1000});
    for (Eigen::Index k = 0; k < 4; ++k) {
      std::array<int, 10> share{};
      for (Eigen::Index n = 0; n < x.cols(); ++n) {
        const double t = std::asinh(x(k, n)) / std::asinh(p.variables[static_cast<std::size_t>(k)].high);
        ++share[static_cast<std::size_t>(std::min(9.0, 10.0 * t))];
      }
      for (const int count : share) CHECK(std::abs(count - 100) <= 40);
    }
  }

  TEST_CASE("a start outside the bounds is moved inside; an invalid one throws, naming the argument") {
    const Problem p = paper_study();
    const Trace t = trace(p, Eigen::VectorXd{{-5.0, 1e9, 3.0, 0.0, 1e9, -1.0, 2.0}});
    CHECK(allowed(p, t.end.variables, 1e-8));
    CHECK(refuses("start", [&] { trace(p, Eigen::VectorXd::Ones(6)); }));
    CHECK(refuses("start", [&] { trace(p, Eigen::VectorXd{}); }));
    CHECK(refuses("start", [&] { trace(p, Eigen::VectorXd::Constant(7, not_a_number)); }));
    Problem bad = p;
    bad.characteristic_length.value = -1.0;
    CHECK(refuses("characteristic_length", [&] { trace(bad, Eigen::VectorXd::Ones(7)); }));
    CHECK(refuses("characteristic_length", [&] { starts(bad, {}); }));
    CHECK(refuses("starts", [&] { starts(p, {.starts = -1}); }));
  }
}
