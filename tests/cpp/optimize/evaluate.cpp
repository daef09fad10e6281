/// evaluate.hpp, and configurations and characteristic_length of problem.hpp: every index, aggregate and choice of
/// length against the general path at poses computed by hand (hand.hpp); gradients against differences.

#include "ninedof/optimize/evaluate.hpp"

#include <doctest/doctest.h>

#include "ninedof/conditioning/characteristic_length.hpp"
#include "ninedof/conditioning/conditioning.hpp"
#include "support/designs.hpp"
#include "support/hand.hpp"

using namespace ninedof;
using namespace designs;

namespace {

using Choice = StudyLength::Choice;

const std::vector<StudyLength> lengths{{.choice = Choice::number, .value = 1.3},
                                       {.choice = Choice::kind, .kind = LengthKind::mean_leg},
                                       {.choice = Choice::kind, .kind = LengthKind::platform_radius},
                                       {.choice = Choice::kind, .kind = LengthKind::natural},
                                       {.choice = Choice::kind, .kind = LengthKind::optimal},
                                       {.choice = Choice::free, .bounds = {0.5, 4.0}}};

/// On the axis, off it, tilted; s given and left to the optimizer; in lengths and in zp.
const std::vector<Pose> poses{{.position = {0.0, 0.0, 0.2}, .best_internal = true},
                              {.position = {0.1, -0.05, 0.0}, .in_zp = true},
                              {.rotation = {0.1, -0.2, 0.05}, .internal = {0.05, 0.0, -0.1}, .best_internal = true},
                              {.rotation = {0.0, 0.0, 0.3}, .internal = {0.0, 0.0, 0.04}, .in_zp = true}};

Problem study(const std::string& family, const StudyLength& length, const std::vector<Pose>& at) {
  Problem p;
  p.family = family;
  for (const auto& v : design_family(family).variables()) p.variables.push_back({v.low, v.high});
  p.characteristic_length = length;
  p.objective.poses = at;
  return p;
}

/// The characteristic length, by characteristic_length.hpp.
double length_by_hand(const Problem& p, const Eigen::VectorXd& x) {
  const StudyLength& l = p.characteristic_length;
  if (l.choice == Choice::number) return l.value;
  if (l.choice == Choice::free || l.kind == LengthKind::optimal)
    return x[static_cast<Eigen::Index>(p.variables.size())];
  const hand::Design d = hand::design(p, x);
  return characteristic_length(d.geometry, d.at.front(), l.kind);
}

/// The objective, from singular values of J' at every evaluated pose.
double objective_by_hand(const Problem& p, const Eigen::VectorXd& x) {
  const hand::Design d = hand::design(p, x);
  const double lc = length_by_hand(p, x);
  double worst = 0.0, inverse = 0.0, count = 0.0;
  for (const Configuration& c : d.looked()) {
    double index = 0.0;
    switch (p.objective.index) {
      case Index::frobenius: index = condition_number(d.geometry, c, lc, Norm::frobenius); break;
      case Index::speed: index = 1.0 / singular_values(d.geometry, c, lc)[5]; break;
      default: index = condition_number(d.geometry, c, lc); break;
    }
    worst = std::max(worst, index);
    inverse += 1.0 / index;
    count += 1.0;
  }
  const double harmonic = count / inverse;
  switch (p.objective.aggregate) {
    case Aggregate::worst: return worst;
    case Aggregate::mean_inverse: return harmonic;
    case Aggregate::weighted: return std::pow(worst, p.objective.weight) * std::pow(harmonic, 1.0 - p.objective.weight);
  }
  return 0.0;
}

constexpr std::array indices{Index::condition_number, Index::frobenius, Index::speed};
constexpr std::array aggregates{Aggregate::worst, Aggregate::mean_inverse, Aggregate::weighted};

}  // namespace

TEST_SUITE("evaluate") {
  TEST_CASE("the neutral configuration and every pose, by hand") {
    Random random(241);
    for (const std::string& family : families)
      for (int n = 0; n < 20; ++n) {
        const Problem p = study(family, lengths.front(), poses);
        const Eigen::VectorXd x = random_full(p, random);
        const hand::Design d = hand::design(p, x);
        const std::vector<Configuration> got = configurations(p, x);
        REQUIRE(got.size() == poses.size() + 1);
        for (std::size_t k = 0; k < got.size(); ++k) {
          CHECK((got[k].position - d.at[k].position).norm() <= 16.0 * eps);
          CHECK((got[k].internal_point - d.at[k].internal_point).norm() <= 16.0 * eps);
          CHECK((got[k].rotation - d.at[k].rotation).norm() <= 16.0 * eps);
        }
        CHECK(configurations(study(family, lengths.front(), {}), random_design(family, random)).size() == 1);
      }
  }

  TEST_CASE("values: every family, index, aggregate and length") {
    Random random(242);
    for (const std::string& family : families)
      for (const StudyLength& length : lengths)
        for (const auto& at : {std::vector<Pose>{}, poses})
          for (const Index index : indices)
            for (const Aggregate aggregate : aggregates) {
              Problem p = study(family, length, at);
              p.objective.index = index;
              p.objective.aggregate = aggregate;
              p.objective.weight = random.uniform(0.0, 1.0);
              const Eigen::VectorXd x = random_full(p, random);
              const Evaluation e = evaluate(p, x);
              CAPTURE(family);
              CAPTURE(static_cast<int>(index));
              CAPTURE(static_cast<int>(aggregate));
              const double lc = length_by_hand(p, x);
              CHECK(relative_error(e.characteristic_length, lc) <= 1e-12);
              const hand::Design d = hand::design(p, x);
              const double kappa = condition_number(d.geometry, d.at.front(), lc);
              CHECK(relative_error(e.condition_number, kappa) <= 1e-13 * kappa);
              REQUIRE(e.conditions.size() == d.looked().size());
              double most = kappa;
              for (std::size_t k = 0; k < e.conditions.size(); ++k) {
                const double there = condition_number(d.geometry, d.looked()[k], lc);
                most = std::max(most, there);
                CHECK(relative_error(e.conditions[k], there) <= 1e-13 * there);
              }
              CHECK(relative_error(std::exp(e.log_objective), objective_by_hand(p, x)) <= 1e-13 * most * most);
            }
  }

  TEST_CASE("gradients against differences: every family, index, aggregate and length") {
    Random random(243);
    int compared = 0, kinks = 0;
    for (const std::string& family : families)
      for (const StudyLength& length : lengths)
        for (const auto& at : {std::vector<Pose>{}, poses})
          for (const Index index : indices)
            for (const Aggregate aggregate : aggregates) {
              Problem p = study(family, length, at);
              p.objective.index = index;
              p.objective.aggregate = aggregate;
              p.objective.weight = 0.3;
              const Eigen::VectorXd x = random_full(p, random);
              const Eigen::VectorXd gradient = evaluate(p, x).gradient;
              REQUIRE(gradient.size() == x.size());
              const auto value = [&](const Eigen::VectorXd& y) { return std::log(objective_by_hand(p, y)); };
              for (Eigen::Index k = 0; k < x.size(); k += family == "general" ? 5 : 1) {
                const double fine = difference(value, x, k, 1e-4), coarse = difference(value, x, k, 3e-4);
                // Singular values that are about to meet part the two differences.
                if (std::abs(fine - coarse) > 1e-6 * std::max(1.0, std::abs(fine))) {
                  ++kinks;
                  continue;
                }
                ++compared;
                CAPTURE(family);
                CAPTURE(static_cast<int>(index));
                CAPTURE(static_cast<int>(aggregate));
                CAPTURE(k);
                CHECK(std::abs(gradient[k] - fine) <= 1e-6 * std::max(1.0, std::abs(fine)));
              }
            }
    CHECK(compared > 20 * kinks);
  }

  TEST_CASE("six_legged: its condition number as the objective, and the neutral one of the nine-legged robot") {
    Random random(244);
    for (const std::string& family : axis_families) {
      Problem p = study(family, lengths.front(), {});
      p.objective.index = Index::six_legged;
      const Eigen::VectorXd x = random_full(p, random);
      const Evaluation e = evaluate(p, x);
      const hand::Design d = hand::design(p, x);
      const double kappa = condition_number(d.geometry, d.at.front(), 1.3);
      CHECK(relative_error(e.condition_number, kappa) <= 1e-13 * kappa);
      AxisPoint point;
      design_family(family).axis(span(x), 1.3, {}, Machine::six_legged, point);
      const double six = std::max(point.value[0], point.value[2]) - std::min(point.value[1], point.value[3]);
      CHECK(e.log_objective == six);
      CHECK(std::abs(six - std::log(kappa)) > 1e-3);
      const auto value = [&](const Eigen::VectorXd& y) { return evaluate(p, y).log_objective; };
      for (Eigen::Index k = 0; k < x.size(); ++k)
        CHECK(std::abs(e.gradient[k] - difference(value, x, k, 1e-4)) <= 1e-7);
    }
  }

  TEST_CASE("a limit on the condition number: 1 - kappa / limit at the worst pose, with its gradient") {
    Random random(245);
    for (const std::string& family : families) {
      Problem p = study(family, lengths.front(), poses);
      p.objective.index = Index::speed;
      p.objective.condition_limit = 10.0;
      const Eigen::VectorXd x = random_full(p, random);
      const Evaluation e = evaluate(p, x);
      REQUIRE(e.margins.size() == 1);
      CHECK(e.margins.front().name == "condition_limit");
      const auto margin = [&](const Eigen::VectorXd& y) {
        const hand::Design d = hand::design(p, y);
        double worst = 0.0;
        for (const Configuration& c : d.looked()) worst = std::max(worst, condition_number(d.geometry, c, 1.3));
        return 1.0 - worst / 10.0;
      };
      const double expected = margin(x);
      CHECK(std::abs(e.margins.front().value - expected) <= 1e-12 * std::max(1.0, std::abs(expected)));
      for (Eigen::Index k = 0; k < x.size(); ++k)
        CHECK(std::abs(e.margins.front().gradient[k] - difference(margin, x, k, 1e-4)) <=
              1e-6 * std::max(1.0, std::abs(expected)));
    }
  }

  TEST_CASE("units cancel: a thousand times the robot and the length give the same numbers") {
    Random random(246);
    for (const std::string& family : families) {
      Problem p = study(family, lengths.front(), {{.position = {0.1, 0.0, 0.05}, .in_zp = true}}), big = p;
      big.characteristic_length.value *= 1000.0;
      const Eigen::VectorXd x = random_full(p, random);
      Eigen::VectorXd y = x;
      for (Eigen::Index k = 0; k < x.size(); ++k)
        if (design_family(family).variables()[static_cast<std::size_t>(k)].kind != VariableKind::angle) y[k] *= 1000.0;
      CHECK(std::abs(evaluate(big, y).log_objective - evaluate(p, x).log_objective) <= 1e-12);
    }
  }

  TEST_CASE("singular designs: large or infinite objective, finite gradients, never NaN") {
    for (const Eigen::VectorXd& x : {Eigen::VectorXd{{1, 2, 0.5, 1, 5, 3, 0}},  // similar hexagons
                                     Eigen::VectorXd{{1, 2, 1.5, 1, 5, 0, 0}},  // O in the base
                                     Eigen::VectorXd{{1, 2, 1.5, 1, 5, 5, 0}}})  // O in the platform
      for (const Index index : indices)
        for (const Aggregate aggregate : aggregates) {
          Problem p = study("hexagonal", lengths.front(), {{}, {.rotation = {0.0, 0.0, 0.1}}});
          p.objective.index = index;
          p.objective.aggregate = aggregate;
          const Evaluation e = evaluate(p, x);
          CHECK_FALSE(std::isnan(e.log_objective));
          CHECK(e.gradient.allFinite());
          if (index != Index::speed && aggregate != Aggregate::mean_inverse) CHECK(e.log_objective > std::log(1e12));
          CHECK(e.condition_number > 1e12);
        }
  }

  TEST_CASE("incomplete sets and negative lengths throw, naming the argument") {
    const Problem p = study("hexagonal", lengths.back(), {});
    const Eigen::VectorXd good{{1, 6, 3, 1, 5, 3, 0.1, 1.0}};
    CHECK(std::isfinite(evaluate(p, good).log_objective));
    CHECK(refuses("variables", [&] { evaluate(p, good.head(7)); }));
    CHECK(refuses("variables", [&] { evaluate(p, Eigen::VectorXd{}); }));
    CHECK(refuses("variables", [&] { evaluate(p, Eigen::VectorXd::Constant(8, not_a_number)); }));
    CHECK(refuses("variables", [&] { configurations(p, good.head(7)); }));
    Eigen::VectorXd bad = good;
    bad[1] = -1.0;
    CHECK(refuses("a2", [&] { evaluate(p, bad); }));
    bad = good;
    bad[7] = 0.0;
    CHECK(refuses("characteristic_length", [&] { evaluate(p, bad); }));
  }
}
