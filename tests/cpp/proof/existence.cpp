/// any_admissible: whether any design of a box is inside. Oracle: the condition number and the legs of designs.

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "ninedof/conditioning/conditioning.hpp"
#include "ninedof/math/error.hpp"
#include "ninedof/proof/admissible.hpp"
#include "ninedof/proof/checker.hpp"
#include "proof/admissible/demands.hpp"
#include "support/support.hpp"

using namespace ninedof;
using namespace support;

namespace {

/// Plates of the paper's class at the heights of its optimum.
DesignQuestion plates(double condition) {
  DesignQuestion out;
  out.problem.family = "hexagonal";
  out.problem.variables = {{0.0, 0.0},       {2.0, 10.0},      {1.0, 5.0}, {0.0, 0.0},
                           {4.9752, 4.9752}, {3.1681, 3.1681}, {0.0, 0.0}};
  out.at = {0.0, 6.0, 3.0, 0.0, 4.9752, 3.1681, 0.0};
  out.varied = {1, 2};
  out.low = {2.0, 1.0};
  out.high = {10.0, 5.0};
  out.condition = condition;
  return out;
}
double index_of(double a2, double b1) {
  return condition_number(Geometry::hexagonal(0.0, a2, b1, 0.0), neutral(4.9752, 3.1681), 1.0);
}
double least_of_grid() {
  double least = 1e9;
  for (int i = 0; i <= 200; ++i)
    for (int j = 0; j <= 200; ++j) least = std::min(least, index_of(2.0 + 0.04 * i, 1.0 + 0.02 * j));
  return least;
}

}  // namespace

TEST_SUITE("existence") {
  TEST_CASE("A design that exists is one, and below the least there is none") {
    const double least = least_of_grid();
    const DesignExistence some = any_admissible(plates(1.01 * least), {});
    REQUIRE(some.state == DesignExistence::State::exists);
    CHECK(index_of(some.design[0], some.design[1]) <= 1.01 * least);
    const DesignExistence none = any_admissible(plates(0.999 * least), {});
    CHECK(none.state == DesignExistence::State::none);
    CHECK(none.open == 0);
    CHECK(none.looked_at > 1);
  }

  TEST_CASE("What excludes every design is a file that the checker replays") {
    DesignSettings settings;
    settings.keep_outside = true;
    const DesignQuestion question = plates(0.99 * least_of_grid());
    const DesignExistence none = any_admissible(question, settings);
    REQUIRE(none.state == DesignExistence::State::none);
    const checker::Verdict verdict = checker::check(design_certificate(question, none.refuted));
    CHECK(verdict.proved);
    CHECK(verdict.words.starts_with("no design of this study has a condition number below "));
    CHECK(any_admissible(question, {}).refuted.pieces.empty());
  }

  TEST_CASE("At a pose a form of second degree bounds the condition number of all designs of a box, and closely") {
    DesignQuestion question = plates(4.0);
    question.problem.variables = {{0.0, 2.0}, {4.0, 8.0}, {2.0, 4.0}, {0.0, 1.0}, {4.0, 6.0}, {2.0, 4.0}, {0.0, 0.0}};
    question.varied = {0, 1, 2, 3, 4, 5};
    question.low = {0.0, 4.0, 2.0, 0.0, 4.0, 2.0};
    question.high = {2.0, 8.0, 4.0, 1.0, 6.0, 4.0};
    Region region;
    region.size = {0.3, 0.3, 0.2};
    region.tilt = 0.2;
    question.region = {region};
    const admissible::Poses poses(question);
    const admissible::Demands demands(question);
    const auto is_condition = [](const admissible::Item& item) {
      return item.kind == admissible::Item::Kind::condition;
    };
    const admissible::Item& item = *std::ranges::find_if(demands.items, is_condition);
    std::mt19937 random(8);
    const auto within = [&](double low, double high) { return std::uniform_real_distribution(low, high)(random); };
    int broken = 0, closer = 0, boxes = 0;
    for (; boxes < 60; ++boxes) {
      admissible::DesignBox box;
      const double part = within(0.01, 0.3);
      for (std::size_t k = 0; k < question.low.size(); ++k) {
        box.low[k] = question.low[k] + within(0.0, 1.0 - part) * (question.high[k] - question.low[k]);
        box.high[k] = box.low[k] + part * (question.high[k] - question.low[k]);
      }
      over_region::Box at;
      const Vec6 pose{within(-0.3, 0.3), within(-0.3, 0.3), within(-0.2, 0.2),
                      within(-0.1, 0.1), within(-0.1, 0.1), 0.0};
      std::ranges::copy(pose, at.low.begin());
      at.high = at.low;
      const admissible::DesignsAt designs(question, poses, box);
      const admissible::Met near = designs.meet_closely(item, at), far = designs.meet(item, at);
      REQUIRE((near.known && far.known));
      closer += most_of(near.most) < most_of(far.most);
      for (int n = 0; n < 200; ++n) {
        std::array<double, 6> x;
        double plane = near.most.c;
        for (std::size_t k = 0; k < x.size(); ++k) {
          const double t = n % 2 == 0 ? within(-1.0, 1.0) : within(-1.0, 1.0) < 0.0 ? -1.0 : 1.0;
          x[k] = box.low[k] + 0.5 * (t + 1.0) * (box.high[k] - box.low[k]);
          plane += near.most.a[k] * t;
        }
        if (plane >= 0.0) continue;
        ++broken;
        const Geometry g = Geometry::hexagonal(x[0], x[1], x[2], x[3]);
        CHECK(condition_number(g, region.configuration(pose, neutral(x[4], x[5])), 1.0) > question.condition);
      }
    }
    CHECK(closer > 0.9 * boxes);
    CHECK(broken > 1000);
  }

  TEST_CASE("One design is a file too, and one that breaks its limit is refused") {
    DesignQuestion machine = plates(1.001 * index_of(6.0, 3.0));
    machine.varied = {};
    machine.low = machine.high = {};
    const checker::Verdict verdict = checker::check(machine_certificate(machine, 0.0));
    CHECK(verdict.proved);
    CHECK(verdict.words == "the machine keeps every limit at every pose");
    machine.condition = 0.999 * index_of(6.0, 3.0);
    CHECK_FALSE(checker::check(machine_certificate(machine, 0.0)).proved);
    CHECK(checker::check(machine_certificate(machine, 0.01)).proved == false);  // the slack is not of this bound
    CHECK_THROWS_AS(machine_certificate(plates(3.0), 0.0), InvalidArgument);
  }

  TEST_CASE("Without time, and where boxes may not be divided, it is undecided") {
    DesignSettings settings;
    settings.seconds = 0.0;
    const DesignExistence early = any_admissible(plates(3.0), settings);
    CHECK(early.state == DesignExistence::State::undecided);
    CHECK(early.open == 1);
    settings.seconds = 60.0;
    settings.resolution = 0.5;
    const DesignExistence coarse = any_admissible(plates(0.9999 * least_of_grid()), settings);
    CHECK(coarse.state == DesignExistence::State::undecided);
    CHECK(coarse.open > 0);
  }

  TEST_CASE("The answer does not depend on the number of threads") {
    DesignSettings one, four;
    one.threads = 1;
    four.threads = 4;
    const double condition = 0.9995 * least_of_grid();
    const DesignExistence a = any_admissible(plates(condition), one), b = any_admissible(plates(condition), four);
    CHECK(a.state == b.state);
    CHECK(a.looked_at == b.looked_at);
  }
}
