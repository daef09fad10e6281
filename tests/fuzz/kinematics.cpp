/// Robots and poses: the Jacobian, its inverse relations and the condition number, each against the others.

#include <Eigen/SVD>
#include <algorithm>

#include "ninedof/conditioning/conditioning.hpp"
#include "ninedof/kinematics/velocity.hpp"
#include "ninedof/proof/bounds.hpp"
#include "ninedof/robot/legs.hpp"
#include "support/bytes.hpp"

using namespace fuzz;

namespace {

constexpr double eps = 0x1p-52;

/// J' against the velocity matrices, the twist of unit rates and the singular values that never see J'.
void compare(const Robot& r, double lc, double kappa) {
  const Mat69 J = jacobian(r.geometry, r.pose, lc);
  EXPECT(J.allFinite());
  const VelocityMatrices v = velocity_matrices(r.geometry, r.pose, lc);
  const double loss = 1e5 * eps * kappa * kappa;
  const Mat69 G = v.G;
  if (G.allFinite()) EXPECT((v.F * J - G).norm() <= loss * (v.F.norm() * J.norm() + G.norm()));

  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(J);
  const Vec6 sigma = singular_values(r.geometry, r.pose, lc);
  EXPECT(std::abs(svd.singularValues()[0] / svd.singularValues()[5] / kappa - 1.0) <= loss);
  EXPECT(((svd.singularValues() - sigma).cwiseAbs().array() <= loss * sigma[0]).all());

  Vec9 rates;
  for (Eigen::Index k = 0; k < 9; ++k) rates[k] = 1.0 + static_cast<double>(k * k % 7);
  const Velocity moved = forward_velocity(r.geometry, r.pose, rates);
  EXPECT(moved.omega.allFinite() && moved.pdot.allFinite() && moved.sdot.allFinite());
  Vec6 twist;
  twist << lc * moved.omega, moved.pdot;
  EXPECT((J * rates - twist).norm() <= loss * (J.norm() * rates.norm()));
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Bytes in(data, size);
  const double factor = std::ldexp(1.0, static_cast<int>(in.byte() % 16) - 8);  // of the characteristic length
  const std::optional<Robot> r = robot(in, -300, 300);
  if (!r) return 0;
  validate(r->pose);
  const Vec9 lengths = leg_lengths(r->geometry, r->pose);
  EXPECT(lengths.allFinite() && lengths.minCoeff() >= 0.0);
  const double lc = factor * (lengths.maxCoeff() > 0.0 ? lengths.maxCoeff() : 1.0);

  const Vec6 sigma = singular_values(r->geometry, r->pose, lc);
  EXPECT(!sigma.hasNaN() && sigma[5] > 0.0);
  EXPECT(std::is_sorted(sigma.data(), sigma.data() + 6, std::greater<>()));
  for (const Norm norm : {Norm::two, Norm::frobenius}) {
    const double kappa = condition_number(r->geometry, r->pose, lc, norm);
    EXPECT(kappa >= (norm == Norm::two ? 1.0 : 6.0 * (1.0 - 1e-14)));
  }
  EXPECT(!std::isnan(manipulability(r->geometry, r->pose, lc)));
  EXPECT(isotropy_residual(r->geometry, r->pose, lc) >= 0.0);

  const double kappa = condition_number(r->geometry, r->pose, lc);
  const Interval bounds = condition_number_bounds(r->geometry, r->pose, lc);
  const double error = 1e-13 * kappa;
  EXPECT(bounds.lo >= 1.0 && bounds.lo <= bounds.hi);
  if (std::isfinite(kappa)) EXPECT(bounds.lo <= kappa * (1.0 + error) && bounds.hi >= kappa * (1.0 - error));

  const Mat69 J = jacobian(r->geometry, r->pose, lc);
  EXPECT(J.allFinite() || J.array().isNaN().all());
  if (kappa < 1e4) compare(*r, lc, kappa);
  return 0;
}
