/// optimize.hpp: optimal designs. Reference values come from the theory pages (found by another program, one of them
/// proved); the candidates are checked by the general path of conditioning.hpp and against random designs, see
/// studies.hpp.

#include "ninedof/optimize/optimize.hpp"

#include <doctest/doctest.h>

#include "support/hand.hpp"
#include "support/studies.hpp"

using namespace studies;
using ninedof::optimize;

namespace {

/// Everything that must hold for a candidate, whatever the problem.
void check_candidates(const Problem& p, const Result& r) {
  double last = 0.0;
  for (const Candidate& c : r.candidates) {
    CAPTURE(c.variables.transpose());
    CHECK(allowed(p, c.variables, 1e-8));
    const double kappa = studies::condition_number(p, c.variables);
    CHECK(relative_error(c.condition_number, kappa) <= 64.0 * eps * kappa);
    CHECK(c.feasible());
    CHECK(c.stationary());
    CHECK(c.reached >= 0);  // one found from other ends is no start's
    CHECK(c.reached <= r.starts_done);
    CHECK(c.objective == doctest::Approx(c.condition_number).epsilon(1e-14));
    CHECK(c.objective >= last);
    last = c.objective;
  }
}

Problem random_problem(Random& random) {
  Problem p;
  const double size = random.log_uniform(0.3, 30.0);
  for (int k = 0; k < 6; ++k) {
    const double low = k < 4 && random.uniform(0, 1) < 0.5 ? 0.0 : size * random.log_uniform(0.01, 1.0);
    p.variables.push_back(
        {low, low > 0.0 && random.uniform(0, 1) < 0.15 ? low : low + size * random.log_uniform(0.1, 20.0)});
  }
  const double one = random.uniform(-3, 3), other = random.uniform(-3, 3);
  if (random.uniform(0, 1) < 0.5) p.variables.push_back({0.0, 0.0});
  else p.variables.push_back({std::min(one, other), std::max(one, other)});
  if (random.uniform(0, 1) < 0.5)
    p.limits.push_back({"radius_ratio", random.uniform(-1.0, 1.5), random.uniform(1.5, 4.0)});
  if (random.uniform(0, 1) < 0.5) p.limits.push_back({"leg_ratio", random.uniform(0.0, 1.6), random.uniform(1.6, 4.0)});
  if (random.uniform(0, 1) < 0.3)
    p.limits.push_back({"zs_fraction", random.uniform(-0.2, 0.4), random.uniform(0.4, 0.9)});
  return p;
}

/// Planar triples, s left to the optimizer at one of three poses, limits of several kinds.
Problem pose_study(ninedof::Aggregate aggregate) {
  Problem p;
  p.family = "symmetric";
  for (const auto& v : ninedof::design_family(p.family).variables())
    p.variables.push_back({v.low, v.kind == ninedof::VariableKind::length ? 6.0 : v.high});
  p.limits = {{.name = "radius_ratio", .high = 2.0},
              {.name = "leg_ratio", .high = 3.0},
              {.name = "stroke", .high = 0.3, .of = ninedof::Unit::zp},
              {.name = "base_cone", .high = 0.6},
              {.name = "leg_clearance", .low = 0.05, .of = ninedof::Unit::zp},
              {.name = "singularity_free", .low = 0.02, .steps = 2}};
  p.objective.aggregate = aggregate;
  p.objective.poses = {{.position = {0.1, 0.0, 0.1}, .in_zp = true},
                       {.position = {0.0, 0.1, 0.0}, .rotation = {0.1, 0.0, 0.0}, .best_internal = true, .in_zp = true},
                       {.rotation = {0.0, -0.15, 0.0}}};
  return p;
}

}  // namespace

TEST_SUITE("optimize") {
  TEST_CASE("the paper's study: 3.762659, coupled triangles, base twice the platform") {
    const Problem p = paper_study();
    const Result r = optimize(p);
    REQUIRE(r.status == Status::optimal);
    REQUIRE(!r.candidates.empty());
    check_candidates(p, r);
    const Candidate& best = r.candidates.front();
    CHECK(std::abs(best.condition_number - paper_optimum) <= 1e-6);
    CHECK(contains(best.active, "radius_ratio"));
    const bool as_printed = contains(best.active, "a1") && contains(best.active, "b2");
    const bool mirrored = contains(best.active, "a2") && contains(best.active, "b1");
    CHECK((as_printed || mirrored));
    const Eigen::VectorXd& x = best.variables;
    CHECK(x[mirrored ? 1 : 0] == 0.0);
    CHECK(x[mirrored ? 2 : 3] == 0.0);
    CHECK(x[mirrored ? 0 : 1] == doctest::Approx(6.0079).epsilon(1e-5));
    CHECK(x[mirrored ? 3 : 2] == doctest::Approx(3.0040).epsilon(1e-5));
    CHECK(x[4] == doctest::Approx(4.9752).epsilon(1e-5));
    CHECK(x[5] == doctest::Approx(3.1681).epsilon(1e-5));
    CHECK(r.causes.empty());
    CHECK(r.starts_done == Settings{}.starts);
    Random random(151);
    CHECK(best_nearby(p, x, random, cases(20'000)) >= best.condition_number * (1.0 - 1e-9));
  }

  TEST_CASE("with the twist free: 3.749827") {
    for (const double range : {0.6, 1.0, pi, 10.0, infinity}) {
      if (sanitized && range != infinity) continue;
      CAPTURE(range);
      Problem p = paper_study();
      p.variables[6] = {-range, range};
      const Result r = optimize(p);
      REQUIRE(r.status == Status::optimal);
      check_candidates(p, r);
      CHECK(std::abs(r.candidates.front().condition_number - 3.749827) <= 1e-6);
    }
  }

  TEST_CASE("no ratio, sides at most U, heights at most 10 U") {
    for (const auto& [u, expected] :
         {std::pair{1.0, 5.7523}, {3.1623, 4.1026}, {10.0, 3.2241}, {100.0, 2.67555}, {1000.0, 2.56324}}) {
      if (sanitized && u < 1000.0) continue;
      CAPTURE(u);
      const Problem p = open_study(u, 10.0 * u);
      const Result r = optimize(p);
      REQUIRE(r.status == Status::optimal);
      check_candidates(p, r);
      CHECK(std::abs(r.candidates.front().condition_number - expected) <= 6e-5);
    }
  }

  TEST_CASE("the published base and height fixed: 3.7866; base side fixed: 3.5503") {
    Problem p = open_study(60.0, 80.0);
    p.variables[0] = {0.0, 0.0};
    p.variables[1] = {5.8124, 5.8124};
    p.variables[4] = {3.9828, 3.9828};
    Result r = optimize(p);
    REQUIRE(r.status == Status::optimal);
    CHECK(std::abs(r.candidates.front().condition_number - 3.7866) <= 6e-5);
    CHECK(r.candidates.front().variables[2] == doctest::Approx(2.3434).epsilon(1e-4));

    p = open_study(60.0, 80.0);
    p.variables[0].high = p.variables[1].high = 5.8124;
    r = optimize(p);
    REQUIRE(r.status == Status::optimal);
    check_candidates(p, r);
    CHECK(std::abs(r.candidates.front().condition_number - 3.5503) <= 6e-5);
  }

  TEST_CASE("a twist range beyond half a turn is used unchanged") {
    // The same range a full turn lower or higher holds the same robots.
    const auto best = [](double low, double high) {
      Problem p = paper_study();
      p.variables[6] = {low, high};
      const Result r = optimize(p);
      REQUIRE(r.status == Status::optimal);
      check_candidates(p, r);
      return r.candidates.front().condition_number;
    };
    const double turn = 2.0 * pi;
    for (const auto& [low, high] : {std::pair{1.5, 2.0}, {-2.5, -1.0}, {3.0, 3.5}}) {
      if (sanitized && low < 3.0) continue;
      CAPTURE(low);
      const double here = best(low, high);
      CHECK(relative_error(best(low + turn, high + turn), here) <= 1e-9);
      CHECK(relative_error(best(low - turn, high - turn), here) <= 1e-9);
    }
    CHECK(best(3.0, 4.0) <= best(4.0, 4.0) * (1.0 + 1e-9));
  }

  TEST_CASE("random problems: every candidate is feasible, and no random feasible design is better") {
    Random random(152);
    int solved = 0;
    for (int n = 0; n < cases(120, 24); ++n) {
      const Problem p = random_problem(random);
      CAPTURE(n);
      const Result r = optimize(p, {.starts = 32});
      check_candidates(p, r);
      const double best = r.candidates.empty() ? infinity : r.candidates.front().condition_number;
      for (int k = 0; k < cases(500); ++k) {
        Eigen::VectorXd x(7);
        for (Eigen::Index i = 0; i < 7; ++i) {
          const auto& b = p.variables[static_cast<std::size_t>(i)];
          x[i] = random.uniform(b.low, b.high);
        }
        if (allowed(p, x)) CHECK(studies::condition_number(p, x) >= best * (1.0 - 1e-7));
      }
      if (r.candidates.empty()) continue;
      ++solved;
      CHECK(best_nearby(p, r.candidates.front().variables, random, cases(500)) >= best * (1.0 - 1e-7));
    }
    CHECK(solved > cases(120, 24) / 2);
  }

  TEST_CASE("one, two and three threads: the same bits") {
    Random random(153);
    std::vector<Problem> problems{paper_study(), open_study(infinity, infinity), fixed_study({0, 6, 3, 0, 5, 3, 0})};
    problems.push_back(paper_study());
    problems.back().variables[6] = {-pi, pi};  // a whole family of equally good designs
    for (int n = 0; n < cases(10); ++n) problems.push_back(random_problem(random));
    problems.push_back(pose_study(ninedof::Aggregate::weighted));
    for (const Problem& p : problems) {
      const Result one = optimize(p, {.starts = cases(24), .seed = 5, .threads = 1});
      for (const int threads : {2, 3})
        CHECK(same_bits(optimize(p, {.starts = cases(24), .seed = 5, .threads = threads}), one));
    }
  }

  TEST_CASE(
      "several poses: what is returned keeps every limit, is as good as it says, and no design near it is better") {
    using ninedof::Aggregate;
    for (const Aggregate aggregate : {Aggregate::worst, Aggregate::mean_inverse, Aggregate::weighted}) {
      const Problem p = pose_study(aggregate);
      const Result r = optimize(p, {.starts = cases(16)});
      CAPTURE(r.reason);
      REQUIRE(r.status == Status::optimal);
      const auto conditions = [&](const Eigen::VectorXd& x) {
        const hand::Design d = hand::design(p, x);
        Eigen::VectorXd out(3);
        for (Eigen::Index k = 0; k < 3; ++k)
          out[k] = ninedof::condition_number(d.geometry, d.looked()[static_cast<std::size_t>(k)]);
        return out;
      };
      const auto objective = [&](const Eigen::VectorXd& kappa) {
        const double worst = kappa.maxCoeff(), harmonic = 3.0 / kappa.cwiseInverse().sum();
        return aggregate == Aggregate::worst          ? worst
               : aggregate == Aggregate::mean_inverse ? harmonic
                                                      : std::sqrt(worst * harmonic);
      };
      const auto least_margin = [&](const Eigen::VectorXd& x) {
        double least = infinity;
        for (const Limit& limit : p.limits) least = std::min(least, hand::margin(p, limit, x));
        return least;
      };
      for (const Candidate& c : r.candidates) {
        CHECK((c.feasible() && c.stationary()));
        CHECK(least_margin(c.variables) >= -1e-8);
        const Eigen::VectorXd kappa = conditions(c.variables);
        REQUIRE(c.conditions.size() == 3);
        CHECK(matrix_error(Eigen::VectorXd::Map(c.conditions.data(), 3), kappa) <= 1e-12);
        CHECK(relative_error(c.objective, objective(kappa)) <= 1e-12);
        CHECK(std::all_of(c.prices.begin(), c.prices.end(), [](const auto& price) { return price.second > 0.0; }));
      }
      Random random(154);
      const Candidate& best = r.candidates.front();
      int tried = 0;
      for (int n = 0; n < cases(20'000); ++n) {
        const double reach = random.log_uniform(1e-5, 0.1);
        Eigen::VectorXd x = best.variables;
        for (Eigen::Index k = 0; k < x.size(); ++k) {
          x[k] += reach * std::max(0.3, std::abs(x[k])) * random.normal();
          if (k < 9)
            x[k] = std::clamp(x[k], p.variables[static_cast<std::size_t>(k)].low,
                              p.variables[static_cast<std::size_t>(k)].high);
        }
        if (!(x[8] < x[7]) || least_margin(x) < 0.0) continue;
        ++tried;
        CHECK(objective(conditions(x)) >= best.objective * (1.0 - 1e-7));
      }
      CHECK(tried > cases(50));
    }
  }

  TEST_CASE("a warm start at an optimum keeps it") {
    const Candidate best = optimize(paper_study()).candidates.at(0);
    const Result r = optimize(paper_study(), {.starts = 1, .seed = 7, .warm = {best.variables}});
    REQUIRE(r.status == Status::optimal);
    CHECK(r.candidates.front().objective <= best.objective * (1.0 + 1e-12));
    CHECK((r.candidates.front().variables - best.variables).cwiseAbs().maxCoeff() <= 1e-6);
    CHECK(r.starts_done == 2);
    CHECK(refuses("warm", [&] { optimize(paper_study(), {.warm = {Eigen::VectorXd::Ones(6)}}); }));
  }

  TEST_CASE("shadow prices: per cent of the objective when a limit is relaxed by one per cent") {
    const auto objective = [](double limit) {
      Problem p = paper_study();
      p.limits.front().high = limit;
      return optimize(p).candidates.at(0).objective;
    };
    const Candidate best = optimize(paper_study()).candidates.at(0);
    REQUIRE(best.prices.contains("radius_ratio"));
    const double slope = (std::log(objective(2.0 * 0.999)) - std::log(objective(2.0 * 1.001))) / 0.002;
    CHECK(best.prices.at("radius_ratio") == doctest::Approx(slope).epsilon(1e-3));
  }

  TEST_CASE("millimetres or metres: the same design") {
    Problem metres = paper_study(), millimetres = metres;
    for (std::size_t k = 0; k < 6; ++k) {
      millimetres.variables[k].low *= 1000.0;
      millimetres.variables[k].high *= 1000.0;
    }
    millimetres.characteristic_length.value *= 1000.0;
    const Result one = optimize(metres), thousand = optimize(millimetres);
    REQUIRE(one.status == Status::optimal);
    REQUIRE(thousand.status == Status::optimal);
    CHECK(relative_error(thousand.candidates.front().condition_number, one.candidates.front().condition_number) <=
          1e-12);
    for (Eigen::Index k = 0; k < 6; ++k)
      CHECK(std::abs(thousand.candidates.front().variables[k] / 1000.0 - one.candidates.front().variables[k]) <= 1e-6);
  }

  TEST_CASE("other seeds and numbers of starts find the same optimum") {
    for (const std::uint64_t seed : {1ULL, 2ULL, 99ULL, 18446744073709551615ULL}) {
      if (sanitized && seed < 99) continue;
      for (const int starts : {1, 3, 16}) {
        const Result r = optimize(paper_study(), {.starts = starts, .seed = seed});
        REQUIRE(r.status == Status::optimal);
        CHECK(std::abs(r.candidates.front().condition_number - paper_optimum) <= 1e-6);
      }
    }
  }

  TEST_CASE("candidates are distinct, and account for the starts that passed") {
    Problem p = open_study(3.1623, 31.623);
    const Result r = optimize(p);
    REQUIRE(r.candidates.size() >= 2);  // two valleys: 4.1026 and 4.1555
    int reached = 0;
    for (std::size_t k = 0; k < r.candidates.size(); ++k) {
      reached += r.candidates[k].reached;
      for (std::size_t i = 0; i < k; ++i)
        CHECK((r.candidates[k].variables - r.candidates[i].variables).cwiseAbs().maxCoeff() > 1e-3);
    }
    CHECK(reached <= r.starts_done);
  }
}
