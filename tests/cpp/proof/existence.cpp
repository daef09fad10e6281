/// any_admissible: whether any design of a box is inside. Oracle: the condition number and the legs of designs.

#include <doctest/doctest.h>

#include <cmath>
#include <random>

#include "ninedof/conditioning/conditioning.hpp"
#include "ninedof/math/error.hpp"
#include "ninedof/proof/admissible.hpp"
#include "ninedof/proof/checker.hpp"
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
