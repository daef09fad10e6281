/// first_root.hpp: zeros of functions whose zeros are known, mainly close pairs and double zeros. enclosure.hpp:
/// against the same formulas in extended precision.

#include "math/roots/first_root.hpp"

#include <doctest/doctest.h>

#include <vector>

#include "support/support.hpp"

using namespace ninedof;
using namespace support;

namespace {

/// The polynomial of these coefficients, c[0] + c[1] t + ...
struct Polynomial {
  std::vector<double> c;

  double derivative(double t, int order, bool of_sizes = false) const {
    double sum = 0.0;
    for (std::size_t k = c.size(); k-- > static_cast<std::size_t>(order);) {
      double factor = of_sizes ? std::abs(c[k]) : c[k];
      for (int j = 0; j < order; ++j) factor *= static_cast<double>(k) - j;
      sum = sum * t + factor;
    }
    return sum;
  }

  Enclosure<double> operator()(double t, double h) const {
    Enclosure<double> out;
    const double factorial[] = {1.0, 1.0, 2.0, 6.0};
    for (int k = 0; k < 4; ++k) {
      const auto at = static_cast<std::size_t>(k);
      out.bound[at] = derivative(t + h, k, true) / factorial[k];
      if (k == 3) continue;
      out.at[at] = derivative(t, k) / factorial[k];
      out.error[at] = 16.0 * eps * derivative(t, k, true) / factorial[k];
    }
    return out;
  }
};

Polynomial with_roots(const std::vector<double>& roots) {
  Polynomial p{{1.0}};
  for (const double r : roots) {
    p.c.insert(p.c.begin(), 0.0);
    for (std::size_t k = 0; k + 1 < p.c.size(); ++k) p.c[k] -= r * p.c[k + 1];
  }
  return p;
}

FirstRoot search(const Polynomial& p, double most = 1.0) {
  return first_root(p, most, 0.1);
}

/// A vector that moves on a parabola or turns, and the same in extended precision.
using Long = Eigen::Matrix<long double, 3, 1>;
struct Curve {
  Vec3 a, b, c;
  Long at(long double t) const {
    return a.cast<long double>() + t * b.cast<long double>() + t * t * c.cast<long double>();
  }
  Enclosure<Vec3> at(double t, double h) const {
    const double sizes[] = {a.norm(), b.norm(), c.norm()};
    const double end = t + h;
    Enclosure<Vec3> out{
        {a + t * b + t * t * c, b + 2.0 * t * c, c},
        {8.0 * eps * (sizes[0] + t * sizes[1] + t * t * sizes[2]), 8.0 * eps * (sizes[1] + t * sizes[2]), 0.0},
        {sizes[0] + end * sizes[1] + end * end * sizes[2], sizes[1] + 2.0 * end * sizes[2], sizes[2], 0.0}};
    return out;
  }
};

}  // namespace

TEST_SUITE("first_root") {
  TEST_CASE("simple zeros to rounding, the first of many, of either sign") {
    Random random(401);
    for (int n = 0; n < 1000; ++n) {
      std::vector<double> roots;
      for (int k = 0; k < 4; ++k) roots.push_back(random.uniform(0.0, 1.5));
      Polynomial p = with_roots(roots);
      if (n % 2 == 0)
        for (double& c : p.c) c = -c;
      std::sort(roots.begin(), roots.end());
      const FirstRoot found = search(p);
      CHECK(found.resolved);
      if (roots[0] > 1.0) {
        CHECK(found.at == infinity);
      } else {
        double slope = 1.0;
        for (int k = 1; k < 4; ++k) slope *= roots[static_cast<std::size_t>(k)] - roots[0];
        if (slope > 1e-6) CHECK(std::abs(found.at - roots[0]) <= 200.0 * eps / slope);
      }
    }
  }

  TEST_CASE("two close zeros, a double zero, and a minimum just above zero") {
    for (const double gap : {1e-1, 1e-2, 1e-4, 1e-6, 1e-7}) {
      // 2 (t - 0.6)^2 and a gap of either sign: (t - 0.6)^2 - gap^2 has zeros at 0.6 -+ gap.
      const Polynomial crossing{{0.36 - gap * gap, -1.2, 1.0}}, missing{{0.36 + gap * gap, -1.2, 1.0}};
      const FirstRoot found = search(crossing);
      CHECK(found.resolved);
      CHECK(std::abs(found.at - (0.6 - gap)) <= 16.0 * eps / gap);
      CHECK(search(missing).at == infinity);
      CHECK(search(missing).resolved);
    }
    const FirstRoot touched = search(with_roots({0.6, 0.6}));
    CHECK(touched.resolved);
    CHECK(std::abs(touched.at - 0.6) <= 1e-7);
    const FirstRoot flat = search(with_roots({0.6, 0.6, 0.6, 0.6}));
    CHECK(flat.resolved);
    CHECK(std::abs(flat.at - 0.6) <= 1e-3);
    CHECK(std::abs(search(with_roots({0.6, 0.6, 0.6})).at - 0.6) <= 1e-4);
  }

  TEST_CASE("cubics, which attain the bound of the third derivative") {
    Random random(403);
    for (int n = 0; n < 2000; ++n) {
      const double root = random.uniform(0.01, 1.0), k = 1.0 / (root * root * root);
      const FirstRoot found = search(Polynomial{{1.0, 0.0, 0.0, -k}});
      CHECK(std::abs(found.at - root) <= 64.0 * eps * root);
    }
  }

  TEST_CASE("the ends of the interval belong to it") {
    CHECK(search(with_roots({0.0, 0.5})).at == 0.0);
    CHECK(search(with_roots({1.0})).at == doctest::Approx(1.0).epsilon(1e-14));
    CHECK(search(with_roots({1.0 + 1e-12})).at == infinity);
    CHECK(search(with_roots({0.25}), 0.25).at == 0.25);
    CHECK(search(Polynomial{{1.0}}, 1e300).at == infinity);
    CHECK(search(Polynomial{{0.0}}).at == 0.0);
  }

  TEST_CASE("an unresolved search is reported, with the interval that has no zero") {
    const auto wave = [](double t, double) {
      return Enclosure<double>{
          {1.001 + std::cos(t), -std::sin(t), -0.5 * std::cos(t)}, {1e-15, 1e-15, 1e-15}, {2.001, 1.0, 0.5, 1.0 / 6.0}};
    };
    const FirstRoot some = first_root(wave, 100.0, 1.0), most = first_root(wave, 1e6, 1.0);
    CHECK((some.resolved && some.at == infinity));
    CHECK(!most.resolved);
    CHECK((most.at > 1000.0 && most.at < 1e6));
    const FirstRoot broken = first_root(
        [](double t, double) {
          return Enclosure<double>{{t < 0.5 ? 1.0 : not_a_number, 0.0, 0.0}, {0.0, 0.0, 0.0}, {1.0, 1.0, 1.0, 1.0}};
        },
        1.0, 0.1);
    CHECK(!broken.resolved);
    CHECK((broken.at >= 0.5 && broken.at < 1.0));
  }

  TEST_CASE("lines and rotating vectors: values, errors, and bounds that hold and are nearly attained") {
    Random random(404);
    for (int n = 0; n < 300; ++n) {
      const Vec3 v = random.matrix<Vec3>(), omega = random.log_uniform(0.1, 10.0) * random.unit();
      const double t = random.uniform(0.0, 20.0), h = random.log_uniform(1e-3, 5.0), rate = omega.norm();
      const Turning turning(v, omega);
      const Line line{v, omega, v.norm()};
      const Enclosure<Vec3> turned = turning.at(t, h), shifted = line.at(t, h);
      const Long axis = omega.cast<long double>().normalized(), long_v = v.cast<long double>();
      const long double long_rate = omega.cast<long double>().norm();
      const auto exact = [&](double time) -> Long {
        return Eigen::AngleAxis<long double>(long_rate * time, axis) * long_v;
      };
      CHECK(static_cast<double>((exact(t) - turned.at[0].cast<long double>()).norm()) <= turned.error[0]);
      CHECK(turned.error[0] <= 1e-12 * (1.0 + rate * t));
      const double radius = omega.cross(v).norm() / rate;
      double sizes[4] = {0.0, 0.0, 0.0, 0.0}, far = 0.0;
      for (int k = 0; k <= 100; ++k) {
        const double time = t + h * k / 100.0;
        const Vec3 x = exact(time).cast<double>(), speed = omega.cross(x), bend = omega.cross(speed);
        const Vec3 derivatives[] = {x, speed, 0.5 * bend, omega.cross(bend) / 6.0};
        for (std::size_t i = 0; i < 4; ++i) sizes[i] = std::max(sizes[i], derivatives[i].norm());
        far = std::max(far, (v + time * omega).norm());
        if (k > 0) continue;
        for (std::size_t i = 1; i < 3; ++i)
          CHECK((derivatives[i] - turned.at[i]).norm() <= 1e-12 * std::pow(rate, i) * (1.0 + rate * t) * v.norm());
      }
      for (std::size_t i = 0; i < 4; ++i) CHECK(turned.bound[i] >= sizes[i] * (1.0 - 1e-12));
      for (std::size_t i = 1; i < 4; ++i) CHECK(turned.bound[i] <= sizes[i] * (1.0 + 1e-12));
      CHECK(turned.bound[0] <= v.norm() + rate * h * radius + 1e-12);
      CHECK(shifted.at[0] == v + t * omega);
      CHECK((shifted.bound[0] >= far * (1.0 - 1e-12) && shifted.bound[0] <= (v + t * omega).norm() + h * rate + 1e-12));
      CHECK((shifted.bound[1] == rate && shifted.bound[2] == 0.0 && shifted.bound[3] == 0.0));
    }
    const Enclosure<Vec3> still = Turning(Vec3(1, 2, 3), Vec3::Zero()).at(5.0, 7.0);
    CHECK((still.at[0] == Vec3(1, 2, 3) && still.at[1] == Vec3::Zero() && still.bound[1] == 0.0));
  }

  TEST_CASE("products and sums: values, errors and bounds over the window hold") {
    Random random(402);
    for (int n = 0; n < 200; ++n) {
      Curve x[4];
      for (Curve& curve : x) curve = {random.matrix<Vec3>(), random.matrix<Vec3>(), random.matrix<Vec3>()};
      if (n % 2 == 0) x[1].a = x[0].a * 1.25;  // a cross product that cancels
      const auto exact = [&](long double t) {
        return x[0].at(t).cross(x[1].at(t)).dot(x[2].at(t).cross(x[3].at(t)) + x[0].at(t));
      };
      const auto enclosed = [&](double t, double h) {
        return dot(cross(x[0].at(t, h), x[1].at(t, h), h), cross(x[2].at(t, h), x[3].at(t, h), h) + x[0].at(t, h), h);
      };
      const double t = random.uniform(0.0, 1.0), h = random.log_uniform(1e-4, 5.0);
      const Enclosure<double> f = enclosed(t, h);
      CHECK(std::abs(static_cast<double>(exact(t) - f.at[0])) <= f.error[0]);
      CHECK(f.error[0] <= 1e-12 * f.bound[0] + 1e-11);
      for (int k = 0; k <= 20; ++k) {
        const double x_k = t + h * k / 20.0;
        const Enclosure<double> there = enclosed(x_k, 0.0);
        for (std::size_t i = 0; i < 3; ++i) CHECK(std::abs(there.at[i]) <= f.bound[i] * (1.0 + 1e-12));
        const long double e = 1e-3L;  // differences of the exact function; it is a polynomial of degree 8
        const long double first = (exact(x_k + e) - exact(x_k - e)) / (2 * e);
        const long double second = (exact(x_k + e) - 2 * exact(x_k) + exact(x_k - e)) / (e * e);
        const double size = there.bound[0] + there.bound[1] + there.bound[2] + f.bound[3] + 100.0;
        CHECK(std::abs(static_cast<double>(first) - there.at[1]) <= 1e-4 * size);
        CHECK(std::abs(static_cast<double>(second) / 2.0 - there.at[2]) <= 1e-4 * size);
        const long double third =
            (exact(x_k + 2 * e) - 2 * exact(x_k + e) + 2 * exact(x_k - e) - exact(x_k - 2 * e)) / (2 * e * e * e);
        CHECK(std::abs(static_cast<double>(third)) / 6.0 <= f.bound[3] + 1e-3 * size);
      }
    }
  }
}
