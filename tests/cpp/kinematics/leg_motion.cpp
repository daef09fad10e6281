/// leg_motion.hpp: rates and accelerations by finite differences of lengths along a motion of platform and O; the
/// largest over directions against directions at random; least squares by their normal equations.

#include "ninedof/kinematics/leg_motion.hpp"

#include <doctest/doctest.h>

#include "ninedof/robot/legs.hpp"
#include "support/support.hpp"

using namespace ninedof;
using namespace support;

namespace {

const std::vector<InternalMotion> rules{InternalMotion::least, InternalMotion::held, InternalMotion::shifted,
                                        InternalMotion::carried};

/// The pose at a small time t of a platform with a twist and its rate, O by a rule that is a formula.
Configuration after(const Configuration& c, InternalMotion rule, const TwistMotion& m, double t) {
  // Q(t) = exp(omega t + alpha t^2 / 2) Q is right to second order.
  const Vec3 turn = t * m.twist.head<3>() + 0.5 * t * t * m.rate.head<3>();
  const Vec3 shift = t * m.twist.tail<3>() + 0.5 * t * t * m.rate.tail<3>();
  const Mat3 q = (Eigen::AngleAxisd(turn.norm(), turn.normalized()).toRotationMatrix() * c.rotation);
  Configuration out{c.position + shift, q, c.internal_point};
  if (rule == InternalMotion::shifted) out.internal_point += shift;
  if (rule == InternalMotion::carried)
    out.internal_point = out.position + q * c.rotation.transpose() * (c.internal_point - c.position);
  return out;
}

}  // namespace

TEST_SUITE("leg_motion") {
  TEST_CASE("rates and accelerations are differences of lengths") {
    Random random(11);
    for (int k = 0; k < cases(40); ++k) {
      const auto [g, c] = random_robot(random);
      const TwistMotion motion{random.matrix<Vec6>(), random.matrix<Vec6>()};
      for (const InternalMotion rule : rules) {
        if (rule == InternalMotion::least) continue;
        const double h = 1e-4;
        const Vec9 before = leg_lengths(g, after(c, rule, motion, -h)), here = leg_lengths(g, c),
                   later = leg_lengths(g, after(c, rule, motion, h));
        const Vec9 rate = (later - before) / (2.0 * h), acceleration = (later - 2.0 * here + before) / (h * h);
        CHECK((leg_rates(g, c, rule, motion.twist) - rate).cwiseAbs().maxCoeff() < 1e-5 * (1.0 + rate.norm()));
        CHECK((leg_accelerations(g, c, rule, motion) - acceleration).cwiseAbs().maxCoeff() <
              1e-4 * (1.0 + acceleration.norm()));
      }
    }
  }

  TEST_CASE("least: no other motion of O has smaller squares") {
    Random random(12);
    for (int k = 0; k < cases(40); ++k) {
      const auto [g, c] = random_robot(random);
      const TwistMotion motion{random.matrix<Vec6>(), random.matrix<Vec6>()};
      const Vec9 rates = leg_rates(g, c, InternalMotion::least, motion.twist);
      const Vec9 accelerations = leg_accelerations(g, c, InternalMotion::least, motion);
      const Mat93 by_o = null_motion(g, c);
      CHECK((by_o.transpose() * rates).norm() < 1e-9 * (1.0 + rates.norm()));
      CHECK((by_o.transpose() * accelerations).norm() < 1e-9 * (1.0 + accelerations.norm()));
      // Those of the external legs do not depend on O.
      CHECK((accelerations - leg_accelerations(g, c, InternalMotion::held, motion)).head<3>().norm() < 1e-9);
    }
  }

  TEST_CASE("no direction is faster, and one is as fast") {
    Random random(13);
    for (int k = 0; k < cases(16); ++k) {
      const auto [g, c] = random_robot(random);
      const InternalMotion rule = rules[at_index(k % 4)];
      const PlatformMotion both{rule, 1.3, 0.7, {}}, shift{rule, 1.3, 0.0, {}};
      const Vec9 fastest = largest_leg_rates(g, c, both), bound = largest_leg_accelerations(g, c, both);
      const Vec9 exact = largest_leg_accelerations(g, c, shift);
      Vec9 met = Vec9::Zero(), met_rate = Vec9::Zero();
      for (int n = 0; n < 2000; ++n) {
        const Vec3 turning = 0.7 * random.unit(), shifting = 1.3 * random.unit();
        Vec6 twist;
        twist << turning, shifting;
        const Vec9 rate = leg_rates(g, c, rule, twist).cwiseAbs();
        const Vec9 acceleration = leg_accelerations(g, c, rule, {twist, Vec6::Zero()}).cwiseAbs();
        CHECK((rate - fastest).maxCoeff() < 1e-9 * (1.0 + fastest.norm()));
        CHECK((acceleration - bound).maxCoeff() < 1e-9 * (1.0 + bound.norm()));
        met_rate = met_rate.cwiseMax(rate);
        twist.head<3>().setZero();
        met = met.cwiseMax(leg_accelerations(g, c, rule, {twist, Vec6::Zero()}).cwiseAbs());
      }
      CHECK((met_rate - 0.8 * fastest).minCoeff() >= -1e-9);
      CHECK((met - 0.9 * exact).minCoeff() >= -1e-9 * (1.0 + exact.norm()));
      CHECK(largest_leg_accelerations(g, c, {rule, 0.0, 0.0, {}}).isZero(0.0));
    }
  }

  TEST_CASE("a leg of no length has no acceleration") {
    Random random(14);
    auto [g, c] = random_robot(random);
    c.internal_point = g.base_internal()[0];
    const Vec9 found = largest_leg_accelerations(g, c, {InternalMotion::held, 1.0, 0.0, {}});
    CHECK(std::isinf(found[6]));
    CHECK(found.head<6>().allFinite());
  }
}
