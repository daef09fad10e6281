/// limits.hpp and the constraints of the library's sources: margins against the same taken by hand from joints,
/// legs and poses (hand.hpp), gradients of every row against differences, for every constraint there is.

#include <doctest/doctest.h>

#include <algorithm>

#include "ninedof/limits/numbers.hpp"
#include "ninedof/optimize/evaluate.hpp"
#include "optimize/minimax/design_evaluation.hpp"
#include "support/designs.hpp"
#include "support/hand.hpp"

using namespace ninedof;
using namespace designs;

namespace {

/// A study of three poses, one of them with s chosen by the optimizer, or of many.
Problem study(const std::string& family, const std::vector<Limit>& limits, bool displaced, int many = 0) {
  Problem p;
  p.family = family;
  for (const auto& v : design_family(family).variables()) p.variables.push_back({v.low, v.high});
  p.limits = limits;
  if (displaced)
    p.objective.poses = {{.position = {0.1, 0.05, -0.04}, .rotation = {0.05, -0.12, 0.1}, .in_zp = true},
                         {.position = {-0.2, 0.3, 0.1}, .internal = {0.02, 0.1, 0.05}},
                         {.position = {0.0, -0.3, 0.0}, .rotation = {0.15, 0.0, -0.05}, .best_internal = true}};
  for (int k = 0; k < many; ++k)
    p.objective.poses.push_back({.position = {0.03 * k, -0.02 * k, 0.1 - 0.02 * k}, .rotation = {0.0, 0.02 * k, 0.01}});
  return p;
}

const std::vector<Limit> listed = hand::every_limit();

const ConstraintInfo& row_of(const Limit& limit) {
  static const std::vector<ConstraintInfo> table = constraint_table();
  return *std::ranges::find_if(table, [&](const ConstraintInfo& row) { return row.name == limit.name; });
}

bool is_cone(const Limit& limit) {
  return row_of(limit).kind == LimitKind::angle;
}

/// Whether a limit is about differences of poses: it has no meaning at one pose.
bool compares_poses(const Limit& limit) {
  return row_of(limit).compares_poses || (is_cone(limit) && limit.axis.isZero(0.0));
}

/// Those at all poses, and at the neutral pose alone.
const std::vector<Limit> limits = [] {
  std::vector<Limit> out = listed;
  for (Limit limit : listed) {
    if (compares_poses(limit)) continue;
    limit.at = LimitAt::neutral;
    out.push_back(limit);
  }
  return out;
}();

bool is_over_lengths(const Limit& limit) {
  const std::vector<std::string> names = limits_over_lengths();
  return std::ranges::find(names, limit.name) != names.end();
}

bool has_side(const std::string& name, bool low) {
  try {
    if (low) Limit{.name = name, .low = 0.5, .duty = hand::duty()}.validate();
    else Limit{.name = name, .high = 0.5, .duty = hand::duty()}.validate();
    return true;
  } catch (const InvalidArgument&) {
    return false;
  }
}

}  // namespace

TEST_SUITE("constraints") {
  TEST_CASE("the smallest margin of every limit, by hand, at the neutral pose alone and over displaced ones") {
    Random random(131);
    int kept = 0, broken = 0;
    for (const std::string& family : families)
      for (const Limit& limit : limits)
        for (int n = 0; n < cases(20); ++n) {
          CAPTURE(family);
          CAPTURE(limit.name);
          Problem p = study(family, {limit}, n % 2 == 1);
          Eigen::VectorXd x = random_full(p, random);
          if (family == "general")  // all joints free: by default they are held at plates that share some
            for (Bounds& b : p.variables) b = {std::min(b.low, 0.5), std::max(b.high, 9.0)};
          if (family == "hexagonal" && n % 5 == 0) {  // joints in one place, in every design of the study
            x[0] = x[3] = 0.0;
            p.variables[0] = p.variables[3] = {0.0, 0.0};
          }
          const Evaluation e = evaluate(p, x);
          REQUIRE(e.margins.size() == 1);
          CHECK(e.margins.front().name == limit.label());
          const double expected = hand::margin(p, limit, x);
          // acos is blunt next to 1.
          const double tolerance = is_cone(limit) && limit.axis.isZero(0.0) ? 1e-7 : 1e-12;
          if (std::isinf(expected)) CHECK(e.margins.front().value > 1e3);  // every leg shares a joint
          else CHECK(std::abs(e.margins.front().value - expected) <= tolerance * std::max(1.0, std::abs(expected)));
          ++(expected >= 0.0 ? kept : broken);
        }
    CHECK(kept > cases(200));
    CHECK(broken > cases(200));
  }

  TEST_CASE(
      "every row's gradient against differences, every variable of every family: rows to look at, rows to solve") {
    Random random(132);
    int combination = 0;
    for (const std::string& family : families)
      for (const Limit& limit : limits)
        for (const bool displaced : {false, true})
          for (const bool solve : {false, true}) {
            if (sanitized && combination++ % 9 != 0) continue;  // of every family, limit and way some
            CAPTURE(family);
            CAPTURE(limit.name);
            CAPTURE(displaced);
            CAPTURE(solve);
            // Over many poses the solver's rows have auxiliary variables.
            Problem problem =
                study(family, {limit}, displaced, solve && displaced && row_of(limit).compares_poses ? 8 : 0);
            if (family == "general")
              for (std::size_t k = 0; k < 36; ++k) problem.variables[k] = {-20.0, 20.0};
            const PreparedProblem p = solve ? PreparedProblem(problem, 1e4) : PreparedProblem(problem);
            const Eigen::VectorXd x = random_full(p.problem, random);
            const Eigen::VectorXd y = p.with_auxiliary(p.coordinates.coordinates(x));
            CHECK((p.auxiliary_count > 0) == (solve && displaced && limit.at == LimitAt::poses &&
                                              limit.high < infinity && is_over_lengths(limit)));
            DesignEvaluation design, there;
            evaluate_design(p, y, design);
            REQUIRE(design.margins.size() == static_cast<Eigen::Index>(p.margins.size()));
            REQUIRE(design.margins.size() > 0);
            const auto margins = [&](const Eigen::VectorXd& at) {
              evaluate_design(p, at, there);
              return there.margins;
            };
            Eigen::Index compared = 0, kinks = 0;
            for (Eigen::Index k = 0; k < y.size(); ++k) {
              const Eigen::VectorXd fine = difference(margins, y, k, 1e-5), coarse = difference(margins, y, k, 3e-5);
              for (Eigen::Index row = 0; row < design.margins.size(); ++row) {
                // A row may change its two joints or its two legs: there the two differences part.
                const double size = std::max(1.0, std::abs(fine[row]));
                if (std::abs(fine[row] - coarse[row]) > 1e-7 * size) {
                  ++kinks;
                  continue;
                }
                ++compared;
                CAPTURE(k);
                CAPTURE(row);
                CHECK(std::abs(design.margin_gradient(row, k) - fine[row]) <= 3e-7 * size);
              }
            }
            // The neutral direction as axis of a cone, at the neutral pose: the angle is zero and has a kink
            // everywhere.
            const bool tip = is_cone(limit) && limit.axis.isZero(0.0) && !displaced;
            if (!tip) CHECK(kinks <= compared / 20);
          }
  }

  TEST_CASE("evaluate gives the gradient of the margin that is smallest") {
    Random random(133);
    for (const Limit& limit : limits) {
      CAPTURE(limit.name);
      const Problem p = study("symmetric_nonplanar", {limit}, true);
      const PreparedProblem all(p);
      const Eigen::VectorXd x = random_full(p, random);
      DesignEvaluation design;
      evaluate_design(all, x, design);
      Eigen::VectorXd shown(design.margins.size()), slopes(design.margins.size());
      for (Eigen::Index k = 0; k < shown.size(); ++k) {
        const auto [value, slope] = all.shown_margin(static_cast<int>(k), design.margins[k]);
        shown[k] = value;
        slopes[k] = slope;
      }
      Eigen::Index smallest = 0;
      shown.minCoeff(&smallest);
      const Evaluation e = evaluate(p, x);
      CHECK(e.margins.front().value == shown[smallest]);
      CHECK(e.margins.front().gradient == slopes[smallest] * design.margin_gradient.row(smallest).transpose());
    }
  }

  TEST_CASE("legs that share a joint have no clearance limit; all others have") {
    Problem p = study("hexagonal", {{.name = "leg_clearance", .low = 1e-3}}, false);
    const Eigen::VectorXd coupled{{0, 5.8, 2.9, 0, 4, 2.4, 0}};
    CHECK(evaluate(p, coupled).margins.front().value == -1.0);  // sides that are free may not meet by chance
    p.variables[0] = p.variables[3] = {0.0, 0.0};
    const double value = evaluate(p, coupled).margins.front().value;
    CHECK(value == doctest::Approx(hand::margin(p, p.limits.front(), coupled)).epsilon(1e-12));
    CHECK(value > 0.0);
    Eigen::VectorXd apart = coupled;
    p.variables[0] = p.variables[3] = {1e-4, 1e-4};
    apart[0] = apart[3] = 1e-4;  // two joints next to each other are no longer one
    CHECK(evaluate(p, apart).margins.front().value < 0.0);
  }

  TEST_CASE("an open side makes no margin; both sides make the smaller one") {
    for (const ConstraintInfo& row : constraint_table()) {
      const std::string name = row.name;
      CAPTURE(name);
      Random random(134);
      Problem p = study("hexagonal", {{.name = name, .duty = hand::duty()}}, false);
      const Eigen::VectorXd x = random_full(p, random);
      CHECK(evaluate(p, x).margins.empty());
      if (row.kind == LimitKind::sign) continue;
      p.limits = {{.name = name, .low = -1.0, .duty = hand::duty()}};
      CHECK(evaluate(p, x).margins.empty());
      if (!has_side(name, true) || !has_side(name, false)) continue;
      const auto margin = [&](double low, double high) {
        p.limits = {{name, low, high}};
        return evaluate(p, x).margins.front().value;
      };
      CHECK(margin(0.9, 3.3) == std::min(margin(0.9, infinity), margin(0.0, 3.3)));
    }
  }

  TEST_CASE(
      "the solver's rows agree with the margins: repeated ones are dropped, auxiliary variables share the violation") {
    for (const Limit& limit : limits) {
      CAPTURE(limit.name);
      for (const int many : {0, 8}) {
        Problem p = study("symmetric", {limit}, true, many);
        const PreparedProblem solved(p, 1e4), evaluated(p);
        if (limit.name == "footprint" && limit.high < infinity)
          CHECK(static_cast<int>(solved.margins.size()) <
                solved.constraints.front()->rows());  // three joints of an orbit
        for (int n = 0; n < cases(20); ++n) {
          DesignEvaluation some, every;
          const Eigen::VectorXd y = solved.with_auxiliary(solved.coordinates.start(n, 3));
          evaluate_design(solved, y, some);
          evaluate_design(evaluated, solved.without_auxiliary(solved.coordinates.variables(y)), every);
          const double share = solved.auxiliary_count > 0 ? 0.5 : 1.0;
          const double expected = share * every.margins.minCoeff();
          double least = infinity;  // of this limit: O between the plates is a margin too where it is placed
          for (int k = 0; k < some.margins.size(); ++k)
            if (solved.margin_name(k) == limit.label()) least = std::min(least, some.margins[k]);
          CHECK(std::abs(least - expected) <= 1e-10 * std::max(1.0, std::abs(expected)));
        }
      }
    }
  }

  TEST_CASE("one limit at the poses and another at the neutral pose, each with its name, in either order") {
    Random random(135);
    for (const Limit& at_poses : listed) {
      CAPTURE(at_poses.name);
      Limit at_neutral = at_poses;
      at_neutral.at = LimitAt::neutral;
      if (compares_poses(at_poses)) {
        const char* option = row_of(at_poses).compares_poses ? ".at" : ".axis at neutral";
        CHECK(refuses(at_poses.name + option, [&] { at_neutral.validate(); }));
        continue;
      }
      at_neutral.steps = 900;  // of no effect: no way leads to the neutral pose
      if (at_poses.high < infinity) at_neutral.high *= 0.9;
      const Problem p = study("general", {at_poses, at_neutral}, true),
                    q = study("general", {at_neutral, at_poses}, true);
      const std::size_t steps = at_poses.name == "singularity_free" ? 3 : 1;
      for (const Problem* both : {&p, &q}) CHECK(PreparedProblem(*both).pose_specs.size() == 1 + 3 * steps);
      const Eigen::VectorXd x = random_full(p, random);
      const Evaluation e = evaluate(p, x), f = evaluate(q, x);
      REQUIRE(e.margins.size() == 2);
      REQUIRE(f.margins.size() == 2);
      CHECK(e.margins[0].name == at_poses.name);
      CHECK(e.margins[1].name == at_poses.name + " at neutral");
      for (std::size_t k = 0; k < 2; ++k) {
        CHECK(e.margins[k].name == f.margins[1 - k].name);
        CHECK(e.margins[k].value == f.margins[1 - k].value);
        CHECK(e.margins[k].gradient == f.margins[1 - k].gradient);
        CHECK(e.margins[k].value == doctest::Approx(hand::margin(p, p.limits[k], x)).epsilon(1e-9));
      }
    }
  }

  TEST_CASE("invalid limits throw, naming the argument") {
    for (const ConstraintInfo& row : constraint_table()) {
      const std::string name = row.name;
      CAPTURE(name);
      const auto refused = [&](double low, double high) {
        return refuses(name, [&] { Limit{.name = name, .low = low, .high = high, .duty = hand::duty()}.validate(); });
      };
      CHECK(refused(not_a_number, 1.0));
      CHECK(refused(0.0, not_a_number));
      CHECK(refused(2.0, 1.0));
      CHECK(refused(0.0, 0.0));
      CHECK(refused(-2.0, -1.0));
      CHECK(refused(0.0, -infinity));
      CHECK(refused(infinity, infinity));
      CHECK((has_side(name, true) || has_side(name, false)));
      CHECK(refuses(name, [&] { Limit{.name = name, .steps = 0}.validate(); }));
      CHECK((*row.needs != '\0') == refuses(name, [&] { Limit{.name = name, .low = row.default_low}.validate(); }));
      CHECK(refuses(name, [&] { Limit{.name = name, .axis = {not_a_number, 0, 1}}.validate(); }));
      if (row.kind != LimitKind::angle)
        CHECK(refuses(name, [&] { Limit{.name = name, .axis = {0, 0, 1}}.validate(); }));
      if (row.kind != LimitKind::length)
        for (const Unit of : {Unit::zp, Unit::radius})
          CHECK(refuses(name, [&] { Limit{.name = name, .of = of}.validate(); }));
    }
    for (const char* most_only :
         {"stroke", "stroke_ratio", "joint_height", "base_cone", "platform_cone", "force", "rate", "power"})
      CHECK_FALSE(has_side(most_only, true));
    for (const char* least_only : {"joint_spacing", "leg_clearance", "singularity_free"})
      CHECK_FALSE(has_side(least_only, false));
    CHECK(refuses("constraints", [] { Limit{.name = "radius", .high = 2.0}.validate(); }));
    const std::string known = message_of([] { Limit{.name = "?", .high = 2.0}.validate(); });
    for (const ConstraintInfo& row : constraint_table())
      CHECK(known.find(std::string("\"").append(row.name).append("\"")) != std::string::npos);
  }
}
