/// nonplanar/*.hpp: against the closed form of the values, limits taken from joints, and samples of boxes.

#include "proof/nonplanar/line_test.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <random>

#include "ninedof/conditioning/symmetric.hpp"
#include "proof/checker/lines.hpp"
#include "proof/nonplanar/line_domain.hpp"

using namespace ninedof;
using namespace ninedof::proof;

namespace {

/// The design of a point by its joints, at turns that must not matter.
AxisDesign<double> joints(const LinePoint<double>& x, const SidesOfO& sides) {
  const double c = std::cos(x[line::elevation]), s = std::sin(x[line::elevation]), zp = x[line::height];
  const double foot = x[line::moment] / c, zs = zp - x[line::drop];
  const auto on_line = [&](double along) { return Xyz<double>{x[line::distance], along, foot + along * s / c}; };
  Xyz<double> base = on_line(x[line::base]);
  base.z += zp;
  const double lower = x[line::lower] * x[line::lower_up], upper = x[line::upper] * x[line::upper_up];
  return {base,
          {lower * std::cos(0.7), lower * std::sin(0.7), zs - sides.lower * x[line::lower_up]},
          on_line(x[line::platform]),
          {upper * std::cos(2.9), upper * std::sin(2.9), sides.upper * x[line::upper_up] - x[line::drop]},
          zp,
          zs};
}

double kappa(const AxisDesign<double>& d) {
  const AxisSpectrum<double> s = axis_spectrum(d, 1.0);
  return std::max(s.axial_max, s.transverse_max) / std::min(s.axial_min, s.transverse_min);
}

double from_axis(const Xyz<double>& joint) {
  return std::hypot(joint.x, joint.y);
}

/// Whether the limits are kept, from the joints.
bool keeps(const AxisDesign<double>& d, const LineLimits& limits) {
  const std::array<const Xyz<double>*, 4> joint{&d.base_external, &d.base_internal, &d.platform_external,
                                                &d.platform_internal};
  std::array<double, 4> r{};
  for (std::size_t k = 0; k < 4; ++k) r[k] = from_axis(*joint[k]);
  const double base = std::max(r[0], r[1]), platform = std::max(r[2], r[3]), widest = std::max(base, platform);
  bool ok = contains(limits.zs, d.zs) && contains(limits.zp, d.zp) && contains(limits.share, d.zs / d.zp) &&
            contains(limits.radius_ratio, base / platform);
  for (std::size_t k = 0; k < 4; ++k)
    ok = ok && contains(limits.radius[k], r[k]) && contains(limits.height[k], joint[k]->z) &&
         std::abs(joint[k]->z) <= std::min(limits.joint_height, limits.joint_height_in_radius * widest);
  const AxisSpectrum<double> s = axis_spectrum(d, 1.0);
  const std::array<double, 3> leg{s.l, s.q, s.r};
  for (std::size_t k = 0; k < 3; ++k)
    ok = ok && contains(limits.length[k], leg[k]) && contains(limits.length_in_zp[k], leg[k] / d.zp);
  const auto [shortest, longest] = std::ranges::minmax(leg);
  return ok && longest <= limits.leg_ratio * shortest;
}

class RandomLines {
 public:
  double uniform(double low, double high) { return low + (high - low) * part_(engine_); }
  double log_uniform(double low, double high) { return low * std::pow(high / low, part_(engine_)); }
  LinePoint<double> point() {
    LinePoint<double> x{};
    x[line::distance] = log_uniform(0.3, 2.5);
    x[line::moment] = uniform(-1.7, 1.7);
    x[line::elevation] = uniform(0.0, 1.4);
    x[line::height] = log_uniform(0.2, 4.0);
    x[line::drop] = x[line::height] * uniform(0.05, 0.95);
    for (const auto k : {line::upper, line::lower}) x[k] = log_uniform(0.1, 2.5);
    for (const auto k : {line::platform, line::base}) x[k] = uniform(-3.0, 3.0);
    for (const auto k : {line::upper_up, line::lower_up}) x[k] = log_uniform(0.1, 3.0);
    return x;
  }
  SidesOfO sides() { return {uniform(0.0, 1.0) < 0.7 ? 1.0 : -1.0, uniform(0.0, 1.0) < 0.7 ? 1.0 : -1.0}; }
  LineBox box_about(const LinePoint<double>& x, double size) {
    LineBox out;
    for (std::size_t k = 0; k < line::coordinates; ++k) {
      const double half = size * (k == line::moment || k == line::platform || k == line::base ? 1.0 : x[k]);
      out[k] = {x[k] - half * part_(engine_), x[k] + half * part_(engine_)};
    }
    out[line::elevation] = {std::max(out[line::elevation].lo, 0.0), std::min(out[line::elevation].hi, 1.5)};
    return out;
  }
  LinePoint<double> inside(const LineBox& box) {
    LinePoint<double> x{};
    for (std::size_t k = 0; k < line::coordinates; ++k) x[k] = uniform(box[k].lo, box[k].hi);
    return x;
  }

 private:
  std::mt19937_64 engine_{20261127};
  std::uniform_real_distribution<double> part_{0.0, 1.0};
};

/// Limits that the design keeps, each by a random margin; some are none.
LineLimits limits_about(const AxisDesign<double>& d, RandomLines& random) {
  LineLimits out;
  const std::array<const Xyz<double>*, 4> joint{&d.base_external, &d.base_internal, &d.platform_external,
                                                &d.platform_internal};
  const auto about = [&](double x) { return Interval(x - random.uniform(0.0, 0.2), x + random.uniform(0.0, 0.2)); };
  double base = 0.0, platform = 0.0, high = 0.0;
  for (std::size_t k = 0; k < 4; ++k) {
    out.radius[k] = about(from_axis(*joint[k]));
    out.height[k] = about(joint[k]->z);
    high = std::max(high, std::abs(joint[k]->z));
    double& widest = k < 2 ? base : platform;
    widest = std::max(widest, from_axis(*joint[k]));
  }
  out.zp = about(d.zp);
  out.zs = about(d.zs);
  out.share = about(d.zs / d.zp);
  out.radius_ratio = about(base / platform);
  out.joint_height = about(high).hi;
  out.joint_height_in_radius = about(high / std::max(base, platform)).hi;
  const AxisSpectrum<double> s = axis_spectrum(d, 1.0);
  out.leg_ratio = about(std::max({s.l, s.q, s.r}) / std::min({s.l, s.q, s.r})).hi;
  out.length = {about(s.l), about(s.q), about(s.r)};
  out.length_in_zp = {about(s.l / d.zp), about(s.q / d.zp), about(s.r / d.zp)};
  return out;
}

/// A box about a design, limits that the design keeps, and a target near its condition number.
struct BoxAndTarget {
  LinePoint<double> x;
  SidesOfO sides;
  LineLimits limits;
  LineBox box;
  double target;
};

/// Looks at boxes of four sizes, so many of each.
template <class Look>
void look_at_boxes(RandomLines& random, int count, const Look& look) {
  for (const double size : {0.002, 0.02, 0.1, 0.3})
    for (int i = 0; i < count; ++i) {
      const LinePoint<double> x = random.point();
      const SidesOfO sides = random.sides();
      const LineLimits limits = limits_about(joints(x, sides), random);
      const LineBox box = random.box_about(x, size);
      const double target = kappa(joints(x, sides)) * (1.0 + random.uniform(-6.0, 1.0) * size);
      if (target > 1.0 && std::isfinite(target)) look(BoxAndTarget{x, sides, limits, box, target}, i);
    }
}

/// Designs of the box, its own and others, that keep the limits and are below the target.
std::vector<LinePoint<double>> below_target(const BoxAndTarget& of, RandomLines& random) {
  std::vector<LinePoint<double>> out;
  for (int j = 0; j < 30; ++j) {
    LinePoint<double> y = random.inside(of.box);
    if (j == 0) y = of.x;
    const AxisDesign<double> d = joints(y, of.sides);
    if (keeps(d, of.limits) && !(kappa(d) >= of.target * (1.0 - 1e-9))) out.push_back(y);
  }
  return out;
}

}  // namespace

TEST_SUITE("line_test") {
  TEST_CASE("six numbers decide the condition number") {
    RandomLines random;
    for (int i = 0; i < 2000; ++i) {
      const LinePoint<double> x = random.point();
      const LineBlocks<double> m = LineDesign<double>(x).blocks();
      const auto roots = [](double m11, double off, double m22) {
        const double half = 0.5 * (m11 + m22), away = std::hypot(0.5 * (m11 - m22), off);
        return std::pair((m11 * m22 - off * off) / (half + away), half + away);
      };
      const auto axial = roots(m.axial_11, m.axial_12, m.axial_22);
      const auto across = roots(m.across_11, std::hypot(m.across_re, m.across_im), m.across_22);
      const double found = std::sqrt(std::max(axial.second, across.second) / std::min(axial.first, across.first));
      CHECK(found == doctest::Approx(kappa(joints(x, random.sides()))).epsilon(1e-9));
    }
  }

  TEST_CASE("rules say which limits are kept") {
    RandomLines random;
    int kept = 0, broken = 0;
    for (int i = 0; i < 4000; ++i) {
      LinePoint<double> x = random.point();
      const SidesOfO sides = random.sides();
      const LineLimits limits = limits_about(joints(x, sides), random);
      x = random.inside(random.box_about(x, 0.03));
      const AxisDesign<double> d = joints(x, sides);
      const auto rules = LineDesign<double>(x).rules(limits, sides);
      const bool all = std::ranges::all_of(rules, [](double rule) { return rule <= 0.0; }) && contains(limits.zp, d.zp);
      CHECK(all == keeps(d, limits));
      ++(all ? kept : broken);
    }
    CHECK(kept > 50);
    CHECK(broken > 500);
  }

  TEST_CASE("forms over a box contain its designs") {
    RandomLines random;
    for (const double size : {0.001, 0.05, 0.4})
      for (int i = 0; i < 100; ++i) {
        const LinePoint<double> x = random.point();
        const SidesOfO sides = random.sides();
        const LineLimits limits = limits_about(joints(x, sides), random);
        const LineBox box = random.box_about(x, size);
        LinePoint<DesignForm> at;
        for (std::size_t k = 0; k < line::coordinates; ++k) at[k] = DesignForm::coordinate(box[k].lo, box[k].hi, k);
        const LineDesign<DesignForm> forms(at);
        const LineBlocks<DesignForm> m = forms.blocks();
        const auto rules = forms.rules(limits, sides);
        for (int j = 0; j < 10; ++j) {
          const LinePoint<double> y = random.inside(box);
          const auto holds = [&](const DesignForm& form, double value) {
            double linear = form.c;
            for (std::size_t k = 0; k < line::coordinates; ++k)
              linear += form.a[k] * (2.0 * y[k] - box[k].lo - box[k].hi) / width(box[k]);
            CHECK(!(std::abs(value - linear) > form.r + 1e-12 * (1.0 + std::abs(value))));
          };
          const LineDesign<double> design(y);
          const LineBlocks<double> n = design.blocks();
          holds(m.axial_11, n.axial_11);
          holds(m.axial_12, n.axial_12);
          holds(m.axial_22, n.axial_22);
          holds(m.across_11, n.across_11);
          holds(m.across_re, n.across_re);
          holds(m.across_im, n.across_im);
          holds(m.across_22, n.across_22);
          const auto numbers = design.rules(limits, sides);
          for (std::size_t k = 0; k < rules.size(); ++k) holds(rules[k], numbers[k]);
        }
      }
  }

  TEST_CASE("no design below the target is lost, of a box or beside what is left of it") {
    RandomLines random;
    int empty = 0, below = 0;
    look_at_boxes(random, 1500, [&](const BoxAndTarget& of, int) {
      LineBox left = of.box;
      const bool closed = test_box(left, of.limits, of.sides, of.target).empty;
      empty += closed;
      for (const LinePoint<double>& y : below_target(of, random)) {
        ++below;
        CHECK_FALSE(closed);
        for (std::size_t k = 0; k < line::coordinates; ++k) CHECK(contains(left[k], y[k]));
      }
    });
    CHECK(empty > 300);
    CHECK(below > 1000);
  }

  TEST_CASE("the checker loses no design below the target, whatever the mixture") {
    RandomLines random;
    int gone = 0, smaller = 0, below = 0;
    look_at_boxes(random, 1000, [&](const BoxAndTarget& of, int i) {
      const LineLimits& limits = of.limits;
      checker::lines::Study study;
      const auto range = [](const Interval& x) { return checker::Range(x.lo, x.hi); };
      study.target = of.target;
      for (std::size_t k = 0; k < 4; ++k) {
        study.radius[k] = range(limits.radius[k]);
        study.height[k] = range(limits.height[k]);
      }
      for (std::size_t k = 0; k < 3; ++k) {
        study.length[k] = range(limits.length[k]);
        study.length_in_zp[k] = range(limits.length_in_zp[k]);
      }
      study.zp = range(limits.zp), study.zs = range(limits.zs), study.fraction = range(limits.share);
      study.radius_ratio = range(limits.radius_ratio), study.leg_ratio = limits.leg_ratio;
      study.joint_height = limits.joint_height, study.joint_height_in_radius = limits.joint_height_in_radius;
      checker::lines::Box whole;
      for (std::size_t k = 0; k < line::coordinates; ++k) whole[k] = range(of.box[k]);
      // One vector for the greatest value and one for the least: the eigenvectors in the middle, or any.
      const LineBlocks<double> m = LineDesign<double>(of.x).blocks();
      const double turn =
          i % 2 == 0 ? random.uniform(0.0, 3.2) : 0.5 * std::atan2(2.0 * m.axial_12, m.axial_11 - m.axial_22);
      const double c = std::cos(turn), s = std::sin(turn), K2 = of.target * of.target;
      checker::lines::Mixture by;
      by.entry = {c * c - K2 * s * s, 2.0 * c * s * (1.0 + K2), s * s - K2 * c * c, 0.0, 0.0, 0.0, 0.0};
      for (std::size_t k = 0; k < 3; ++k)
        if (random.uniform(0.0, 1.0) < 0.3) by.limits.emplace_back(k, random.uniform(0.0, 2.0));
      checker::lines::Box left = whole;
      const bool kept = checker::lines::narrow(study, left, {of.sides.upper, of.sides.lower}, &by);
      gone += !kept;
      smaller += kept && left != whole;
      for (const LinePoint<double>& y : below_target(of, random)) {
        ++below;
        REQUIRE(kept);
        for (std::size_t k = 0; k < line::coordinates; ++k) CHECK((left[k].a <= y[k] && y[k] <= left[k].b));
      }
    });
    CHECK(gone > 100);
    CHECK(smaller > 100);
    CHECK(below > 500);
  }

  TEST_CASE("the first box holds every design below the target") {
    RandomLines random;
    int below = 0;
    for (int i = 0; i < 200000 && below < 300; ++i) {
      const LinePoint<double> x = random.point();
      const SidesOfO sides = random.sides();
      const AxisDesign<double> d = joints(x, sides);
      const double found = kappa(d);
      if (!(found < 4.0)) continue;
      ++below;
      const LineBox box = line_box(limits_about(d, random), found * (1.0 + 1e-9));
      for (std::size_t k = 0; k < line::coordinates; ++k) {
        INFO("coordinate " << k);
        CHECK(contains(box[k], x[k]));
      }
    }
    CHECK(below == 300);
  }
}
