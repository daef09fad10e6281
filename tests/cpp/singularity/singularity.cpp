/// singularity.hpp against the matrices of eqs. (31)-(35), the neutral closed forms of the theory, the
/// extended-precision oracle, leg lengths along the motions it names, and poses that are singular by construction.

#include "ninedof/singularity/singularity.hpp"

#include <doctest/doctest.h>

#include "ninedof/conditioning/conditioning.hpp"
#include "ninedof/robot/legs.hpp"
#include "support/oracle.hpp"
#include "support/support.hpp"

using namespace ninedof;
using namespace support;

namespace {

/// A point of the plane of a triple, off its centre.
Vec3 in_plane(const Triple& t) {
  return (t[0] + t[1] + t[2]) / 3.0 + 0.31 * (t[1] - t[0]) - 0.17 * (t[2] - t[0]);
}

Robot lost(Random& random, Mechanism mechanism) {
  Robot r = random_robot(random);
  Configuration& c = r.configuration;
  const Geometry& g = r.geometry;
  if (mechanism == Mechanism::b) c.internal_point = in_plane(g.base_internal());
  if (mechanism == Mechanism::c) c.internal_point = c.position + c.rotation * in_plane(g.platform_internal());
  if (mechanism == Mechanism::n) {  // base joints moved within planes that share a line through O
    const Vec3 line = random.unit();
    Triple base;
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3 joint = c.position + c.rotation * g.platform_external()[i];
      base[i] =
          c.internal_point + random.uniform(-2.0, 2.0) * (joint - c.internal_point) + random.uniform(-2.0, 2.0) * line;
    }
    r.geometry = {base, g.base_internal(), g.platform_external(), g.platform_internal()};
  }
  return r;
}

double of(const PerMechanism& x, Mechanism mechanism) {
  return mechanism == Mechanism::n ? x.n : mechanism == Mechanism::b ? x.b : x.c;
}

Vec9 tangent(const Velocity& v) {
  Vec9 t;
  t << v.omega, v.pdot, v.sdot;
  return t;
}

/// |d_1||w_1||d_2||w_2||d_3||w_3| / (l_1 l_2 l_3).
double spread(const Robot& r) {
  const auto& [g, c] = r;
  double out = 1.0;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3 head = c.position + c.rotation * g.platform_external()[i], foot = g.base_external()[i];
    out *= (foot - c.internal_point).norm() * (head - c.internal_point).norm() / (head - foot).norm();
  }
  return out;
}

double determinant(const Eigen::MatrixXd& m) {
  return static_cast<double>(oracle::determinant(oracle::wide(m)));
}

constexpr Mechanism every[] = {Mechanism::n, Mechanism::b, Mechanism::c};

}  // namespace

TEST_SUITE("singularity") {
  TEST_CASE("margins are the determinants of B, C and F, signs and all") {
    Random random(411);
    for (int n = 0; n < 500; ++n) {
      const Robot r = random_robot(random);
      const auto& [g, c] = r;
      const double lc = random.log_uniform(0.3, 3.0);
      const VelocityMatrices v = velocity_matrices(g, c, lc);
      const PerMechanism margins = singularity_margins(g, c);
      CHECK(std::abs(margins.b - determinant(v.B)) <= 32.0 * eps);
      CHECK(std::abs(margins.c - determinant(v.C)) <= 32.0 * eps);
      const double expected = determinant(v.F) * lc * lc * lc;
      CHECK(std::abs(margins.n * spread(r) * margins.c - expected) <= 1e-13 * (spread(r) + std::abs(expected)));
    }
  }

  TEST_CASE("neutral hexagons: the closed forms of the theory, with their signs") {
    Random random(412);
    for (int n = 0; n < 500; ++n) {
      const double a1 = random.uniform(0.0, 3.0), a2 = random.uniform(0.1, 3.0);
      const double b1 = random.uniform(0.1, 3.0), b2 = random.uniform(0.0, 3.0);
      const double zp = random.uniform(0.3, 5.0), zs = random.uniform(-2.0, 7.0), rho = zp - zs;
      const Robot r{Geometry::hexagonal(a1, a2, b1, b2), neutral(zp, zs)};
      const double R2 = (a1 * a1 + a1 * a2 + a2 * a2) / 3.0, U2 = (b1 * b1 + b1 * b2 + b2 * b2) / 3.0;
      const double ru = (2.0 * a1 * b1 + a1 * b2 + a2 * b1 + 2.0 * a2 * b2) / 6.0;
      const double l = std::sqrt(R2 + U2 - 2.0 * ru + zp * zp), q = std::sqrt(U2 + rho * rho);
      const double lower = std::sqrt(R2 + zs * zs), root3 = std::numbers::sqrt3;
      const double det_n =
          -0.75 * (a2 * b1 - a1 * b2) * (rho * rho * R2 + zs * zs * U2 + 2.0 * rho * zs * ru) / (l * l * l);
      const PerMechanism margins = singularity_margins(r.geometry, r.configuration);
      CHECK(std::abs(margins.n * spread(r) - det_n) <= 64.0 * eps * (spread(r) + std::abs(det_n)));
      CHECK(std::abs(margins.c - 0.5 * root3 * rho * 3.0 * U2 / (q * q * q)) <= 32.0 * eps);
      CHECK(std::abs(margins.b + 0.5 * root3 * zs * 3.0 * R2 / (lower * lower * lower)) <= 32.0 * eps);
    }
  }

  TEST_CASE("the smallest singular values, against extended precision") {
    Random random(413);
    for (int n = 0; n < 500; ++n) {
      const Robot r = n % 4 == 0 ? random_robot(random) : lost(random, every[n % 4 - 1]);
      const auto& [g, c] = r;
      const SingularityReport report = singularity(g, c);
      oracle::Matrix m(3, 3), b(3, 3), upper(3, 3);
      const auto row = [](const Vec3& v) { return v.cast<long double>().eval(); };
      for (std::size_t i = 0; i < 3; ++i) {
        const auto k = static_cast<Eigen::Index>(i);
        const auto s = row(c.internal_point), p = row(c.position);
        const auto q = c.rotation.cast<long double>().eval();
        const Eigen::Matrix<long double, 3, 1> d = (row(g.base_external()[i]) - s).normalized();
        const Eigen::Matrix<long double, 3, 1> w = (p + q * row(g.platform_external()[i]) - s).normalized();
        m.row(k) = d.cross(w).transpose();
        b.row(k) = (s - row(g.base_internal()[i])).normalized().transpose();
        upper.row(k) = (s - p - q * row(g.platform_internal()[i])).normalized().transpose();
      }
      // Rows are off by the rounding of the coordinates, here up to ten times a leg.
      CHECK(std::abs(report.sigma.n - static_cast<double>(oracle::singular_values(m)[2])) <= 100.0 * eps);
      CHECK(std::abs(report.sigma.b - static_cast<double>(oracle::singular_values(b)[2])) <= 100.0 * eps);
      CHECK(std::abs(report.sigma.c - static_cast<double>(oracle::singular_values(upper)[2])) <= 100.0 * eps);
      CHECK(std::abs(report.margins.n - static_cast<double>(oracle::determinant(m))) <= 100.0 * eps);
      const double least = std::min({report.sigma.n, report.sigma.b, report.sigma.c});
      CHECK(of(report.sigma, report.mechanism) == least);
    }
  }

  TEST_CASE("each mechanism on purpose: named, its margin zero, the motion unnoticed by any leg to second order") {
    Random random(414);
    for (const Mechanism mechanism : every)
      for (int n = 0; n < 100; ++n) {
        const auto [g, c] = lost(random, mechanism);
        const SingularityReport report = singularity(g, c);
        CAPTURE(to_string(mechanism));
        CHECK(report.mechanism == mechanism);
        CHECK(std::abs(of(report.margins, mechanism)) <= 64.0 * eps);
        CHECK(of(report.sigma, mechanism) <= 64.0 * eps);
        CHECK(condition_number(g, c) > 1e12);
        CHECK((inverse_velocity(g, c, report.motion).norm()) <= 1e-13);
        const Vec9 motion = tangent(report.motion);
        const auto change = [&](double h) { return (leg_lengths(g, plus(c, h * motion)) - leg_lengths(g, c)).norm(); };
        CHECK(change(1e-4) <= 1e-6);  // curvatures up to 100 a length: poses close to a second mechanism
        CHECK(change(1e-5) <= 1.1e-2 * change(1e-4) + 1e-14);
        const std::vector<Vec9> all = uncontrolled_motions(g, c);
        CHECK(all.size() == 1);
        const double along = std::abs(all[0].head<3>().dot(report.motion.omega)) / report.motion.omega.norm();
        CHECK(along == doctest::Approx(all[0].head<3>().norm()).epsilon(1e-8));
        const Vec3 y = c.internal_point - c.position;
        if (mechanism != Mechanism::b) CHECK(report.motion.sdot == Vec3::Zero());
        if (mechanism == Mechanism::n) CHECK((report.motion.pdot - y.cross(report.motion.omega)).norm() <= 8.0 * eps);
        if (mechanism == Mechanism::b) {
          const Triple& t = g.base_internal();
          const Vec3 normal = (t[1] - t[0]).cross(t[2] - t[0]).normalized();
          CHECK(report.motion.sdot.cross(normal).norm() <= 1e-13);
        }
      }
  }

  TEST_CASE("away from singularities only the legs of the mechanism notice the motion, by their least singular value") {
    Random random(415);
    for (int n = 0; n < 300; ++n) {
      const auto [g, c] = random_robot(random);
      const SingularityReport report = singularity(g, c);
      const Velocity& v = report.motion;
      Vec9 rates = inverse_velocity(g, c, v);
      const Vec3 at_o = v.pdot + v.omega.cross(c.internal_point - c.position);
      double reach = 0.0;
      for (std::size_t i = 0; i < 3; ++i) {
        const Vec3 head = c.position + c.rotation * g.platform_external()[i], foot = g.base_external()[i];
        const Vec3 upper = c.position + c.rotation * g.platform_internal()[i];
        reach += (head - c.internal_point).squaredNorm() + (upper - c.internal_point).squaredNorm();
        rates[static_cast<Eigen::Index>(i)] *=
            (head - foot).norm() / (head - c.internal_point).norm() / (foot - c.internal_point).norm();
      }
      const double unit = v.omega.squaredNorm() + (at_o.squaredNorm() + v.sdot.squaredNorm()) / (reach / 6.0);
      CHECK(unit == doctest::Approx(1.0).epsilon(1e-13));
      const Eigen::Index first = report.mechanism == Mechanism::n ? 0 : report.mechanism == Mechanism::c ? 3 : 6;
      const double size = first == 0 ? v.omega.norm() : first == 3 ? at_o.norm() : v.sdot.norm();
      CHECK(rates.segment<3>(first).norm() ==
            doctest::Approx(of(report.sigma, report.mechanism) * size).epsilon(1e-11));
      rates.segment<3>(first).setZero();
      CHECK(rates.norm() <= 1e-13);
      CHECK(uncontrolled_motions(g, c).empty());
    }
  }

  TEST_CASE("as many uncontrolled motions as the matrix of rates lacks in rank; each keeps all lengths; orthonormal") {
    Random random(416);
    for (int n = 0; n < 60; ++n) {
      Robot r = lost(random, every[n % 3]);
      if (n % 2 == 0) {  // B and C together: O on the line in which the planes meet
        const Triple &low = r.geometry.base_internal(), &up = r.geometry.platform_internal();
        Configuration& c = r.configuration;
        Mat3 planes;
        planes.row(0) = (low[1] - low[0]).cross(low[2] - low[0]).transpose();
        planes.row(1) = (c.rotation * (up[1] - up[0]).cross(up[2] - up[0])).transpose();
        planes.row(2) = planes.row(0).cross(planes.row(1));
        const Vec3 heights(planes.row(0) * low[0], planes.row(1) * (c.position + c.rotation * up[0]),
                           0.1 * planes.row(2).norm());
        c.internal_point = oracle::rounded(oracle::solve(oracle::wide(planes), oracle::wide(heights)));
      }
      const auto& [g, c] = r;
      const oracle::Vector sigma = oracle::singular_values(oracle::rates(g, c));
      const std::vector<Vec9> found = uncontrolled_motions(g, c);
      CHECK(static_cast<long>(found.size()) == (sigma.array() < 1e-10L * sigma[0]).count());
      CHECK(found.size() >= 1);
      if (n % 2 == 0)
        CHECK(singularity(g, c).mechanism != Mechanism::b);  // the motion of B would lean on what is lost too
      for (const Vec9& t : found)
        CHECK(oracle::product(oracle::rates(g, c), oracle::wide(t)).norm() <= 1e-13L * sigma[0]);
    }
    // Every leg through O: three turns about O, the legs never noticing.
    const Robot r = random_robot(random);
    Triple base;
    for (std::size_t i = 0; i < 3; ++i)
      base[i] = r.configuration.internal_point -
                1.5 * (r.configuration.position + r.configuration.rotation * r.geometry.platform_external()[i] -
                       r.configuration.internal_point);
    const Geometry g(base, r.geometry.base_internal(), r.geometry.platform_external(), r.geometry.platform_internal());
    const std::vector<Vec9> turns = uncontrolled_motions(g, r.configuration);
    CHECK(turns.size() == 3);
    for (std::size_t i = 0; i < turns.size(); ++i)
      for (std::size_t j = 0; j < turns.size(); ++j)
        CHECK(std::abs(turns[i].head<3>().dot(turns[j].head<3>()) - (i == j ? 1.0 : 0.0)) <= 1e-12);
  }

  TEST_CASE("O at a joint, and legs of zero length") {
    Random random(417);
    for (int n = 0; n < 30; ++n) {
      Robot r = random_robot(random);
      Configuration& c = r.configuration;
      const std::size_t i = static_cast<std::size_t>(n % 3);
      // O at a base joint of an external leg: that leg holds no turn about O, and there is one to spare.
      c.internal_point = r.geometry.base_external()[i];
      SingularityReport report = singularity(r.geometry, c);
      CHECK(report.margins.n == 0.0);
      CHECK(report.mechanism == Mechanism::n);
      CHECK(inverse_velocity(r.geometry, c, report.motion).norm() <= 1e-13);
      CHECK(uncontrolled_motions(r.geometry, c).size() == 1);
      // A leg of zero length: lost, but not to a motion.
      c.internal_point = r.geometry.base_internal()[i];
      report = singularity(r.geometry, c);
      CHECK(report.margins.b == 0.0);
      CHECK(report.mechanism == Mechanism::b);
      CHECK(all_nan(tangent(report.motion)));
      CHECK(uncontrolled_motions(r.geometry, c).empty());
      // The same at an upper joint, where rounding leaves a residue of the leg.
      c.internal_point = c.position + c.rotation * r.geometry.platform_internal()[i];
      report = singularity(r.geometry, c);
      CHECK(report.margins.c == 0.0);
      CHECK(report.mechanism == Mechanism::c);
      CHECK(all_nan(tangent(report.motion)));
      CHECK(uncontrolled_motions(r.geometry, c).empty());
    }
  }

  TEST_CASE("length unit: the same bits for powers of two, the same motion for any") {
    Random random(418);
    for (int n = 0; n < 30; ++n) {
      const Robot r = n % 2 == 0 ? random_robot(random) : lost(random, every[n % 3]);
      const SingularityReport one = singularity(r.geometry, r.configuration);
      for (const double factor : {0x1p-20, 0x1p30}) {
        const Robot other = scaled(r, factor);
        const SingularityReport report = singularity(other.geometry, other.configuration);
        CHECK(report.margins.n == one.margins.n);
        CHECK(report.sigma.b == one.sigma.b);
        CHECK(report.mechanism == one.mechanism);
        CHECK(report.motion.omega == one.motion.omega);
        CHECK(report.motion.pdot == factor * one.motion.pdot);
      }
      for (const double factor : {1e-6, 1e6}) {
        const Robot other = scaled(r, factor);
        const PerMechanism margins = singularity_margins(other.geometry, other.configuration);
        CHECK(std::abs(margins.n - one.margins.n) <= 100.0 * eps);
        CHECK(std::abs(margins.b - one.margins.b) <= 100.0 * eps);
        CHECK(std::abs(margins.c - one.margins.c) <= 100.0 * eps);
      }
    }
  }

  TEST_CASE("NaN in, NaN out; bad arguments by name") {
    const Geometry g = Geometry::hexagonal(0, 3, 2, 0);
    Configuration c = neutral(2, 1);
    CHECK(refuses("tolerance", [&] { uncontrolled_motions(g, c, 0.0); }));
    CHECK(refuses("tolerance", [&] { uncontrolled_motions(g, c, not_a_number); }));
    c.rotation(1, 1) = not_a_number;
    const PerMechanism margins = singularity_margins(g, c);
    CHECK((std::isnan(margins.n) && std::isnan(margins.b) && std::isnan(margins.c)));
    const SingularityReport report = singularity(g, c);
    CHECK(std::isnan(report.sigma.b));
    CHECK(report.mechanism == Mechanism::none);
    CHECK(std::string(to_string(report.mechanism)).empty());
    CHECK(all_nan(tangent(report.motion)));
    CHECK(refuses("configuration", [&] { uncontrolled_motions(g, c); }));
  }
}
