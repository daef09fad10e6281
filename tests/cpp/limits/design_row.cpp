/// The rows of the design under the law: slopes are difference quotients, intervals and forms over boxes of designs
/// hold their numbers, and both sides of a limit read the same number. A planted error in any function breaks it.

#include "limits/design_row.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "limits/law_boxes.hpp"
#include "limits/table.hpp"

using namespace law;

namespace {

using Eight = Eigen::Matrix<double, 8, 1>;

template <class V>
auto touched(const V& v) {
  using T = std::decay_t<decltype(v[0])>;
  return Touched<T>{{v[0], v[1], v[2]}, {v[3], v[4], v[5]}, v[6], v[7]};
}

int wrong_slopes(const DesignRow& row, const Eight& x, int item) {
  const DesignSlopes slopes = row.slopes(touched(x), item);
  Eight by;
  by << slopes.a, slopes.b, slopes.zp, slopes.zs;
  int out = !(std::abs(slopes.value - row.number(touched(x), item)) <= 1e-15 * (1.0 + std::abs(slopes.value)));
  for (Eigen::Index k = 0; k < 8; ++k) {
    const auto number = [&](double h) { return row.number(touched(Eight(x + h * Eight::Unit(k))), item); };
    const double quotient = (8.0 * (number(1e-4) - number(-1e-4)) - (number(2e-4) - number(-2e-4))) / 1.2e-3;
    out += !(std::abs(by[k] - quotient) <= 1e-8 * (1.0 + std::abs(quotient)));
  }
  return out;
}

/// Intervals and forms over a box about x, and the numbers in it.
int wrong_boxes(const DesignRow& row, const Eight& x, int item, double half, Random& random) {
  std::array<Interval, 8> intervals;
  std::array<DesignForm, 8> forms;
  for (std::size_t k = 0; k < 8; ++k) {
    const double at = x[static_cast<Eigen::Index>(k)];
    intervals[k] = Interval(at - half, at + half);
    forms[k] = DesignForm::coordinate(at - half, at + half, k);
  }
  const Interval all = row.enclosure(touched(intervals), item);
  const DesignForm form = row.form(touched(forms), item);
  int out = half < 1e-3 && !is_known(form);
  for (int n = 0; n < 100; ++n) {
    const Eight t = Eight::NullaryExpr([&] { return n < 50 ? random.sign() : random.uniform(-1.0, 1.0); });
    const double number = row.number(touched(Eight(x + half * t)), item);
    double value = form.c;
    for (std::size_t k = 0; k < 8; ++k) value += form.a[k] * t[static_cast<Eigen::Index>(k)];
    out += !holds(all, number) || (is_known(form) && !holds(Interval(value - form.r, value + form.r), number));
  }
  return out;
}

bool breaks_the_law(const DesignRow& row) {
  Random random(7);
  for (int n = 0; n < 20; ++n) {
    const Geometry g = random_robot(random).geometry;
    const Points at = points(g, {Vec3::Zero(), Mat3::Identity(), Vec3::Zero()});
    const Joints joints = std::span(at).first<12>();
    std::array<double, 2> read{-infinity, infinity};  // the greatest number of the high side, the least of the low one
    for (const Side side : {Side::high, Side::low})
      for (int item = 0; item < row.items(side); ++item) {
        const auto [a, b] = row.joints(joints, side, item);
        Eight x;
        x << joints[at_index(a)], joints[at_index(b)], 4.0, 2.2;
        if (wrong_slopes(row, x, item) > 0) return true;
        for (const double half : {0.0, 1e-6, 0.02, 0.2})
          if (wrong_boxes(row, x, item, half, random) > 0) return true;
        const double number = row.number(touched(x), item);
        if (side == Side::high) read[0] = std::max(read[0], number);
        else read[1] = std::min(read[1], number);
      }
    if (row.picks_widest && read[0] != read[1]) return true;
  }
  return false;
}

DesignRow sound_design;

using DesignPlant = void (*)(DesignRow&);
constexpr std::array<DesignPlant, 4> design_plants{
    [](DesignRow& row) {
      row.number = [](const Touched<double>& x, int item) { return sound_design.number(x, item) * (1.0 + 1e-6); };
    },
    [](DesignRow& row) {
      row.slopes = [](const Touched<double>& x, int item) {
        DesignSlopes out = sound_design.slopes(x, item);
        for (double* by : {&out.a.x(), &out.b.x(), &out.a.z(), &out.zp, &out.zs}) *by *= 1.0 + 1e-5;
        return out;
      };
    },
    [](DesignRow& row) {
      row.enclosure = [](const Touched<Interval>& x, int item) {
        return sound_design.enclosure(x, item) * Interval(1.0 + 1e-6);
      };
    },
    [](DesignRow& row) {
      row.form = [](const Touched<DesignForm>& x, int item) {
        return sound_design.form(x, item) * DesignForm(1.0 + 1e-6);
      };
    },
};

}  // namespace

TEST_SUITE("design_row") {
  TEST_CASE("every row of the design keeps the law, and a planted error breaks it") {
    int rows = 0;
    for (const LimitRow& row : limit_rows()) {
      if (row.design == nullptr) continue;
      ++rows;
      CAPTURE(std::string(row.info.name));
      CHECK_FALSE(breaks_the_law(*row.design));
      sound_design = *row.design;
      for (std::size_t k = 0; k < design_plants.size(); ++k) {
        CAPTURE(k);
        DesignRow wrong = sound_design;
        design_plants[k](wrong);
        CHECK(breaks_the_law(wrong));
      }
    }
    CHECK(rows >= 6);
  }

  TEST_CASE("where the widest joint counts, another one breaks the law") {
    for (const LimitRow& row : limit_rows()) {
      if (row.design == nullptr || !row.design->picks_widest) continue;
      CAPTURE(std::string(row.info.name));
      sound_design = *row.design;
      DesignRow wrong = sound_design;
      wrong.joints = [](Joints joints, Side side, int item) {
        const auto [a, b] = sound_design.joints(joints, side, item);
        return side == Side::high ? std::pair(a, b) : std::pair((a + 1) % 6, b);
      };
      CHECK(breaks_the_law(wrong));
    }
  }
}
