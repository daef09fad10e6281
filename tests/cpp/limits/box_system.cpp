/// box_system.hpp: the inverse of every matrix of a box lies within its forms, whose errors fall with the square of the
/// box. Oracle: Eigen's inverse at points and corners of the box.

#include "limits/box_system.hpp"

#include <doctest/doctest.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <random>

using namespace ninedof;

namespace {

using Rows = Nine<Nine<PoseForm>>;

/// Near the identity: slopes and errors of a box of a size.
Rows random_rows(std::mt19937& engine, double size) {
  std::uniform_real_distribution<double> number(-1.0, 1.0);
  Rows h;
  for (std::size_t i = 0; i < 9; ++i)
    for (std::size_t j = 0; j < 9; ++j) {
      h[i][j] = 0.2 * number(engine) + (i == j ? 1.5 : 0.0);
      for (double& slope : h[i][j].a) slope = size * number(engine);
      h[i][j].r = 30.0 * size * size * std::abs(number(engine));
    }
  return h;
}

using Place = std::array<double, PoseForm::size>;

/// Of the linear part of a form.
double value(const PoseForm& f, const Place& t) {
  double out = f.c;
  for (std::size_t k = 0; k < t.size(); ++k) out += f.a[k] * t[k];
  return out;
}

/// A matrix of the box: `part` is drawn for each entry, the part of its error.
template <class Part>
Mat9 matrix_at(const Rows& h, const Place& t, const Part& part) {
  Mat9 out;
  for (std::size_t i = 0; i < 9; ++i)
    for (std::size_t j = 0; j < 9; ++j)
      out(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) = value(h[i][j], t) + part() * h[i][j].r;
  return out;
}

}  // namespace

TEST_SUITE("box_system") {
  TEST_CASE("the inverse of every matrix of the box is within its forms, which are of second order") {
    for (unsigned seed = 0; seed < 20; ++seed) {
      double before = 0.0;
      for (const double size : {2e-3, 1e-3}) {
        std::mt19937 engine(seed);  // the same numbers for both sizes
        const Rows h = random_rows(engine, size), inverse = BoxSystem(h).inverse();
        double widest = 0.0;
        for (int n = 0; n < 200; ++n) {
          std::uniform_real_distribution<double> number(-1.0, 1.0);
          const auto part = [&] { return n % 2 == 0 ? number(engine) : std::copysign(1.0, number(engine)); };
          Place t;
          for (double& x : t) x = part();
          const Mat9 exact = matrix_at(h, t, part).inverse();
          bool holds = true;
          for (std::size_t i = 0; i < 9; ++i)
            for (std::size_t j = 0; j < 9; ++j) {
              const double x = exact(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
              holds = holds && std::abs(x - value(inverse[i][j], t)) <= inverse[i][j].r + 1e-13;
              widest = std::max(widest, inverse[i][j].r);
            }
          CHECK(holds);
        }
        if (before > 0.0) CHECK(widest < 0.27 * before);
        before = widest;
      }
    }
  }

  TEST_CASE("a component lies within its form, which is hardly wider than what is met") {
    const double size = 3e-3;
    double open = 0.0, met = 0.0;
    for (unsigned seed = 0; seed < 20; ++seed) {
      std::mt19937 engine(seed);
      Rows h = random_rows(engine, size);
      for (Nine<PoseForm>& row : h)
        for (PoseForm& f : row) f.r = 0.0;
      std::uniform_real_distribution<double> number(-1.0, 1.0);
      Vec9 b;
      for (double& x : b) x = number(engine);
      Nine<PoseForm> wanted;
      for (std::size_t i = 0; i < 9; ++i) wanted[i] = b[static_cast<Eigen::Index>(i)];
      const PoseForm x = BoxSystem(h).component(4, wanted);
      double away = 0.0;
      for (int n = 0; n < 500; ++n) {
        Place t;
        for (double& one : t) one = std::copysign(1.0, number(engine));
        const Mat9 at = matrix_at(h, t, [] { return 0.0; });
        away = std::max(away, std::abs(at.transpose().lu().solve(b)[4] - value(x, t)));
      }
      CHECK(away <= x.r + 1e-13);
      open += x.r;
      met += away;
    }
    CHECK(open < 2.5 * met);
  }

  TEST_CASE("the coordinate that moves most is named; of a matrix that may be singular nothing is known") {
    std::mt19937 engine(1);
    Rows h = random_rows(engine, 1e-3);
    for (Nine<PoseForm>& row : h)
      for (PoseForm& f : row) f.a[4] *= 5.0;
    const auto moves = BoxSystem(h).moves();
    CHECK(std::ranges::max_element(moves) - moves.begin() == 4);
    h[2].fill(PoseForm::unknown());
    const BoxSystem unknown(h);
    CHECK(!is_known(unknown.inverse()[0][0]));
    CHECK(unknown.moves() == std::array<double, PoseForm::size>{});
  }
}
