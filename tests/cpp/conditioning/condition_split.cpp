/// gram.hpp: directions, bounds of M^T M, and where in a box the condition number is proved to be at most K, or
/// not. Oracle: directions in long double; the singular values of the conditioning matrix at points of the box.

#include <doctest/doctest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <random>

#include "conditioning/forms/gram.hpp"
#include "ninedof/conditioning/conditioning.hpp"
#include "ninedof/conditioning/locked_legs.hpp"
#include "ninedof/kinematics/velocity.hpp"

using namespace ninedof;
using namespace ninedof::forms;

namespace {

using Point = std::array<double, PoseForm::size>;

struct Sampler {
  std::mt19937_64 random{11};
  std::uniform_real_distribution<double> any{-1.0, 1.0};
  double operator()() { return any(random); }
  Point point() {
    Point t{};
    for (std::size_t k = 0; k < 3; ++k) t[k] = random() % 3 == 0 ? std::copysign(1.0, any(random)) : any(random);
    return t;
  }
};

template <class T>
long double at(const T& f, const Point& t) {
  long double out = f.c;
  for (std::size_t k = 0; k < T::size; ++k) out += static_cast<long double>(f.a[k]) * t[k];
  if constexpr (T::curved)
    for (std::size_t k = 0, n = 0; k < T::size; ++k)
      for (std::size_t l = 0; l <= k; ++l, ++n) out += static_cast<long double>(f.q[n]) * t[k] * t[l];
  return out;
}

/// A box of positions about a pose of a random robot, O half way.
struct SplitCase {
  Geometry robot;
  Configuration home;
  double half;

  explicit SplitCase(Sampler& draw, double size) : robot(geometry(draw)), half(size) {
    home.position = Vec3(0.3 * draw(), 0.3 * draw(), 4.5 + 0.5 * draw());
    home.internal_point = Vec3(0.2 * draw(), 0.2 * draw(), 2.3 + 0.3 * draw());
  }
  static Geometry geometry(Sampler& draw) {
    const auto triple = [&](double radius) {
      Triple out;
      for (int k = 0; k < 3; ++k) {
        const double angle = 2.0943951 * k + 0.5 * draw();
        out[static_cast<std::size_t>(k)] = Vec3(radius * std::cos(angle), radius * std::sin(angle), 0.2 * draw());
      }
      return out;
    };
    return {triple(3.4), triple(3.0), triple(3.2), triple(1.7)};
  }
  template <class T = PoseForm>
  PoseOf<T> pose() const {
    const auto form = [&](int k) {
      return T::coordinate(home.position[k] - half, home.position[k] + half, static_cast<std::size_t>(k));
    };
    PoseOf<T> out;
    out.p = {form(0), form(1), form(2)};
    const Vec3 apart = home.internal_point - 0.5 * home.position;
    out.s = 0.5 * out.p + constant<T>(apart);
    for (int k = 0; k < 3; ++k) out.q[static_cast<std::size_t>(k)] = constant<T>(Vec3::Unit(k));
    return out;
  }
  Configuration configuration(const Point& t) const {
    Configuration c = home;
    c.position += half * Vec3(t[0], t[1], t[2]);
    c.internal_point += 0.5 * half * Vec3(t[0], t[1], t[2]);
    return c;
  }
  /// With a leg locked; -1: none.
  double condition(const Point& t, int locked = -1) const {
    if (locked < 0) return condition_number(robot, configuration(t), 1.0);
    const PosedPoints here = posed_points(robot, configuration(t));
    return LockedLegs(here.at, here.legs, 1.0).condition_number({locked});
  }
};

}  // namespace

TEST_SUITE("condition_split") {
  TEST_CASE_TEMPLATE("directions at points of a box are within the error of their forms", T, PoseForm, CurvedForm) {
    Sampler draw;
    for (int trial = 0; trial < 20'000; ++trial) {
      const double size = std::exp(4.0 * draw() - 4.0), unit = trial % 5 == 0 ? 1e80 : 1.0;
      std::array<T, 3> v;
      for (T& x : v) {
        x.c = 3.0 * draw() * unit;
        for (std::size_t k = 0; k < 3; ++k) x.a[k] = size * draw() * unit;
        for (double& bend : x.q) bend = 0.3 * size * size * draw() * unit;
        x.r = trial % 2 == 0 ? 0.0 : 0.1 * size * std::abs(draw()) * unit;
      }
      const Xyz<T> e = direction_of(Xyz<T>{v[0], v[1], v[2]});
      const Point t = draw.point();
      std::array<long double, 3> value;
      long double square = 0.0L;
      for (std::size_t i = 0; i < 3; ++i) {
        value[i] = at(v[i], t) + static_cast<long double>(v[i].r) * (trial % 4 < 2 ? 1.0 : draw());
        square += value[i] * value[i];
      }
      const std::array<const T*, 3> form{&e.x, &e.y, &e.z};
      for (std::size_t i = 0; i < 3; ++i)
        CHECK(!(std::abs(value[i] / std::sqrt(square) - at(*form[i], t)) > form[i]->r));
    }
    for (const double half : {1e-3, 1e-2, 0.1, 0.3}) {  // the worst case of the error: a move across the vector
      const Xyz<T> e = direction_of(Xyz<T>{T(1.0), T::coordinate(-half, half, 0), T(0.0)});
      for (const double side : {-1.0, 1.0}) {
        const long double length = std::sqrt(1.0L + static_cast<long double>(half) * half);
        CHECK(std::abs(1.0L / length - at(e.x, {side})) <= e.x.r);
        CHECK(std::abs(side * half / length - at(e.y, {side})) <= e.y.r);
      }
    }
    CHECK(std::isinf(direction_of(Xyz<T>{T(1e-150), T(0.0), T(0.0)}).x.r));
    CHECK(std::isinf(direction_of(Xyz<T>{T(1e150), T(0.0), T(0.0)}).x.r));
    CHECK(std::isinf(direction_of(Xyz<T>{T::coordinate(-1.0, 2.0, 0), T(0.0), T(0.0)}).x.r));
  }

  TEST_CASE_TEMPLATE("the bound above M^T M is above it, and the minimum gives it", T, PoseForm, CurvedForm) {
    Sampler draw;
    for (int trial = 0; trial < 500; ++trial) {
      const SplitCase one(draw, std::pow(10.0, -1.5 + draw()));
      Moves unused;
      const SplitGramOf<T> split = split_gram(AsBuilt{one.robot}, 1.0, one.template pose<T>(), unused);
      REQUIRE(split.known);
      const Point t = draw.point();
      SplitCase point = one;
      point.home.position += one.half * Vec3(t[0], t[1], t[2]);
      point.home.internal_point += 0.5 * one.half * Vec3(t[0], t[1], t[2]);
      point.half = 0.0;
      const Mat6 exact = middle_of(gram(one.robot, 1.0, point.pose(), unused));
      Mat6 above, error;
      for (std::size_t i = 0; i < 6; ++i)
        for (std::size_t j = 0; j < 6; ++j) {
          const auto r = static_cast<Eigen::Index>(i), c = static_cast<Eigen::Index>(j);
          above(r, c) = static_cast<double>(at(split.above[entry(i, j)], t));
          error(r, c) = split.above[entry(i, j)].r;
        }
      const Mat6 room = Vec6(error.rowwise().sum()).asDiagonal();
      const Eigen::SelfAdjointEigenSolver<Mat6> above_it(above + room - exact);
      CHECK(above_it.eigenvalues()[0] > -1e-11 * exact.norm());
      if (one.half < 1e-2) CHECK((above - exact).norm() < 300.0 * one.half * one.half * exact.norm());
    }
  }

  TEST_CASE_TEMPLATE("with a leg locked the bound is above M^T M of J' without its column", T, PoseForm, CurvedForm) {
    Sampler draw;
    for (int trial = 0; trial < 500; ++trial) {
      const SplitCase one(draw, std::pow(10.0, -1.5 + draw()));
      const int locked = 3 + trial % 6;
      Moves unused;
      const SplitGramOf<T> split = split_gram(AsBuilt{one.robot}, 1.0, one.template pose<T>(), unused, locked);
      REQUIRE(split.known);
      const Point t = draw.point();
      Mat69 j = jacobian(one.robot, one.configuration(t), 1.0);
      j.col(locked).setZero();
      const Mat6 exact = (j * j.transpose()).inverse();
      Eigen::Matrix<double, 9, 9> whole, error;  // above, across and sum
      for (std::size_t i = 0; i < 9; ++i)
        for (std::size_t k = 0; k < 9; ++k) {
          const std::size_t a = std::max(i, k), b = std::min(i, k);
          const T& form = a < 6   ? split.above[entry(a, b)]
                          : b < 6 ? split.across[a - 6][b]
                                  : split.sum[entry(a - 6, b - 6)];
          const auto r = static_cast<Eigen::Index>(i), c = static_cast<Eigen::Index>(k);
          whole(r, c) = static_cast<double>(at(form, t));
          error(r, c) = form.r;
        }
      const double size = exact.norm();
      const Mat6 above =
          whole.topLeftCorner<6, 6>() + Mat6(Vec6(error.topLeftCorner<6, 6>().rowwise().sum()).asDiagonal());
      CHECK(Eigen::SelfAdjointEigenSolver<Mat6>(above - exact).eigenvalues()[0] > -1e-9 * size);
      if (one.half > 2e-2) continue;
      // The least over w is the matrix itself, up to the errors.
      const Mat6 least = whole.topLeftCorner<6, 6>() - whole.topRightCorner<6, 3>() *
                                                           whole.bottomRightCorner<3, 3>().inverse() *
                                                           whole.bottomLeftCorner<3, 6>();
      CHECK((least - exact).norm() <= 1e-9 * size + 100.0 * error.norm());
      CHECK((whole.topLeftCorner<6, 6>() - exact).norm() < 500.0 * one.half * one.half * size);
    }
  }

  TEST_CASE("what is proved of the condition number holds at points") {
    Sampler draw;
    int everywhere = 0, parts = 0, nowhere = 0;
    for (int trial = 0; trial < 2'000; ++trial) {
      const SplitCase one(draw, std::pow(10.0, -2.0 + draw()));
      const int locked = trial % 7 == 0 ? -1 : 2 + trial % 7;
      const double limit = one.condition({}, locked) * (1.0 + draw() * one.half);
      if (!(limit > 1.0)) continue;
      Moves unused;
      const SplitGram g = split_gram(AsBuilt{one.robot}, 1.0, one.pose(), unused, locked);
      const ConditionSplit split = split_by_condition(g, limit);
      const bool all = bounded(split_gram(AsBuilt{one.robot}, 1.0, one.pose<CurvedForm>(), unused, locked), limit);
      everywhere += all;
      parts += !split.everywhere && std::isfinite(split.level);
      nowhere += lower(split.excess) > 0.0;
      for (int n = 0; n < 20; ++n) {
        const Point t = draw.point();
        const double kappa = one.condition(t, locked),
                     along = split.slope[0] * t[0] + split.slope[1] * t[1] + split.slope[2] * t[2];
        if (all || split.everywhere || along >= split.level) CHECK(kappa <= limit * (1.0 + 1e-11));
        if (static_cast<double>(at(split.excess, t)) > split.excess.r) CHECK(kappa >= limit * (1.0 - 1e-11));
      }
    }
    CHECK(everywhere > 100);
    CHECK(parts > 100);
    CHECK(nowhere > 100);
  }
}
