/// Forces and rates of legs: all of a pose at once, and slopes where a machine is nearly singular.

#include <doctest/doctest.h>

#include <cmath>

#include "limits/rows.hpp"
#include "support/support.hpp"

using namespace ninedof;
using namespace support;

namespace {

LimitOptions loaded(Random& random) {
  Duty duty;
  duty.loads = {{random.matrix<Vec3>(), random.matrix<Vec3>(), Vec3::Zero()},
                {random.matrix<Vec3>(), random.matrix<Vec3>(), Vec3::Zero()}};
  duty.gravity = random.matrix<Vec3>();
  duty.masses.platform = 0.3;
  duty.masses.internal_point = 0.2;
  duty.masses.rod.setConstant(0.1);
  duty.masses.rod_centre.setConstant(0.2);
  duty.motion = {InternalMotion::least, 0.7, 0.4, {}};
  LimitOptions out;
  out.duty = std::make_shared<const Duty>(duty);
  return out;
}

/// A pose whose lower legs lie in a plane with O but for a distance: at 0, O moves where no length changes.
PosedPoints flat(Random& random, double distance) {
  const Robot robot = random_robot(random);
  PosedPoints out = posed_points(robot.geometry, robot.configuration);
  const Vec3& o = out.at[point_s];
  for (int k = 0; k < 3; ++k) out.at[at_index(point_r_hat + k)].z() = o.z() - (k == 0 ? 2.0 : 1.0) * distance;
  out.legs = nine_legs(out.at);
  return out;
}

}  // namespace

TEST_SUITE("duty_at_pose") {
  TEST_CASE("the numbers of all legs at once are those of each") {
    Random random(3);
    int rows = 0;
    for (const LimitRow& row : limit_rows()) {
      if (row.pose == nullptr || row.pose->numbers == nullptr) continue;
      ++rows;
      CAPTURE(std::string(row.info.name));
      for (const double distance : {1.0, 1e-5, 0.0}) {
        const LimitOptions options = loaded(random);
        const PosedPoints here = flat(random, distance);
        const PointLook look(here, here, options);
        std::array<double, 9> all;
        row.pose->numbers(look, all.data());
        for (int item = 0; item < row.pose->items; ++item) CHECK(all[at_index(item)] == row.pose->number(look, item));
      }
    }
    CHECK(rows == 10);  // fault_tolerant too
  }

  TEST_CASE("a singular pose has an infinite force, and without slopes") {
    Random random(4);
    const LimitOptions options = loaded(random);
    const PosedPoints here = flat(random, 0.0);
    PointSlopes slopes;
    CHECK(force_row.number(PointLook(here, here, options), 7) == infinity);
    CHECK(force_row.slopes(PointLook(here, here, options), 7, slopes) == infinity);
    CHECK(slopes.points == 0);
  }

  TEST_CASE("slopes of a force are difference quotients however near a singular pose is") {
    Random random(5);
    for (const double distance : {1e-2, 1e-4, 1e-6, 1e-8}) {
      const LimitOptions options = loaded(random);
      const PosedPoints here = flat(random, distance);
      for (int leg = 0; leg < 9; ++leg) {
        CAPTURE(distance);
        CAPTURE(leg);
        PointSlopes slopes;
        force_row.slopes(PointLook(here, here, options), leg, slopes);
        for (const int point : {point_r_hat + 1, int(point_s), point_u_tilde + 2}) {
          const auto force = [&](double by) {  // along z: the distance changes
            PosedPoints moved = here;
            moved.at[at_index(point)].z() += by;
            moved.legs = nine_legs(moved.at);
            return force_row.number(PointLook(moved, here, options), leg);
          };
          const double h = 0.01 * distance;
          const double quotient = (8.0 * (force(h) - force(-h)) - (force(2.0 * h) - force(-2.0 * h))) / (12.0 * h);
          double slope = 0.0;
          for (int n = 0; n < slopes.points; ++n)
            if (slopes.at[at_index(n)].point == point) slope += slopes.at[at_index(n)].slope.z();
          CHECK(std::abs(slope - quotient) <= (1e-6 + 1e-12 / distance) * (std::abs(quotient) + force(0.0)));
        }
      }
    }
  }
}
