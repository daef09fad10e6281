/// rule_fit.hpp: a rule for O is nearly as good as the best O, keeps the limits, and is certified. Oracle: condition
/// numbers and leg lengths at poses drawn from the region, and difference quotients.

#include "ninedof/optimize/rule_fit.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "ninedof/conditioning/conditioning.hpp"
#include "ninedof/math/error.hpp"
#include "ninedof/problem/problem.hpp"
#include "ninedof/robot/legs.hpp"
#include "optimize/rule/minimax_fit.hpp"
#include "optimize/rule/rule_samples.hpp"
#include "support/support.hpp"

using namespace ninedof;
using namespace support;

namespace {

constexpr double degree = pi / 180.0;

Problem hexagonal_problem(const std::vector<Limit>& limits, double length) {
  Problem out;
  for (const auto& v : design_family(out.family).variables()) out.variables.push_back({v.low, v.high});
  out.limits = limits;
  out.characteristic_length.value = length;
  return out;
}

/// Sides a1, a2, b1, b2, then zp, zs and theta_z.
RuleTask task_of(const Eigen::VectorXd& x, const Region& region, const std::vector<Limit>& limits, double length,
                 double goal) {
  return {{Geometry::hexagonal(x[0], x[1], x[2], x[3]), neutral(x[4], x[5], x[6]), length, {region}, {}, {}},
          hexagonal_problem(limits, length),
          x,
          {std::log(goal), {}},
          {}};
}

/// In a plane, where the best O is far from O shifted.
RuleTask small_task(const std::vector<Limit>& limits = {}) {
  Region region;
  region.size = {0.2, 0.2, 0.0};
  return task_of(Eigen::VectorXd{{1.0, 0.8, 0.5, 0.6, 2.0, 1.0, 0.6}}, region, limits, 1.0, 20.3);
}

/// The machine of examples/18_requirement, in millimetres.
RuleTask requirement() {
  Region region;
  region.size = {60.0, 60.0, 40.0};
  region.tilt = 10.0 * degree;
  RuleTask out = task_of(Eigen::VectorXd{{0.0, 850.0, 292.90821, 0.0, 483.34702, 319.32469, 0.0}}, region,
                         {{.name = "stroke_ratio", .high = 1.4},
                          {.name = "base_cone", .high = 45.0 * degree},
                          {.name = "platform_cone", .high = 45.0 * degree},
                          {.name = "leg_clearance", .low = 20.0}},
                         150.0, 3.8868);
  for (const std::size_t side_of_no_length : {0, 3}) out.problem.variables[side_of_no_length] = {0.0, 0.0};
  return out;
}

Configuration posed(const PosedRobot& machine, const Vec6& at) {
  Configuration c = machine.neutral;
  const double unit = machine.region.front().in_zp ? c.position.z() : 1.0;
  c.position += unit * at.head<3>();
  const Vec3 tilt(at[3], at[4], 0.0);
  const Mat3 turn = Eigen::AngleAxisd(tilt.norm(), tilt.normalized()).toRotationMatrix();
  c.rotation = turn * Eigen::AngleAxisd(at[5], Vec3::UnitZ()).toRotationMatrix() * c.rotation;
  return c;
}

Vec3 shift_by(const PointRule& rule, const Vec6& x) {
  Vec3 out = Vec3::Zero();
  for (std::size_t m = 0; m < rule.powers.size(); ++m) {
    double product = 1.0;
    for (std::size_t k = 0; k < 6; ++k) {
      const auto n = static_cast<Eigen::Index>(k);
      product *= std::pow(x[n] / rule.scale[n], rule.powers[m][k]);
    }
    out += product * rule.coefficients[m];
  }
  return out;
}

/// The worst condition number and stroke ratio of internal legs at poses of a box, with O placed by a function.
template <class Place>
std::pair<double, double> worst(const PosedRobot& machine, const Place& place) {
  Random random(3);
  double condition = 0.0;
  Vec9 longest = Vec9::Zero(), shortest = Vec9::Constant(infinity);
  for (int n = 0; n < cases(5000); ++n) {
    const Region& region = machine.region.front();
    const Vec6 at = region.nearest(random.matrix<Vec6>().cwiseProduct(region.reach()));
    Configuration c = posed(machine, at);
    c.internal_point += place(at);
    condition = std::max(condition, condition_number(machine.geometry, c, machine.characteristic_length));
    longest = longest.cwiseMax(leg_lengths(machine.geometry, c));
    shortest = shortest.cwiseMin(leg_lengths(machine.geometry, c));
  }
  return {condition, longest.cwiseQuotient(shortest).tail<6>().maxCoeff()};
}

}  // namespace

TEST_SUITE("rule_fit") {
  TEST_CASE("the machine of a requirement: a rule is fitted and certified") {
    if (sanitized) return;  // minutes
    const RuleTask task = requirement();
    const PointRule rule = fit_rule(task);
    const auto [condition, stroke] = worst(task.machine, [&](const Vec6& at) { return shift_by(rule, at); });
    CHECK(condition <= 1.01 * 3.8868);  // the worst of the best O, by optimize
    CHECK(condition < worst(task.machine, [](const Vec6& at) -> Vec3 { return at.head<3>(); }).first);
    CHECK(stroke <= 1.4);
    PosedRobot machine = task.machine;
    machine.rule = {rule};
    const LimitsOverPoses found =
        limits_over_poses(machine, task.problem.limits, exempt_pairs(task.problem), 1e-6, {.seconds = 20.0});
    for (const LimitOverPoses& one : found.limits) {
      CAPTURE(one.name);
      CHECK(one.answer == LimitOverPoses::Answer::proved);
    }
    const Extreme proved = worst_condition(machine, {.seconds = 60.0, .gap = 0.3}).extreme;
    CHECK(proved.low <= 1.01 * 3.8868);
    CHECK(proved.high >= condition);
    CHECK(proved.high <= 1.31 * proved.low);
  }

  TEST_CASE("a rule keeps to a stroke that binds, and does not depend on the number of threads") {
    const RuleTask task = small_task({{.name = "stroke_ratio", .high = 1.14}});
    std::vector<std::string> phases;
    const RuleSettings settings{1, [&](const std::string& words) { phases.push_back(words); }};
    const PointRule rule = fit_rule(task, settings);
    if (!sanitized) {  // which cut proofs short
      const PointRule twice = fit_rule(task, {2, {}});
      CHECK(rule.powers == twice.powers);
      CHECK(rule.coefficients == twice.coefficients);
    }
    REQUIRE(phases.size() > 2);
    CHECK(phases[0].starts_with("placing O at "));
    CHECK(phases[1] == "fitting a rule for O of degree 1");
    CHECK(std::ranges::count(phases, "checking the rule for O, round 1 of at most 8") == 1);
    const auto by_rule = worst(task.machine, [&](const Vec6& at) { return shift_by(rule, at); });
    const auto shifted = worst(task.machine, [](const Vec6& at) -> Vec3 { return at.head<3>(); });
    CHECK(by_rule.second <= 1.14);
    CHECK(shifted.second > 1.14);
    CHECK(by_rule.first < shifted.first);
  }

  TEST_CASE("a stop ends a fit in each of its phases, and a task that does not fit is named") {
    const RuleTask task = small_task();
    for (const char* phase : {"placing", "fitting", "checking"}) {
      if (sanitized && phase == std::string("placing")) continue;
      std::stop_source source;
      const auto stop = [&](const std::string& words) {
        if (words.starts_with(phase)) source.request_stop();
      };
      CHECK_THROWS_AS(fit_rule(task, {1, stop}, {source.get_token(), {}}), Stopped);
    }
    RuleTask bad = task;
    bad.machine.region.clear();
    CHECK_THROWS_WITH_AS(fit_rule(bad), doctest::Contains("machine: got one without a region"), InvalidArgument);
  }

  TEST_CASE("rows with O at given places: their numbers by definition, their slopes by differences") {
    const RuleTask task = small_task({{.name = "lower_length", .low = 0.9, .high = 2.0}});
    const PosedRobot& machine = task.machine;
    Region region = machine.region.front();
    region.shifted = false;
    PlacementGoal goal{1.5, {{"", Vec9::Constant(-0.2), Vec9::Constant(0.3), 1.0, true}}};
    goal.ranges.push_back({"", Vec9::Constant(0.4), Vec9::Constant(0.9), 2.5, false});
    Random random(8);
    const auto rows_at = [&](const Vec6& at, const Vec3& shift) {
      return placed_rows(task.problem, region, task.variables, goal, {{at, shift}}).front();
    };
    for (int n = 0; n < cases(40); ++n) {
      const Vec6 at = region.nearest(random.matrix<Vec6>());
      const Vec3 shift = 0.1 * random.matrix<Vec3>();
      Configuration c = posed(machine, at);
      c.internal_point += 2.0 * shift;
      const PlacedRows rows = rows_at(at, shift);
      CHECK(rows.value.head(rows.of_index).maxCoeff() ==
            doctest::Approx(std::log(condition_number(machine.geometry, c)) - 1.5));
      const Vec9 length = leg_lengths(machine.geometry, c);
      for (Eigen::Index leg = 0; leg < 9; ++leg) {
        const Eigen::Index k = rows.first_of_range + 2 * leg;
        CHECK(rows.value[k] == doctest::Approx(std::log(length[leg]) - 0.3));
        CHECK(rows.value[k + 1] == doctest::Approx(-0.2 - std::log(length[leg])));
        CHECK(rows.value[k + 18] == doctest::Approx(length[leg] / 2.5 - 0.9));
        CHECK(rows.value[k + 19] == doctest::Approx(0.4 - length[leg] / 2.5));
      }
      constexpr double step = 1e-6;
      for (Eigen::Index axis = 0; axis < 3; ++axis) {
        const Vec3 way = step * Vec3::Unit(axis);
        const Eigen::VectorXd slope = (rows_at(at, shift + way).value - rows_at(at, shift - way).value) / (2.0 * step);
        for (Eigen::Index k = 0; k < slope.size(); ++k)
          CHECK(std::abs(rows.by_shift(k, axis) - slope[k]) <= 1e-5 * (1.0 + std::abs(slope[k])));
      }
    }
  }

  TEST_CASE("weighted rows: limits that O has no part in are left out, middles have their derivatives") {
    const RuleTask task = small_task({{.name = "external_length", .high = 9.0},
                                      {.name = "leg_ratio", .high = 3.0},
                                      {.name = "stroke", .high = 0.3, .of = Unit::zp}});
    const Control control;
    const RuleRows rows(task, 1, control);
    REQUIRE(rows.middle_count() == 10);
    const Placed place{task.machine.region.front().nearest({0.1, -0.1, 0.0, 0.0, 0.0, 0.0}), {0.02, -0.03, 0.05}};
    const Eigen::VectorXd middles = rows.middles({place});
    const Vec9 length = [&] {
      Configuration c = posed(task.machine, place.at);
      c.internal_point += 2.0 * place.shift;
      return leg_lengths(task.machine.geometry, c);
    }();
    CHECK(middles[0] == doctest::Approx(0.5 * std::log(length.maxCoeff() * length.minCoeff())));
    for (Eigen::Index leg = 0; leg < 9; ++leg) CHECK(middles[1 + leg] == doctest::Approx(length[leg] / 0.6));
    const auto at = [&](const Eigen::VectorXd& m) { return rows.at({place}, m).front(); };
    const PlacedRows here = at(middles);
    int left_out = 0, with_middle = 0;
    for (Eigen::Index row = 0; row < here.value.size(); ++row) {
      left_out += here.value[row] == -infinity;
      const auto [middle, by] = rows.middle_of(here, row);
      if (middle < 0 || here.value[row] == -infinity) continue;
      ++with_middle;
      const Eigen::VectorXd way = 1e-6 * Eigen::VectorXd::Unit(10, middle);
      CHECK(by == doctest::Approx((at(middles + way).value[row] - at(middles - way).value[row]) / 2e-6));
    }
    CHECK(left_out == 3 + 2 * 3);  // lengths and strokes of the external legs
    CHECK(with_middle == 18 + 2 * 6);  // all legs have one middle of their ratio
  }

  TEST_CASE("each lowering leaves the worst row no higher than its smoothing allows") {
    const RuleTask task = small_task({{.name = "stroke_ratio", .high = 1.14}});
    const Control control;
    const RuleRows rows(task, 1, control);
    const std::vector<Placed> best = rows.best(first_rule_poses(task.machine.region.front()));
    MinimaxFit fit(rows, {{}, {1, 0, 0, 0, 0, 0}, {0, 1, 0, 0, 0, 0}}, best);
    const double before = fit.worst();
    for (const double smoothing : {1e-2, 1e-3}) fit.lower(smoothing);
    CHECK(fit.worst() < before);
    const double after = fit.worst();
    fit.join({});  // the worst of a dense sample can only be worse
    CHECK(fit.worst() >= after);
  }

  TEST_CASE("coordinates of poses that a proof has met") {
    Region region;
    region.shape = Region::Shape::path;
    region.corners = {{0.0, 0.0, 0.0}, {0.1, 0.1, 0.0}, {0.1, 0.1, 0.0}, {0.1, -0.05, 0.02}};
    region.tilt = 0.3;
    Random random(4);
    for (int n = 0; n < cases(200); ++n) {
      Vec6 at;
      at << random.uniform(-1.0, 1.0), 0.0, 0.0, 0.1, -0.2, 0.0;
      MetAt met;
      met.shift = 2.5 * region.pose(at).position;
      met.tilt = {0.1, -0.2, 0.0};
      CHECK((region_coordinates(region, 2.5, met) - at).norm() < 1e-12);
    }
    region.shape = Region::Shape::box;
    CHECK(region_coordinates(region, 2.0, {{0.2, 0.4, -0.6}, {0.1, 0.2, 0.0}, 0.3, -1}) ==
          (Vec6() << 0.1, 0.2, -0.3, 0.1, 0.2, 0.3).finished());
  }
}
