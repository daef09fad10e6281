/// Batches against the functions of one configuration, which use other algorithms.

#include "ninedof/batch/batch.hpp"

#include <doctest/doctest.h>

#include <cstdlib>
#include <cstring>
#include <vector>

#include "batch/kernels/dispatch.hpp"
#include "ninedof/conditioning/symmetric.hpp"
#include "ninedof/math/rotation.hpp"
#include "ninedof/robot/legs.hpp"
#include "ninedof/singularity/singularity.hpp"
#include "support/designs.hpp"
#include "support/support.hpp"

using namespace ninedof;
using namespace support;

namespace {

using RowMajor3 = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;

struct Stack {
  std::vector<Configuration> each;
  std::vector<double> position, rotation, internal_point;

  void add(const Configuration& c) {
    each.push_back(c);
    position.insert(position.end(), c.position.begin(), c.position.end());
    const RowMajor3 q = c.rotation;
    rotation.insert(rotation.end(), q.data(), q.data() + 9);
    internal_point.insert(internal_point.end(), c.internal_point.begin(), c.internal_point.end());
  }
  batch::Configurations view(long first, long count) const {
    return {position.data() + 3 * first, rotation.data() + 9 * first, internal_point.data() + 3 * first, count};
  }
  batch::Configurations view() const { return view(0, static_cast<long>(each.size())); }
};

Configuration some_pose(Random& random) {
  return {Vec3(0.0, 0.0, 3.0) + cube(random, 0.7), exp_rotation(cube(random, 2.5)),
          Vec3(0.0, 0.0, 1.5) + cube(random, 0.5)};
}

Stack random_stack(Random& random, int count) {
  Stack s;
  for (int k = 0; k < count; ++k) s.add(some_pose(random));
  return s;
}

constexpr double missing = std::numeric_limits<double>::quiet_NaN();

bool same_bits(const std::vector<double>& a, const std::vector<double>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0;
}

std::vector<double> conditions(const Geometry& g, const batch::Configurations& c, double lc, Norm norm = Norm::two) {
  std::vector<double> out(static_cast<std::size_t>(c.count));
  batch::condition_numbers(g, c, {&lc, 0}, norm, out.data());
  return out;
}

/// The largest error of the condition numbers of a stack, relative to the function for one configuration, over max(1,
/// kappa / 1000).
double furthest(const Geometry& g, const Stack& s) {
  const std::vector<double> kappa = conditions(g, s.view(), 1.0);
  double most = 0.0;
  for (std::size_t k = 0; k < kappa.size(); ++k) {
    const double expected = condition_number(g, s.each[k]);
    most = std::max(most, std::abs(kappa[k] / expected - 1.0) / std::max(1.0, expected / 1e3));
  }
  return most;
}

/// The error allowed for a condition number.
double allowed(double kappa) {
  return 1e-11 * std::max(1.0, kappa / 1e3);
}

}  // namespace

TEST_SUITE("batch") {
  TEST_CASE("condition numbers and singular values are those of single configurations") {
    Random random(101);
    for (int robot = 0; robot < 20; ++robot) {
      const Geometry g = random_robot(random).geometry;
      const Stack s = random_stack(random, 1000);
      const double lc = random.uniform(0.3, 3.0);
      const std::vector<double> two = conditions(g, s.view(), lc),
                                frobenius = conditions(g, s.view(), lc, Norm::frobenius);
      std::vector<double> sigma(6 * s.each.size());
      batch::singular_values(g, s.view(), {&lc, 0}, sigma.data());
      for (std::size_t k = 0; k < s.each.size(); ++k) {
        const double kappa = condition_number(g, s.each[k], lc);
        REQUIRE(std::abs(two[k] - kappa) <= allowed(kappa) * kappa);
        const double kappa_f = condition_number(g, s.each[k], lc, Norm::frobenius);
        REQUIRE(std::abs(frobenius[k] - kappa_f) <= allowed(kappa_f) * kappa_f);
        const Vec6 expected = singular_values(g, s.each[k], lc);
        for (Eigen::Index j = 0; j < 6; ++j)
          REQUIRE(std::abs(sigma[6 * k + static_cast<std::size_t>(j)] - expected[j]) <= allowed(kappa) * expected[j]);
      }
    }
  }

  TEST_CASE("down to the singularity") {
    // O approaches the plane of the lower joints, and the platform rotates towards a singularity.
    const Geometry g = Geometry::hexagonal(1.0, 4.0, 2.0, 0.5);
    Stack s;
    for (int k = 0; k <= 160; ++k) {
      const double near = std::pow(10.0, -0.1 * k);
      s.add({Vec3(0.1, 0.2, 3.0), exp_rotation(Vec3(0.1, 0.05, 0.2)), Vec3(0.05, -0.1, near)});
      s.add({Vec3(0.1, 0.2, 3.0), exp_rotation(Vec3(0.1, 0.05, 0.2)), Vec3(0.05, -0.1, 0.0)});
    }
    const std::vector<double> kappa = conditions(g, s.view(), 1.0);
    for (std::size_t k = 0; k < kappa.size(); ++k) {
      const double expected = condition_number(g, s.each[k]);
      if (k % 2 == 1) CHECK(kappa[k] == infinity);
      else if (std::isinf(expected)) CHECK(kappa[k] == infinity);
      else CHECK(std::abs(kappa[k] - expected) <= allowed(expected) * expected);
    }
    CHECK(kappa[180] > 1e8);  // the stack does come close to a singularity
  }

  TEST_CASE("on the axis, where singular values come in pairs") {
    const Geometry g = Geometry::hexagonal(0.0, 5.8124, 2.9062, 0.0);
    Stack s;
    for (int k = 1; k < 400; ++k) s.add(neutral(3.9828, 0.0099 * k, 0.0));
    const std::vector<double> kappa = conditions(g, s.view(), 1.0);
    std::vector<double> sigma(6 * s.each.size());
    const double one = 1.0;
    batch::singular_values(g, s.view(), {&one, 0}, sigma.data());
    for (std::size_t k = 0; k < s.each.size(); ++k) {
      const AxisSpectrum<double> a = axis_spectrum(axis_design(g, s.each[k]), 1.0);
      const double high = std::max(a.axial_max, a.transverse_max), low = std::min(a.axial_min, a.transverse_min);
      CHECK(kappa[k] == doctest::Approx(high / low).epsilon(1e-13));
      CHECK(sigma[6 * k] == doctest::Approx(1.0 / low).epsilon(1e-13));
      CHECK(sigma[6 * k + 5] == doctest::Approx(1.0 / high).epsilon(1e-13));
    }
  }

  TEST_CASE("spectra with one dominant singular value, where the first bound is nearly a root") {
    Random random(110);
    double most = 0.0;
    for (int robot = 0; robot < 60; ++robot) {
      const double side = random.log_uniform(1.0, 20.0);
      const Geometry g = robot == 0 ? Geometry::hexagonal(17.76, 5.55, 2.478, 15.9)
                                    : Geometry::hexagonal(side, side * random.uniform(0.1, 0.6),
                                                          random.uniform(0.5, 5.0), random.uniform(5.0, 20.0));
      Stack s;
      for (int k = 0; k < 300; ++k) {
        const double zp = random.log_uniform(0.5, 20.0);
        Configuration c = neutral(zp, zp * random.uniform(0.02, 0.98), 0.0);
        if (k % 2 == 0) c.position += 1e-4 * cube(random, 1.0);
        s.add(c);
      }
      most = std::max(most, furthest(g, s));
    }
    CHECK(most < 2e-13);
  }

  TEST_CASE("extreme singular values that nearly coincide with others") {
    // On the axis of a threefold symmetric robot they come in pairs; a displacement of O splits them by about
    // the same relative amount.
    Random random(111);
    double most = 0.0;
    int close = 0;
    for (int robot = 0; robot < 40; ++robot) {
      const Geometry g = Geometry::hexagonal(random.uniform(0.0, 3.0), random.uniform(3.0, 8.0),
                                             random.uniform(1.0, 4.0), random.uniform(0.0, 1.0));
      Stack s;
      for (double aside = 1.0; aside > 1e-17; aside *= 0.5) {
        Configuration c = neutral(random.uniform(2.0, 6.0), random.uniform(0.5, 1.9), random.uniform(-0.3, 0.3));
        c.position += aside * cube(random, 1.0);
        c.internal_point += aside * cube(random, 1.0);
        s.add(c);
      }
      most = std::max(most, furthest(g, s));
      for (const Configuration& c : s.each) {
        const Vec6 sigma = singular_values(g, c);
        close += sigma[1] > (1.0 - 1e-6) * sigma[0] || sigma[5] > (1.0 - 1e-6) * sigma[4];
      }
    }
    CHECK(close > 500);
    CHECK(most < 2e-13);
  }

  TEST_CASE("the condition number is the ratio of the singular values, found by another algorithm") {
    Random random(112);
    double most = 0.0;
    int seen = 0;
    for (int robot = 0; robot < 20; ++robot) {
      const Geometry g = random_robot(random).geometry;
      const Stack s = random_stack(random, 1000);
      const std::vector<double> kappa = conditions(g, s.view(), 1.0);
      std::vector<double> sigma(6000);
      const double one = 1.0;
      batch::singular_values(g, s.view(), {&one, 0}, sigma.data());
      for (std::size_t k = 0; k < kappa.size(); ++k) {
        if (!(kappa[k] < 15.0)) continue;
        ++seen;
        most = std::max(most, std::abs(kappa[k] / (sigma[6 * k] / sigma[6 * k + 5]) - 1.0));
      }
    }
    CHECK(seen > 500);
    CHECK(most < 3e-14);
  }

  TEST_CASE("a result depends on its own configuration alone") {
    Random random(102);
    const Geometry g = random_robot(random).geometry;
    Stack s = random_stack(random, 301);
    s.add(neutral(3.0, 0.0, 0.0));
    const std::vector<double> whole = conditions(g, s.view(), 1.1);
    for (const long part : {1L, 7L, 63L, 64L, 65L, 200L}) {
      std::vector<double> cut;
      for (long first = 0; first < s.view().count; first += part) {
        const std::vector<double> piece = conditions(g, s.view(first, std::min(part, s.view().count - first)), 1.1);
        cut.insert(cut.end(), piece.begin(), piece.end());
      }
      CHECK(same_bits(whole, cut));
    }
  }

  TEST_CASE("NaN affects its own configuration only") {
    Random random(103);
    const Geometry g = random_robot(random).geometry;
    const Stack s = random_stack(random, 40);
    const std::vector<double> whole = conditions(g, s.view(), 1.0);
    for (std::size_t bad = 0; bad < 40; bad += 3) {
      Stack t = s;
      (bad % 2 == 0   ? t.position[3 * bad + 1]
       : bad % 3 == 0 ? t.rotation[9 * bad + 4]
                      : t.internal_point[3 * bad]) = missing;
      const double one = 1.0;
      std::vector<double> sigma(240), margins(120), lengths(360);
      const std::vector<double> kappa = conditions(g, t.view(), 1.0);
      batch::singular_values(g, t.view(), {&one, 0}, sigma.data());
      batch::singularity_margins(g, t.view(), margins.data());
      batch::leg_lengths(g, t.view(), lengths.data());
      for (std::size_t k = 0; k < 40; ++k) {
        CHECK(std::isnan(kappa[k]) == (k == bad));
        if (k != bad) CHECK(kappa[k] == whole[k]);
        CHECK(std::isnan(sigma[6 * k + 5]) == (k == bad));
        CHECK(std::isnan(margins[3 * k]) == (k == bad));
        const auto first = lengths.begin() + static_cast<std::ptrdiff_t>(9 * k);
        CHECK(std::any_of(first, first + 9, [](double x) { return std::isnan(x); }) == (k == bad));
      }
    }
  }

  TEST_CASE("leg lengths and singularity margins") {
    Random random(104);
    for (const double size : {1.0, 1e-60, 1e60}) {
      const Geometry unit = random_robot(random).geometry;
      const auto scaled = [&](Triple t) {
        for (Vec3& x : t) x *= size;
        return t;
      };
      const Geometry g(scaled(unit.base_external()), scaled(unit.base_internal()), scaled(unit.platform_external()),
                       scaled(unit.platform_internal()));
      Stack s;
      for (int k = 0; k < 500; ++k) {
        Configuration c = some_pose(random);
        c.position *= size;
        c.internal_point *= size;
        if (k % 50 == 0) c.internal_point = g.base_internal()[1];  // a leg of zero length
        if (k % 50 == 1) c.internal_point = c.position + c.rotation * g.platform_external()[2];  // O in a joint
        if (k % 50 == 2) c.internal_point = g.base_external()[0] * (1.0 + 1e-15);
        s.add(c);
      }
      std::vector<double> lengths(9 * 500), margins(3 * 500);
      batch::leg_lengths(g, s.view(), lengths.data());
      batch::singularity_margins(g, s.view(), margins.data());
      for (std::size_t k = 0; k < 500; ++k) {
        const Vec9 expected = leg_lengths(g, s.each[k]);
        for (std::size_t j = 0; j < 9; ++j)
          CHECK(std::abs(lengths[9 * k + j] - expected[static_cast<Eigen::Index>(j)]) <= 4e-16 * size * 10.0);
        const PerMechanism m = singularity_margins(g, s.each[k]);
        CHECK(std::abs(margins[3 * k] - m.n) <= 1e-14);
        CHECK(std::abs(margins[3 * k + 1] - m.b) <= 1e-14);
        CHECK(std::abs(margins[3 * k + 2] - m.c) <= 1e-14);
        if (k % 50 == 0) CHECK(margins[3 * k + 1] == 0.0);
        if (k % 50 == 1) CHECK(margins[3 * k] == 0.0);
      }
    }
  }

  TEST_CASE("shared positions, rotations and points") {
    Random random(105);
    const Geometry g = random_robot(random).geometry;
    const Stack s = random_stack(random, 100);
    for (int which = 0; which < 3; ++which) {
      batch::Configurations c = s.view();
      (which == 0 ? c.position_step : which == 1 ? c.rotation_step : c.internal_point_step) = 0;
      const std::vector<double> kappa = conditions(g, c, 0.7);
      Stack same;
      for (const Configuration& each : s.each)
        same.add({which == 0 ? s.each[0].position : each.position, which == 1 ? s.each[0].rotation : each.rotation,
                  which == 2 ? s.each[0].internal_point : each.internal_point});
      CHECK(same_bits(kappa, conditions(g, same.view(), 0.7)));
    }
  }

  TEST_CASE("one characteristic length per configuration, and invalid lengths") {
    Random random(106);
    const Geometry g = random_robot(random).geometry;
    const Stack s = random_stack(random, 70);
    std::vector<double> lc(70), kappa(70);
    for (double& x : lc) x = random.uniform(0.1, 10.0);
    batch::condition_numbers(g, s.view(), {lc.data(), 1}, Norm::two, kappa.data());
    for (std::size_t k = 0; k < 70; ++k) CHECK(kappa[k] == conditions(g, s.view(static_cast<long>(k), 1), lc[k])[0]);
    for (const double bad : {0.0, -1.0, missing, infinity}) {
      lc[50] = bad;
      CHECK_THROWS_AS(batch::condition_numbers(g, s.view(), {lc.data(), 1}, Norm::two, kappa.data()), InvalidArgument);
    }
    // Very different lengths: the same numbers again.
    for (const double far : {1e-6, 1e-3, 1e3, 1e6}) {
      const std::vector<double> found = conditions(g, s.view(), far);
      for (std::size_t k = 0; k < 70; ++k) {
        const double expected = condition_number(g, s.each[k], far);
        CHECK(std::abs(found[k] - expected) <= allowed(expected) * expected);
      }
    }
    batch::condition_numbers(g, s.view(0, 0), {lc.data(), 1}, Norm::two, nullptr);  // nothing to do
  }

  TEST_CASE("O far from the platform") {
    Random random(107);
    const Geometry g = random_robot(random).geometry;
    for (const double far : {1e1, 1e2, 1e4, 1e6}) {
      Stack s;
      for (int k = 0; k < 100; ++k) {
        Configuration c = some_pose(random);
        c.internal_point *= far;
        s.add(c);
      }
      const std::vector<double> found = conditions(g, s.view(), 1.0);
      for (std::size_t k = 0; k < 100; ++k) {
        const double expected = condition_number(g, s.each[k]);
        CHECK(std::abs(found[k] - expected) <= allowed(expected) * expected);
      }
    }
  }

  TEST_CASE("hexagonal designs: the closed form against the general path") {
    Random random(108);
    std::vector<double> designs;
    const long count = 3000;
    for (long k = 0; k < count; ++k) {
      double x[6];
      for (double& y : x) y = std::exp(random.uniform(-3.0, 4.0));
      if (k % 10 == 0) x[static_cast<std::size_t>(k / 10 % 4)] = 0.0;
      designs.insert(designs.end(), x, x + 6);
    }
    std::vector<double> found(static_cast<std::size_t>(count));
    batch::hexagonal_condition_numbers(designs.data(), count, found.data());
    for (std::size_t k = 0; k < static_cast<std::size_t>(count); ++k) {
      const double* x = designs.data() + 6 * k;
      const double expected = condition_number(Geometry::hexagonal(x[0], x[1], x[2], x[3]), neutral(x[4], x[5], 0.0));
      if (std::isinf(expected)) continue;
      CHECK(std::abs(found[k] - expected) <= allowed(expected) * expected);
    }
    const double odd[] = {0.0,     0.0,    1.0, 1.0,    3.0,   2.0, /* no base */ 1.0,
                          1.0,     1.0,    1.0, 3.0,    0.0, /* O in the base */
                          missing, 1.0,    1.0, 1.0,    3.0,   2.0, 0.0,
                          5.8124,  2.9062, 0.0, 3.9828, 2.3745};
    batch::hexagonal_condition_numbers(odd, 4, found.data());
    CHECK(found[0] == infinity);
    CHECK(found[1] == infinity);
    CHECK(std::isnan(found[2]));
    CHECK(found[3] == doctest::Approx(3.9110).epsilon(1e-5));
  }

  TEST_CASE("the same bits on every level") {
    Random random(109);
    const Geometry g = random_robot(random).geometry;
    Stack s = random_stack(random, 500);
    for (int k = 0; k < 20; ++k) s.add(neutral(3.0, 0.15 * k, 0.0));
    std::vector<double> designs(6 * s.each.size());
    for (double& x : designs) x = random.log_uniform(0.01, 100.0);
    const double lc = 1.7;
    kernels::Block b{};
    const auto copy = [](const Triple& t, double (&to)[3][3]) {
      for (std::size_t i = 0; i < 3; ++i) std::copy(t[i].begin(), t[i].end(), to[i]);
    };
    copy(g.base_external(), b.robot.base_external);
    copy(g.base_internal(), b.robot.base_internal);
    copy(g.platform_external(), b.robot.platform_external);
    copy(g.platform_internal(), b.robot.platform_internal);
    b.position = s.position.data();
    b.rotation = s.rotation.data();
    b.internal_point = s.internal_point.data();
    b.length = &lc;
    b.position_step = b.internal_point_step = 3;
    b.rotation_step = 9;
    b.count = s.view().count;
    const auto rows = s.each.size();
    const auto all = [&](const kernels::Table& t) {
      std::vector<std::vector<double>> out;
      for (const auto& [kernel, width] : {std::pair{t.leg_lengths, 9UL},
                                          {t.condition_numbers, 1UL},
                                          {t.frobenius_condition_numbers, 1UL},
                                          {t.singular_values, 6UL},
                                          {t.singularity_margins, 3UL}}) {
        out.emplace_back(rows * width);
        kernel(b, out.back().data());
      }
      out.emplace_back(rows);
      t.hexagonal_condition_numbers(designs.data(), b.count, out.back().data());
      return out;
    };
    const kernels::Table* base = kernels::table_of("base");
    REQUIRE(base != nullptr);
    const auto expected = all(*base);
    int levels = 1;
    for (const char* level : {"v3", "v4"})
      if (const kernels::Table* t = kernels::table_of(level)) {
        const auto found = all(*t);
        for (std::size_t k = 0; k < found.size(); ++k) {
          CAPTURE(level);
          CAPTURE(k);
          CHECK(same_bits(found[k], expected[k]));
        }
        ++levels;
      }
    CHECK(kernels::table_of("v9") == nullptr);
    // Few rows were recomputed by the accurate path: the kernels did compute.
    CHECK(std::count(expected[1].begin(), expected[1].end(), kernels::unsure) < 20);
    CHECK(std::count(expected[3].begin(), expected[3].end(), kernels::unsure) < 20);
    MESSAGE("levels here: ", levels);
  }

  TEST_CASE("the requested level is in use") {
    const char* forced = std::getenv("NINEDOF_SIMD");
    if (forced != nullptr && *forced != '\0') CHECK(std::string(batch::simd_level()) == forced);
    CHECK(std::string("base v3 v4").find(batch::simd_level()) != std::string::npos);
  }
}
