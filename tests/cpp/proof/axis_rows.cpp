/// axis_pieces.hpp, axis_rows.hpp: against the closed form of the values, its dual numbers, and samples of boxes.

#include "proof/optimum/axis_rows.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <random>

#include "math/numbers.hpp"
#include "ninedof/conditioning/symmetric.hpp"
#include "ninedof/problem/problem.hpp"
#include "proof/checker/blocks.hpp"
#include "proof/optimum/box_bound.hpp"
#include "support/support.hpp"

using namespace ninedof;
using namespace ninedof::proof;

namespace {

using Point = std::array<double, coordinates>;

/// The design of a point, with l_c = 1, over a number type; x(k) is a coordinate.
template <class T, class X>
AxisSpectrum<T> closed_form(const X& x) {
  using std::cos;
  using std::sin;
  const T U = x(at_size), o = x(at_share), tau = x(at_angle), none(0.0);
  const T c = (1.0 - square(tau)) / (1.0 + square(tau)), s = 2.0 * tau / (1.0 + square(tau));
  const T zp = x(at_height) * U;
  // The internal joints at angles that must not matter.
  const T y = x(at_lower) * U, z = x(at_upper) * U;
  const AxisDesign<T> d{{x(at_ratio) * U, none, none},
                        {y * std::cos(0.7), y * std::sin(0.7), none},
                        {U * c, U * s, none},
                        {z * std::cos(2.9), z * std::sin(2.9), none},
                        zp,
                        zp * o / (1.0 + o)};
  return axis_spectrum(d, T(1.0));
}

std::array<double, rows> logarithms(const Point& p) {
  const AxisSpectrum<double> s = closed_form<double>([&](std::size_t k) { return p[k]; });
  const double U = p[at_size];
  return {std::log(s.axial_max),      std::log(s.axial_min),
          std::log(s.transverse_max), std::log(s.transverse_min),
          std::log(s.l / U),          std::log(s.q / U),
          std::log(s.r / U),          std::log(U * p[at_ratio]),
          std::log(U * p[at_height]), std::log(U * p[at_height] / (1.0 + 1.0 / p[at_share])),
          std::log(U * p[at_lower]),  std::log(U * p[at_upper])};
}

/// The number that U / l_c is, by the library's characteristic length of the design.
double size_by_library(const Point& p, LengthKind kind) {
  const double t = p[at_share] / (1.0 + p[at_share]);
  Problem study;
  study.family = "symmetric";
  study.variables.assign(9, {0.0, 1e3});
  study.characteristic_length = {StudyLength::Choice::kind, 1.0, kind, {}};
  Eigen::VectorXd x(9);
  x << p[at_ratio], p[at_lower], 0.7, 1.0, 2.0 * std::atan(p[at_angle]), p[at_upper], 2.9, p[at_height],
      p[at_height] * t;
  return 1.0 / characteristic_length(study, x);
}

/// The point of a chart in the coordinates of the plain one.
Point plain(Point p, const Chart& chart) {
  if (chart.slopes) {
    const double t = std::clamp(p[at_share] - 1.0, 1e-9, 1.0 - 1e-9);
    p[at_share] = t / (1.0 - t);
    p[at_lower] *= t;
    p[at_upper] *= 1.0 - t;
  }
  if (chart.hexagonal()) p[at_lower] = p[at_ratio], p[at_upper] = 1.0;
  if (chart.length) p[at_size] = size_by_library(p, *chart.length);
  return p;
}

const std::vector<Chart> charts = [] {
  std::vector<Chart> out;
  for (const auto& length : {std::optional<LengthKind>{}, std::optional(LengthKind::mean_leg),
                             std::optional(LengthKind::platform_radius), std::optional(LengthKind::natural)})
    for (const Chart& one : {Chart{hexagonal_coordinates, false, length}, Chart{coordinates, false, length},
                             Chart{coordinates, true, length}})
      out.push_back(one);
  return out;
}();

class PointDraws {
 public:
  double log_uniform(double low, double high) { return low * std::pow(high / low, part_(engine_)); }
  Point point() {
    return {log_uniform(0.1, 20.0),  log_uniform(0.2, 8.0),  log_uniform(0.1, 8.0), log_uniform(0.05, 20.0),
            log_uniform(0.02, 40.0), log_uniform(0.05, 5.0), log_uniform(0.05, 5.0)};
  }
  double part() { return part_(engine_); }

 private:
  std::mt19937_64 engine_{20261123};
  std::uniform_real_distribution<double> part_{0.0, 1.0};
};

Box box_about(const Point& p, double factor, PointDraws& random) {
  Box box;
  for (std::size_t k = 0; k < coordinates; ++k) {
    const double f = 1.0 + factor * random.part();
    box[k] = {p[k] / f, p[k] * f};
  }
  return box;
}

Box hexagonal(Box box) {
  box[at_lower] = box[at_ratio];
  box[at_upper] = 1.0;
  return box;
}

/// A box about a point of a chart; of 1 + t it may reach to the ends, where internal joints meet the axis.
Box box_in(const Chart& chart, Point p, double factor, PointDraws& random) {
  if (chart.slopes) p[at_share] = 1.0 + random.part();
  Box box = box_about(p, factor, random);
  if (chart.slopes) box[at_share] = {std::max(box[at_share].lo, 1.0), std::min(box[at_share].hi, 2.0)};
  if (chart.hexagonal()) box = hexagonal(box);
  if (chart.length) box[at_size] = {0.0, infinity};
  settle(box, chart);
  return box;
}

Point inside(const Box& box, PointDraws& random) {
  Point p;
  for (std::size_t k = 0; k < coordinates; ++k) {
    const double part = random.part();
    p[k] = part < 0.2 ? box[k].lo : part > 0.8 ? box[k].hi : box[k].lo * std::pow(box[k].hi / box[k].lo, random.part());
  }
  return p;
}

RowLimits legs_within(double ratio) {
  RowLimits out;
  out.log_leg_ratio = std::log(ratio);
  return out;
}

double condition_number(const std::array<double, rows>& v) {
  return std::exp(std::max(v[axial_max], v[transverse_max]) - std::min(v[axial_min], v[transverse_min]));
}

}  // namespace

TEST_SUITE("axis_rows") {
  TEST_CASE("the reduced formulas have the values of the closed form") {
    PointDraws random;
    for (int i = 0; i < 2000; ++i) {
      const Point p = random.point();
      Box box;
      std::ranges::copy(p, box.begin());
      const Values found = axis_values(axis_pieces(box));
      const auto expected = logarithms(p);
      for (std::size_t r = 0; r < first_size; ++r) {
        INFO("row " << r << ", design " << i);
        // Where singular values meet, neither formula is good to more than the square root of the rounding.
        CHECK(middle(found[r]) == doctest::Approx(expected[r]).epsilon(1e-9).scale(1.0));
        CHECK(width(found[r]) < 1e-7);
      }
    }
  }

  TEST_CASE("values and slopes over a box enclose those of its designs") {
    PointDraws random;
    for (const double factor : {0.01, 0.3, 2.0})
      for (int i = 0; i < 150; ++i) {
        const Box box = box_about(random.point(), factor, random);
        const AxisPieces<Interval> pieces = axis_pieces(box);
        const Values values = axis_values(pieces);
        const auto slopes = axis_slopes(box, pieces, {});
        for (int j = 0; j < 8; ++j) {
          const Point p = inside(box, random);
          const auto at = logarithms(p);
          using D = Dual<coordinates>;
          const AxisSpectrum<D> s =
              closed_form<D>([&](std::size_t k) { return D::variable(p[k], static_cast<int>(k)); });
          const std::array<const D*, 4> four{&s.axial_max, &s.axial_min, &s.transverse_max, &s.transverse_min};
          constexpr double slack = 1e-9;  // of the closed form in doubles
          for (std::size_t r = 0; r < first_size; ++r)
            CHECK((values[r].lo - slack <= at[r] && at[r] <= values[r].hi + slack));
          for (std::size_t r = 0; r < 4; ++r)
            for (std::size_t k = 0; k < coordinates; ++k) {
              const double slope = p[k] * four[r]->gradient[k] / four[r]->value;
              INFO("row " << r << ", coordinate " << k << ": " << slope << " in " << slopes[r][k].lo << ", "
                          << slopes[r][k].hi);
              CHECK((slopes[r][k].lo - 1e-6 <= slope && slope <= slopes[r][k].hi + 1e-6));
            }
        }
      }
  }

  TEST_CASE("sizes and their slopes over a box enclose those of its designs") {
    PointDraws random;
    for (const Chart& chart : charts) {
      if (chart.length) continue;
      for (int i = 0; i < 300; ++i) {
        const Box box = box_in(chart, random.point(), i % 2 == 0 ? 0.05 : 1.0, random);
        const Sizes whole = axis_sizes(box, chart);
        const Point p = inside(box, random), q = inside(box, random);
        const auto a = logarithms(plain(p, chart)), b = logarithms(plain(q, chart));
        for (std::size_t row = first_size; row < first_size + sizes_of(chart); ++row) {
          const Interval size = box[at_size] * whole[row - first_size];
          CHECK(
              (size.lo * (1.0 - 1e-9) - 1e-7 <= std::exp(a[row]) && std::exp(a[row]) <= size.hi * (1.0 + 1e-9) + 1e-7));
          if (box[at_share].lo < 1.001 || (chart.slopes && box[at_share].hi > 1.999)) continue;
          const Slopes slopes = axis_size_slopes(box, chart, row);
          Interval change(-1e-9, 1e-9);
          for (std::size_t k = 0; k < chart.dimension; ++k) change += std::log(q[k] / p[k]) * slopes[k];
          INFO("slopes " << chart.slopes << ", dimension " << chart.dimension << ", row " << row);
          CHECK(contains(change, b[row] - a[row]));
        }
      }
    }
  }

  TEST_CASE("where the characteristic length is of a kind, U / l_c is that of the library") {
    PointDraws random;
    for (const Chart& chart : charts) {
      if (!chart.length) continue;
      for (int i = 0; i < 200; ++i) {
        const Box box = box_in(chart, random.point(), i % 2 == 0 ? 0.0 : 0.3, random);
        for (int j = 0; j < 5; ++j) {
          const double size = plain(inside(box, random), chart)[at_size];
          CHECK((box[at_size].lo * (1.0 - 1e-7) <= size && size <= box[at_size].hi * (1.0 + 1e-7)));
        }
        if (i % 2 == 0) CHECK(width(box[at_size]) < 1e-9 * box[at_size].hi);
      }
    }
  }

  TEST_CASE("no design of a box of any chart is below its bound, and small boxes lose little") {
    PointDraws random;
    for (const Chart& chart : charts)
      for (const double leg_ratio : {infinity, 2.0})
        for (const double factor : {1e-5, 0.001, 0.05, 0.5, 3.0})
          for (int i = 0; i < 40; ++i) {
            const Box box = box_in(chart, random.point(), factor, random);
            const BoxBound bound = bound_box(box, chart, 1e300, legs_within(leg_ratio));
            double least = infinity;
            for (int j = 0; j < 30; ++j) {
              const auto at = logarithms(plain(inside(box, random), chart));
              const auto [shortest, longest] = std::minmax({at[external_leg], at[upper_leg], at[lower_leg]});
              if (longest - shortest > std::log(leg_ratio)) continue;
              least = std::min(least, condition_number(at));
            }
            INFO("slopes " << chart.slopes << ", dimension " << chart.dimension << ", length "
                           << chart.length.has_value() << ", factor " << factor);
            CHECK(least >= bound.condition_number * (1.0 - 1e-7));
            if (factor < 1e-4 && leg_ratio == infinity && box[at_share].lo > 1.001 && box[at_share].hi < 1.999)
              CHECK(std::log(least / bound.condition_number) < 1e-3);
          }
  }

  /// On the straight way from the middle of such a box to a design, U / l_c may leave what is known of it.
  TEST_CASE("no design is below the bound of a box of which U / l_c is known") {
    PointDraws random;
    for (const Chart& chart : charts) {
      if (!chart.length) continue;
      checker::Domain domain;
      domain.dimension = static_cast<int>(chart.dimension);
      domain.slopes = chart.slopes;
      domain.length = *chart.length == LengthKind::natural    ? checker::Length::natural
                      : *chart.length == LengthKind::mean_leg ? checker::Length::mean_leg
                                                              : checker::Length::platform_radius;
      for (const double factor : {0.1, 0.3, 1.0, 3.0})
        for (int i = 0; i < support::cases(4000); ++i) {
          Box box = box_in(chart, random.point(), factor, random);
          for (std::size_t k = at_ratio; k < coordinates; ++k)
            if (random.part() < 0.6) box[k] = middle_of(box, k);
          box[at_size] = {0.0, infinity};
          settle(box, chart);
          const Point p = plain(inside(box, random), chart);
          box[at_size] = p[at_size] * Interval(1.0 - 1e-7, 1.0 + 1e-7);
          const double kappa = condition_number(logarithms(p));
          const BoxBound bound = bound_box(box, chart, 1e300, {});
          INFO("slopes " << chart.slopes << ", dimension " << chart.dimension << ", factor " << factor);
          CHECK(kappa >= bound.condition_number * (1.0 - 1e-7));
          checker::Box same;
          for (std::size_t k = 0; k < coordinates; ++k) same[k] = {box[k].lo, box[k].hi};
          domain.target = kappa * (1.0 + 1e-6);
          CHECK_FALSE(checker::by_combination(same, domain, {bound.combination.max, bound.combination.min}));
        }
    }
  }

  TEST_CASE("no design that keeps the limits of sizes is below the bound of its box, here and in the checker") {
    PointDraws random;
    long weighed = 0;
    for (const Chart& chart : charts) {
      if (chart.length) continue;
      for (const double factor : {1e-4, 0.01, 0.2, 1.0})
        for (int i = 0; i < 100; ++i) {
          const Box box = box_in(chart, random.point(), factor, random);
          const auto at = logarithms(plain(inside(box, random), chart));  // a design where limits are active
          RowLimits limits;
          for (std::size_t k = 0; k < sizes_of(chart); ++k) {
            if (random.part() < 0.5) continue;
            const double size = std::exp(at[first_size + k]);
            random.part() < 0.5 ? limits.size[k].hi = size : limits.size[k].lo = size;
          }
          const BoxBound bound = bound_box(box, chart, 1e300, limits);
          weighed += bound.combination.limited() ? 1 : 0;
          double least = condition_number(at);
          for (int j = 0; j < 30; ++j) {
            const auto other = logarithms(plain(inside(box, random), chart));
            bool keeps = true;
            for (std::size_t k = 0; k < sizes_of(chart); ++k)
              keeps = keeps && std::log(limits.size[k].lo) <= other[first_size + k] &&
                      other[first_size + k] <= std::log(limits.size[k].hi);
            if (keeps) least = std::min(least, condition_number(other));
          }
          INFO("slopes " << chart.slopes << ", dimension " << chart.dimension << ", factor " << factor);
          CHECK(least >= bound.condition_number * (1.0 - 1e-7));
          checker::Domain domain;
          domain.dimension = static_cast<int>(chart.dimension);
          domain.slopes = chart.slopes;
          domain.target = least * (1.0 + 1e-6);
          const std::array all{&domain.R, &domain.zp, &domain.zs, &domain.R_internal, &domain.U_internal};
          for (std::size_t k = 0; k < sizes; ++k) *all[k] = {limits.size[k].lo, limits.size[k].hi};
          checker::Box same;
          for (std::size_t k = 0; k < coordinates; ++k) same[k] = {box[k].lo, box[k].hi};
          const Combination& by = bound.combination;
          CHECK_FALSE(checker::by_combination(same, domain, {by.max, by.min, by.limits}));
          domain.target = bound.condition_number * (1.0 - 1e-3);
          const bool edge = chart.slopes && (box[at_share].lo < 1.001 || box[at_share].hi > 1.999);
          if (factor < 0.001 && bound.reason == Reason::combination && by.limited() && !edge)
            CHECK(checker::by_combination(same, domain, {by.max, by.min, by.limits}));
        }
    }
    CHECK(weighed > 200);
  }

  TEST_CASE("no design of a box is below its bound, of any kind") {
    PointDraws random;
    for (const bool hexagons : {true, false})
      for (const double leg_ratio : {infinity, 2.0})
        for (const double factor : {0.001, 0.05, 0.5, 3.0})
          for (int i = 0; i < 60; ++i) {
            Box box = box_about(random.point(), factor, random);
            if (hexagons) box = hexagonal(box);
            const std::size_t dimension = hexagons ? hexagonal_coordinates : coordinates;
            const BoxBound bound =
                bound_box(box, {.dimension = dimension, .slopes = false, .length = {}}, 1e300, legs_within(leg_ratio));
            for (int j = 0; j < 30; ++j) {
              Point p = inside(box, random);
              if (hexagons) p[at_lower] = p[at_ratio], p[at_upper] = 1.0;
              const auto at = logarithms(p);
              const auto [least, most] = std::minmax({at[external_leg], at[upper_leg], at[lower_leg]});
              if (most - least > std::log(leg_ratio)) continue;
              CHECK(condition_number(at) >= bound.condition_number * (1.0 - 1e-9));
            }
          }
  }

  TEST_CASE("a small box is bounded to the second order of its size") {
    PointDraws random;
    const auto loss = [](const Point& p, double size) {
      Box box;
      for (std::size_t k = 0; k < coordinates; ++k) box[k] = {p[k] * (1.0 - size), p[k] * (1.0 + size)};
      return std::log(condition_number(logarithms(p)) / bound_box(box, {}, 1e300, {}).condition_number);
    };
    for (int i = 0; i < 50; ++i) {
      const Point p = random.point();
      CHECK(loss(p, 1e-5) < 1e-3);  // slopes of the combination are first order where it is not stationary
    }
  }
}
