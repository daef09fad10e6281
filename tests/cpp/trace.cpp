/// optimize.hpp: single runs and the starts. The smooth minimax problem gets there where the condition number itself jams.

#include <doctest/doctest.h>

#include "ninedof/optimize.hpp"
#include "studies.hpp"

using namespace studies;
using ninedof::Formulation;
using ninedof::starts;
using ninedof::trace;
using ninedof::Trace;

TEST_SUITE("trace") {
  TEST_CASE(
      "200 random starts on the paper's study: minimax reaches the optimum from all, plain does not, and takes "
      "longer") {
    const Problem p = paper_study();
    Random random(171);
    int by_minimax = 0, by_plain = 0;
    std::size_t minimax_evaluations = 0, plain_evaluations = 0;
    for (int n = 0; n < 200; ++n) {
      // Drawn here, not by the library: sizes spread by their logarithm, O below the platform.
      const double zp = random.log_uniform(0.1, 80.0);
      const Eigen::VectorXd x{{random.log_uniform(0.01, 60.0), random.log_uniform(0.01, 60.0),
                               random.log_uniform(0.01, 60.0), random.log_uniform(0.01, 60.0), zp,
                               std::max(0.05, zp * random.uniform(0.05, 0.95)), 0.0}};
      const auto reaches = [&](Formulation formulation, std::size_t& evaluations) {
        const Trace t = trace(p, x, formulation);
        evaluations += t.best.size();
        return std::abs(t.end.condition_number - paper_optimum) <= 1e-6 && allowed(p, t.end.variables, 1e-8);
      };
      by_minimax += reaches(Formulation::minimax, minimax_evaluations);
      by_plain += reaches(Formulation::plain, plain_evaluations);
    }
    MESSAGE("minimax " << by_minimax << " of 200 in " << minimax_evaluations / 200 << " evaluations, plain " << by_plain
                       << " of 200 in " << plain_evaluations / 200);
    CHECK(by_minimax == 200);
    CHECK(by_plain < 195);
    CHECK(minimax_evaluations < plain_evaluations);
  }

  TEST_CASE("the record of a run never rises, ends where the run ends, and comes out the same again") {
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

  TEST_CASE("starts spread: each tenth of a variable's range in solver coordinates gets its share") {
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

  TEST_CASE("a start outside the bounds is moved inside; one that is none is refused by name") {
    const Problem p = paper_study();
    const Trace t = trace(p, Eigen::VectorXd{{-5.0, 1e9, 3.0, 0.0, 1e9, -1.0, 2.0}});
    CHECK(allowed(p, t.end.variables, 1e-8));
    CHECK(refuses("start", [&] { trace(p, Eigen::VectorXd::Ones(6)); }));
    CHECK(refuses("start", [&] { trace(p, Eigen::VectorXd{}); }));
    CHECK(refuses("start", [&] { trace(p, Eigen::VectorXd::Constant(7, no_number)); }));
    Problem bad = p;
    bad.characteristic_length = -1.0;
    CHECK(refuses("characteristic_length", [&] { trace(bad, Eigen::VectorXd::Ones(7)); }));
    CHECK(refuses("characteristic_length", [&] { starts(bad, {}); }));
    CHECK(refuses("starts", [&] { starts(p, {.starts = -1}); }));
  }
}
