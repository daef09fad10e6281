/// active_set.hpp and cluster.hpp of the library's sources: the first-order test where singular values coincide, at a
/// known optimum with three largest and three smallest singular values that coincide.

#include <doctest/doctest.h>

#include "math/linear/least_squares.hpp"
#include "ninedof/optimize/trace.hpp"
#include "optimize/polish/active_set.hpp"
#include "optimize/polish/cluster.hpp"
#include "support/studies.hpp"

using namespace ninedof;
using namespace studies;

namespace {

constexpr double tie = 1e-6;

/// Planar triples within a footprint, no leg too short: at the optimum axial and transverse singular values meet at
/// both ends.
Problem symmetric_study() {
  Problem p;
  p.family = "symmetric";
  for (const auto& v : design_family(p.family).variables()) p.variables.push_back({v.low, v.high});
  p.limits = {{.name = "leg_length", .low = 2.0}, {.name = "footprint", .high = 4.0}};
  return p;
}

/// The same among all planar robots: 24 coordinates, zp and zs free.
Problem general_study() {
  Problem p = symmetric_study();
  p.family = "general";
  p.variables.assign(36, {-30.0, 30.0});
  for (std::size_t k = 2; k < 36; k += 3) p.variables[k] = {0.0, 0.0};
  for (int k = 0; k < 2; ++k) p.variables.push_back({0.05, 80.0});
  p.variables.push_back({0.0, 0.0});
  return p;
}

const Candidate& optimum() {
  static const Candidate best = optimize(symmetric_study()).candidates.at(0);
  return best;
}

/// A design of the symmetric family as one of the general one.
Eigen::VectorXd general_variables(const Eigen::VectorXd& x) {
  const DesignFamily& family = design_family("symmetric");
  const Geometry g = family.geometry(span(x));
  Eigen::VectorXd out = Eigen::VectorXd::Zero(39);
  int k = 0;
  for (const Triple* t : {&g.base_external(), &g.base_internal(), &g.platform_external(), &g.platform_internal()})
    for (const Vec3& joint : *t) out.segment<3>(3 * k++) = joint;
  out[36] = x[family.index("zp")];
  out[37] = x[family.index("zs")];
  return out;
}

/// That design, evaluated; `turn` replaces the singular vectors of each cluster by other orthonormal ones.
struct Tied {
  PreparedProblem p;
  Eigen::VectorXd y;
  DesignEvaluation design;

  explicit Tied(const Problem& problem, const Eigen::VectorXd& symmetric = optimum().variables)
      : p(problem, 1e4), y(p.coordinates.coordinates(general_variables(symmetric))) {
    evaluate_design(p, y, design);
  }

  void turn(Random& random) {
    Spectrum& s = design.spectra[0].general;
    for (const Eigen::Index first : {0, 3}) {
      const Mat3 q = random.rotation();
      s.twist.middleCols<3>(first) *= q;
      s.sdot.middleCols<3>(first) *= q;
      s.rates.middleCols<3>(first) *= q;
    }
    const PoseState& at = design.state.pose(0);
    for (int k = 0; k < 6; ++k) {
      PointGradient g = zero_gradient();
      add_spectrum_gradient(at.at, at.legs, s, k, k, 0.5 / (s.sigma[k] * s.sigma[k]), g);
      design.spectra[0].gradient.row(k).setZero();
      design.state.add(0, g, design.spectra[0].gradient.row(k));
    }
    fill_index(p.problem.objective.index, design.spectra[0], 0, design.objective_rows, design.row_gradient);
  }

  Stationarity test() const { return stationarity(p, design, active_set(p, design, y)); }

  /// The same test with nothing but the rows there are.
  double residual_of_rows() const {
    const ActiveSet a = active_set(p, design, y);
    const Eigen::Index n = p.coordinates.size(), rows = static_cast<Eigen::Index>(a.row_levels.size());
    Eigen::MatrixXd system = Eigen::MatrixXd::Zero(n + 1, rows + static_cast<Eigen::Index>(a.margins.size()));
    for (Eigen::Index k = 0; k < rows; ++k)
      system.col(k) << design.row_gradient
                           .row(p.row_levels[static_cast<std::size_t>(a.row_levels[static_cast<std::size_t>(k)])].row)
                           .transpose(),
          1e3;
    for (std::size_t k = 0; k < a.margins.size(); ++k)
      system.col(rows + static_cast<Eigen::Index>(k)).head(n) = -design.margin_gradient.row(a.margins[k]).transpose();
    const Eigen::VectorXd target = 1e3 * Eigen::VectorXd::Unit(n + 1, n);
    return (system * nonnegative_least_squares(system, target)).head(n).norm();
  }
};

/// log(condition number) of the design at `y`, by conditioning.hpp.
double log_index(const PreparedProblem& p, const Eigen::VectorXd& y) {
  return std::log(studies::condition_number(p.problem, p.coordinates.variables(y)));
}

}  // namespace

TEST_SUITE("stationarity") {
  TEST_CASE("the optimum has three largest and three smallest singular values that coincide") {
    CHECK(optimum().stationary());
    CHECK(optimum().prices.size() == 2);
    const Tied at(general_study());
    const auto& s = at.design.spectra[0];
    REQUIRE_FALSE(s.closed);
    CHECK(s.log_sigma[0] - s.log_sigma[2] <= 1e-10);
    CHECK(s.log_sigma[3] - s.log_sigma[5] <= 1e-10);
    CHECK(at.design.log_objective == doctest::Approx(std::log(optimum().condition_number)).epsilon(1e-12));
    CHECK(violation(at.p, at.design, at.y) <= 1e-10);
  }

  TEST_CASE("an optimum of the symmetric designs is stationary among all designs, for any choice of singular vectors") {
    // By symmetry: a subgradient averaged over the turns by 120 degrees is one of the symmetric problem.
    Random random(251);
    Tied at(general_study());
    CHECK(at.test().residual <= 1e-6);
    for (int n = 0; n < 10; ++n) {
      at.turn(random);
      CHECK(at.residual_of_rows() > 1e-2);  // single vectors do not show it: the convex combination is over the cluster
      const Stationarity s = at.test();
      CHECK(s.residual <= 1e-6);
      for (const auto& [name, price] : optimum().prices) {
        CAPTURE(name);
        REQUIRE(s.prices.contains(name));
        CHECK(s.prices.at(name) == doctest::Approx(price).epsilon(1e-3));
      }
    }
  }

  TEST_CASE("not stationary: without the limit, and beside the optimum") {
    Random random(252);
    Problem problem = general_study();
    problem.limits.clear();
    Tied free(problem);
    free.turn(random);
    CHECK(free.test().residual > 1e-2);
    const Tied beside(general_study(), optimum().variables * 1.01);
    CHECK(beside.test().residual > 1e-3);
  }

  TEST_CASE(
      "base at most twice the platform: what is best among symmetric designs is none among all, and is not called "
      "one") {
    // The widest platform joint alone sets the limit: making one of three wider is enough, which breaks the symmetry.
    Problem symmetric = symmetric_study(), general = general_study();
    for (Problem* p : {&symmetric, &general})
      p->limits = {{.name = "leg_ratio", .high = 3.0}, {.name = "radius_ratio", .high = 2.0}};
    const Candidate best = optimize(symmetric).candidates.at(0);
    CHECK(std::abs(best.condition_number - 2.3430924) <= 5e-8);
    CHECK(best.stationary());
    const Tied at(general, best.variables);
    CHECK(violation(at.p, at.design, at.y) <= 1e-10);
    CHECK(at.test().residual > 1e-2);
    const Candidate lower = trace(general, general_variables(best.variables)).end;
    CHECK(lower.feasible());
    CHECK(lower.objective < best.objective * (1.0 - 1e-4));
  }

  TEST_CASE("the steepest row of a cluster is the directional derivative of the condition number") {
    Random random(253);
    Tied at(general_study());
    for (int n = 0; n < 20; ++n) {
      at.turn(random);
      const Cluster cluster(at.p, at.design, 0, tie);
      REQUIRE(cluster.ambiguous());
      const Eigen::VectorXd along =
          Eigen::VectorXd::NullaryExpr(at.y.size(), [&] { return random.normal(); }).normalized();
      const Eigen::VectorXd row = cluster.steepest(along);
      // The index rises towards -along by the most any row does: the least row along `along`, turned round.
      constexpr double h = 2e-5;
      const auto ahead = [&](double steps) { return log_index(at.p, at.y - steps * h * along); };
      const double slope = (-11.0 * ahead(0) + 18.0 * ahead(1) - 9.0 * ahead(2) + 2.0 * ahead(3)) / (6.0 * h);
      CHECK(std::abs(row.dot(along) + slope) <= 1e-5);
      // No other direction in the cluster points further.
      for (int m = 0; m < 50; ++m) {
        at.turn(random);
        for (Eigen::Index k = 0; k < at.p.rows; ++k)
          CHECK(at.design.row_gradient.row(k).dot(along) >= row.dot(along) - 1e-9);
      }
    }
  }

  TEST_CASE("no cluster where nothing coincides, or where symmetry keeps a pair equal") {
    const auto ambiguous = [](const Problem& p, const Eigen::VectorXd& x) {
      const PreparedProblem prepared(p, 1e4);
      DesignEvaluation design;
      evaluate_design(prepared, prepared.coordinates.coordinates(x), design);
      return Cluster(prepared, design, 0, tie).ambiguous();
    };
    CHECK(ambiguous(general_study(), general_variables(optimum().variables)));
    CHECK_FALSE(ambiguous(symmetric_study(), optimum().variables));
    Random random(254);
    Eigen::VectorXd x = general_variables(optimum().variables);
    for (Eigen::Index k = 0; k < 36; ++k)
      if (k % 3 != 2) x[k] += random.uniform(-0.1, 0.1);
    CHECK_FALSE(ambiguous(general_study(), x));
    Problem smooth = general_study();
    smooth.objective.index = Index::frobenius;
    CHECK_FALSE(ambiguous(smooth, general_variables(optimum().variables)));
  }

  TEST_CASE("nonnegative least squares: optimality conditions hold") {
    Random random(255);
    for (int n = 0; n < 200; ++n) {
      const Eigen::MatrixXd a = Eigen::MatrixXd::NullaryExpr(8, 1 + n % 12, [&] { return random.normal(); });
      const Eigen::VectorXd b = Eigen::VectorXd::NullaryExpr(8, [&] { return random.normal(); });
      const Eigen::VectorXd w = nonnegative_least_squares(a, b);
      REQUIRE(w.size() == a.cols());
      const Eigen::VectorXd pull = a.transpose() * (b - a * w);
      for (Eigen::Index k = 0; k < w.size(); ++k) {
        CHECK(w[k] >= 0.0);
        CHECK(pull[k] <= 1e-9);
        if (w[k] > 0.0) CHECK(std::abs(pull[k]) <= 1e-9);
      }
    }
  }
}
