/// The rows of lengths over all poses under the law: one number over every number type, measures and planes that keep
/// the limit where the number does, and stacks that are their lengths one by one. A planted error breaks it.

#include "ninedof/limits/spread_row.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "limits/table.hpp"
#include "ninedof/limits/numbers.hpp"
#include "ninedof/math/dual.hpp"
#include "support/support.hpp"

using namespace ninedof;
using namespace support;

namespace {

template <class Row>
int wrong_number(const Row& row, double longest, double shortest) {
  const double number = row.of(longest, shortest), h = 1e-6 * shortest;
  int out = number != (row.ratio ? longest / shortest : longest - shortest);
  const auto v = Dual<2>::variables(std::array{longest, shortest});
  const Dual<2> slopes = row.of(v[0], v[1]);
  const double by_longest = (row.of(longest + h, shortest) - row.of(longest - h, shortest)) / (2.0 * h);
  const double by_shortest = (row.of(longest, shortest + h) - row.of(longest, shortest - h)) / (2.0 * h);
  out += !(std::abs(slopes.value - number) <= 1e-15 * number);
  out += !(std::abs(slopes.gradient[0] - by_longest) <= 1e-7 * std::abs(by_longest));
  out += !(std::abs(slopes.gradient[1] - by_shortest) <= 1e-7 * std::abs(by_shortest));
  const double wide = 0.1 * shortest;
  const Interval all = row.of(Interval(longest - wide, longest + wide), Interval(shortest - wide, shortest + wide));
  for (const double a : {-wide, 0.0, wide})
    for (const double b : {-wide, 0.0, wide}) out += !contains(all, row.of(longest + a, shortest + b));
  const Interval open = row.of(Interval(longest), Interval(0.0, shortest));
  return out + !contains(open, number) + (row.ratio && open.hi != infinity);
}

/// The limit as the solver has it, and as planes in the lengths.
template <class Row>
int wrong_maps(const Row& row, double longest, double shortest) {
  const double number = row.of(longest, shortest);
  int out = 0;
  for (const double limit : {0.999 * number, 1.001 * number}) {
    const double size = row.ratio ? 1.7 : limit;  // of a difference the limit
    const double measure = row.measured(longest, size), h = 1e-6 * longest;
    const bool kept = number <= limit;
    out += (measure - row.measured(shortest, size) <= row.width(limit)) != kept;
    out += (longest <= row.share(limit) * shortest + (row.ratio ? 0.0 : limit)) != kept;
    out += !(std::abs(row.length(measure, size) - longest) <= 1e-14 * longest);
    const double slope = (row.measured(longest + h, size) - row.measured(longest - h, size)) / (2.0 * h);
    out += !(std::abs(slope * row.slope_over(longest, size) - 1.0) <= 1e-8);
  }
  return out;
}

template <class Row>
int wrong_stack(const Row& row, const Vec9& longest, const Vec9& shortest) {
  int out = 0;
  for (int leg = 0; leg < row.items(); ++leg) {
    double most = longest[leg], least = shortest[leg];
    for (int other = 0; !row.each_leg && other < 9; ++other) {
      most = std::max(most, longest[other]);
      least = std::min(least, shortest[other]);
    }
    out += row.number(longest, shortest, leg) != row.of(most, least);
  }
  return out + (row.items() != (row.each_leg ? 9 : 1));
}

template <class Row>
bool breaks_the_law(const Row& row) {
  Random random(9);
  int wrong = 0;
  for (int n = 0; n < 100; ++n) {
    const Vec9 shortest = random.matrix<Vec9>().cwiseAbs() + Vec9::Constant(0.5);
    const Vec9 longest = shortest + random.matrix<Vec9>().cwiseAbs() + Vec9::Constant(0.1);
    wrong += wrong_number(row, longest[0], shortest[0]) + wrong_maps(row, longest[0], shortest[0]);
    wrong += wrong_stack(row, longest, shortest);
  }
  return wrong > 0;
}

struct WrongNumber : SpreadRow {
  template <class T>
  T of(const T& longest, const T& shortest) const {
    return SpreadRow::of(longest, shortest) * T(1.0 + 1e-6);
  }
};
struct WrongMeasure : SpreadRow {
  double measured(double length, double size) const { return SpreadRow::measured(length, size) * (1.0 + 1e-2); }
};
struct WrongLength : SpreadRow {
  double length(double measure, double size) const { return SpreadRow::length(measure, size) * (1.0 + 1e-6); }
};
struct WrongSlope : SpreadRow {
  double slope_over(double length, double size) const { return SpreadRow::slope_over(length, size) * (1.0 + 1e-6); }
};
struct WrongWidth : SpreadRow {
  double width(double limit) const { return SpreadRow::width(limit) * 1.1; }
};
struct WrongShare : SpreadRow {
  double share(double limit) const { return SpreadRow::share(limit) * 1.1; }
};
struct WrongStack : SpreadRow {
  double number(const Vec9& longest, const Vec9& shortest, int leg) const {
    return SpreadRow::number(longest, shortest, leg) * (1.0 + 1e-6);
  }
};
struct WrongItems : SpreadRow {
  int items() const { return 3; }
};

}  // namespace

TEST_SUITE("spread_row") {
  TEST_CASE("a shortest length that may be 0 leaves no upper end of a ratio") {
    const Interval open = length_ratio(Interval(2.0, 3.0), Interval(0.0, 4.0));
    CHECK(open.hi == infinity);
    CHECK(open.lo <= 0.5);
    CHECK(open.lo > 0.5 - 1e-15);
    CHECK(length_ratio(3.0, 2.0) == 1.5);
  }

  TEST_CASE("every row of lengths over all poses keeps the law, and a planted error breaks it") {
    for (const std::string& name : limits_over_lengths()) {
      CAPTURE(name);
      const SpreadRow& row = spread_row(name);
      CHECK_FALSE(breaks_the_law(row));
      CHECK(breaks_the_law(WrongNumber{row}));
      CHECK(breaks_the_law(WrongMeasure{row}));
      CHECK(breaks_the_law(WrongLength{row}));
      CHECK(breaks_the_law(WrongSlope{row}));
      CHECK(breaks_the_law(WrongWidth{row}));
      CHECK(breaks_the_law(WrongShare{row}));
      CHECK(breaks_the_law(WrongStack{row}));
      CHECK(breaks_the_law(WrongItems{row}));
    }
    CHECK_THROWS_WITH_AS(spread_row("height"), doctest::Contains("height"), InvalidArgument);
  }
}
