/// hexapod.hpp against singular values of the six rows assembled leg by leg; gradients against differences; designs
/// whose singular values coincide or vanish.

#include "ninedof/conditioning/hexapod.hpp"

#include <doctest/doctest.h>

#include "support/axis.hpp"
#include "support/designs.hpp"
#include "support/oracle.hpp"

using namespace ninedof;
using namespace designs;

namespace {

/// Rows [u x e / l_c, e] of legs r_i-u_i and r^_i-u~_i.
Mat6 rows(const Robot& robot, double lc) {
  Mat6 h;
  const auto& [g, c] = robot;
  for (Eigen::Index i = 0; i < 6; ++i) {
    const auto k = static_cast<std::size_t>(i % 3);
    const Vec3 u = c.rotation * (i < 3 ? g.platform_external() : g.platform_internal())[k];
    const Vec3 e = (c.position + u - (i < 3 ? g.base_external() : g.base_internal())[k]).normalized();
    h.row(i) << u.cross(e).transpose() / lc, e.transpose();
  }
  return h;
}

Vec6 by_svd(const Robot& robot, double lc) {
  return oracle::rounded(oracle::singular_values(oracle::wide(rows(robot, lc))));
}

template <class T>
Eigen::Matrix<T, 4, 1> four(const HexapodSpectrum<T>& s) {
  Eigen::Matrix<T, 4, 1> out;
  out << s.axial_max, s.axial_min, s.transverse_max, s.transverse_min;
  return out;
}

Vec6 six(const HexapodSpectrum<double>& s) {
  Vec6 out;
  out << four(s), s.transverse_max, s.transverse_min;
  std::sort(out.begin(), out.end(), std::greater<>());
  return out;
}

/// Coordinates of an axis design and the characteristic length, and the four values from them.
Eigen::VectorXd numbers(const Robot& robot, double lc) {
  const axis::Flat x = axis::flat(axis_design(robot.geometry, robot.configuration));
  Eigen::VectorXd out(axis::coordinates + 1);
  std::copy(x.begin(), x.end(), out.begin());
  out[axis::coordinates] = lc;
  return out;
}
Eigen::VectorXd six_values(const Eigen::VectorXd& x) {
  axis::Flat flat;
  std::copy_n(x.begin(), flat.size(), flat.begin());
  return four(hexapod_spectrum(axis::design_of(flat), x[axis::coordinates]));
}

struct Exact {
  Eigen::Vector4d value;
  Eigen::Matrix<double, 4, axis::coordinates + 1> gradient;
};
Exact exact(const Eigen::VectorXd& x) {
  using D = Dual<axis::coordinates + 1>;
  std::array<D, axis::coordinates> variables;
  for (int k = 0; k < axis::coordinates; ++k) variables[static_cast<std::size_t>(k)] = D::variable(x[k], k);
  const HexapodSpectrum<D> s =
      hexapod_spectrum(axis::design_of(variables), D::variable(x[axis::coordinates], axis::coordinates));
  Exact out;
  int row = 0;
  for (const D* d : {&s.axial_max, &s.axial_min, &s.transverse_max, &s.transverse_min}) {
    out.value[row] = d->value;
    for (std::size_t k = 0; k <= axis::coordinates; ++k)
      out.gradient(row, static_cast<Eigen::Index>(k)) = d->gradient[k];
    ++row;
  }
  return out;
}

/// Internal legs that are mirror images of the external ones in the plane x = 0, with two equal axial singular values:
/// the axial block is [[m / l_c, e], [-m / l_c, e]], and the length is chosen so that m / l_c = e.
struct Tied {
  Robot robot;
  double lc;
};
Tied axial_tie(Random& random) {
  const Orbit base = random_orbit(random), platform = random_orbit(random);
  const auto mirrored = [](const Orbit& o) { return Orbit{o.radius, pi - o.angle, o.height}; };
  const Robot robot{Geometry::symmetric(base, mirrored(base), platform, mirrored(platform)),
                    neutral(random.uniform(3.0, 6.0), 1.0)};
  const Vec6 row = rows(robot, 1.0).row(0);
  return {robot, std::abs(row[2] / row[5])};
}

}  // namespace

TEST_SUITE("hexapod") {
  TEST_CASE("singular values of the six rows, random designs") {
    Random random(211);
    for (int n = 0; n < 1000; ++n) {
      const Robot robot = random_symmetric_robot(random);
      const double lc = random.log_uniform(0.1, 10.0);
      const Vec6 expected = by_svd(robot, lc);
      const Vec6 got = six(hexapod_spectrum(axis_design(robot.geometry, robot.configuration), lc));
      CHECK(matrix_error(got, expected) <= 32.0 * eps);
    }
  }

  TEST_CASE("near a singularity the product of all is the determinant, to the rounding errors of the rows") {
    // Similar base and platform are the classical singularity: the determinant is proportional to the deviation from
    // it.
    Random random(212);
    for (int n = 0; n < 100; ++n) {
      const double off = random.log_uniform(1e-6, 1e-2);
      const Robot robot{Geometry::hexagonal(1.0, 2.0, 0.5 + off, 1.0), neutral(3.0, 1.5, random.uniform(-0.3, 0.3))};
      const auto expected = static_cast<double>(std::abs(oracle::determinant(oracle::wide(rows(robot, 1.0)))));
      const HexapodSpectrum<double> s = hexapod_spectrum(axis_design(robot.geometry, robot.configuration), 1.0);
      const double product = s.axial_max * s.axial_min * std::pow(s.transverse_max * s.transverse_min, 2.0);
      CHECK(relative_error(product, expected) <= 64.0 * eps / off);
    }
  }

  TEST_CASE("the axis point of a family holds their logarithms") {
    Random random(213);
    for (const std::string& name : axis_families)
      for (int n = 0; n < 100; ++n) {
        const DesignFamily& family = design_family(name);
        const Eigen::VectorXd x = random_design(name, random);
        const double lc = random.log_uniform(0.3, 3.0);
        AxisPoint p;
        family.axis(span(x), lc, {}, Machine::six_legged, p);
        const Vec6 expected = by_svd({family.geometry(span(x)), family.configuration(span(x))}, lc);
        Vec6 got;
        got << p.value, p.value[AxisPoint::transverse_max], p.value[AxisPoint::transverse_min];
        std::sort(got.begin(), got.end(), std::greater<>());
        CHECK((got.array().exp().matrix() - expected).cwiseAbs().maxCoeff() <= 64.0 * eps * expected[0]);
        CHECK(p.gradient.col(family.index("zs")).isZero(0.0));  // independent of O
      }
  }

  TEST_CASE("gradients against differences, all coordinates and the characteristic length") {
    Random random(214);
    int checked = 0;
    for (int n = 0; n < 200; ++n) {
      const Eigen::VectorXd x = numbers(random_symmetric_robot(random), random.log_uniform(0.5, 2.0));
      const Exact e = exact(x);
      CHECK(matrix_error(e.value, six_values(x)) <= 8.0 * eps);
      for (int row = 0; row < 4; ++row) {
        // Away from equal pairs and from zero.
        const int pair = row / 2 * 2;
        if (e.value[pair + 1] < 0.05 * e.value[pair] || e.value[pair + 1] > 0.95 * e.value[pair]) continue;
        ++checked;
        for (Eigen::Index k = 0; k < x.size(); ++k) {
          const double expected =
              difference([&](const Eigen::VectorXd& at) { return six_values(at)[row]; }, x, k, 1e-4);
          CAPTURE(row);
          CAPTURE(k);
          CHECK(std::abs(e.gradient(row, k) - expected) <= 1e-7 * std::max(1.0, std::abs(expected)));
        }
      }
    }
    CHECK(checked > 300);
  }

  TEST_CASE("an exactly equal pair: both values correct, finite slopes whose sum is the slope of the product") {
    Random random(215);
    int tied = 0;
    for (int n = 0; n < 100; ++n) {
      const auto [robot, lc] = axial_tie(random);
      if (lc < 0.1 || lc > 10.0) continue;
      ++tied;
      const Eigen::VectorXd x = numbers(robot, lc);
      const Exact e = exact(x);
      const Vec6 expected = by_svd(robot, lc);
      CHECK(matrix_error(six(hexapod_spectrum(axis_design(robot.geometry, robot.configuration), lc)), expected) <=
            32.0 * eps);
      CHECK(relative_error(e.value[1], e.value[0]) <= 1e-7);  // the root of a rounding error
      REQUIRE(e.gradient.allFinite());
      for (Eigen::Index k = 0; k < x.size(); ++k) {
        CAPTURE(k);
        const double product =
            difference([](const Eigen::VectorXd& at) { return six_values(at)[0] * six_values(at)[1]; }, x, k, 1e-4);
        const double got = e.gradient(0, k) * e.value[1] + e.gradient(1, k) * e.value[0];
        CHECK(std::abs(got - product) <= 1e-7 * std::max(1.0, std::abs(product)));
      }
    }
    CHECK(tied > 50);
  }

  TEST_CASE("similar base and platform: singular, without NaN") {
    const Robot robot{Geometry::hexagonal(1.0, 2.0, 0.5, 1.0), neutral(3.0, 1.5)};
    const Exact e = exact(numbers(robot, 1.0));
    CHECK(e.value.minCoeff() <= 4.0 * eps);
    CHECK(e.value.maxCoeff() > 0.1);
    CHECK(e.gradient.allFinite());
    Robot flat = robot;  // a leg of zero length: base joint and platform joint coincide
    flat.geometry = Geometry(robot.geometry.base_external(), robot.geometry.base_internal(),
                             robot.geometry.base_external(), robot.geometry.platform_internal());
    flat.configuration.position.setZero();
    const Exact none = exact(numbers(flat, 1.0));
    CHECK(none.value.allFinite());
    CHECK(none.gradient.allFinite());
    CHECK(none.value.minCoeff() == 0.0);
  }
}
