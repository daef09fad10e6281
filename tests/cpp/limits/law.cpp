/// The table of limits under one law, row by row: slopes are difference quotients, forms over a box of poses hold a
/// thousand poses of it, bounds hold what they bound, kernels agree with rows, and designs enclosed as intervals hold
/// their value. A row with a planted error breaks it.

#include <doctest/doctest.h>

#include <cmath>

#include "limits/leg_clearance.hpp"
#include "limits/table.hpp"
#include "ninedof/batch/batch.hpp"
#include "ninedof/limits/numbers.hpp"
#include "ninedof/math/error.hpp"
#include "ninedof/math/rotation.hpp"
#include "ninedof/singularity/singularity.hpp"
#include "support/support.hpp"

using namespace ninedof;
using namespace support;

namespace {

/// Two loads with masses of all bodies and each motion of O in turn; of every third case a platform that only turns.
Duty random_duty(int n) {
  Random random(static_cast<unsigned>(n) + 1);  // its own: that of the poses stays
  Duty out;
  for (int k = 0; k < n % 2; ++k) out.loads.push_back({random.matrix<Vec3>(), random.matrix<Vec3>(), Vec3::Zero()});
  out.loads.front() = {random.matrix<Vec3>(), random.matrix<Vec3>(), Vec3::Zero()};
  Masses& m = out.masses;
  m.platform = 0.5;
  m.centre = random.matrix<Vec3>();
  m.internal_point = 0.1;
  for (Vec9* each : {&m.cylinder, &m.rod, &m.cylinder_centre, &m.rod_centre}) *each = random.matrix<Vec9>().cwiseAbs();
  out.gravity = random.matrix<Vec3>();
  using enum InternalMotion;
  out.motion = {std::array{least, held, shifted, carried}[at_index(n % 4)], n % 3 == 0 ? 0.0 : 0.7, 0.4, {}};
  return out;
}

/// A robot at a pose and at home; the axis is that of every second case.
struct Case {
  Geometry g;
  Configuration home, here;
  LimitOptions options;

  Case(Random& random, int n) : Case(random_robot(random), random, n) {}
  Case(const Robot& robot, Random& random, int n)
      : g(robot.geometry), home(robot.configuration), here(robot.configuration) {
    here.position += 0.2 * random.matrix<Vec3>();
    here.rotation = exp_rotation(0.2 * random.matrix<Vec3>()) * home.rotation;
    here.internal_point += 0.2 * random.matrix<Vec3>();
    if (n % 2 == 0) options.axis = random.matrix<Vec3>();
    options.duty = std::make_shared<const Duty>(random_duty(n));
  }
};

/// Another pose of the same robot with its points moved: not what a joint can do, but what slopes are about.
PosedPoints moved(PosedPoints at, int point, const Vec3& by) {
  at.at[at_index(point)] += by;
  at.legs = nine_legs(at.at);
  return at;
}
PosedPoints turned_alone(PosedPoints at, const Vec3& w) {
  at.rotation = exp_rotation(w) * at.rotation;
  return at;
}

struct Broken {
  int slopes = 0, forms = 0;
  bool any() const { return slopes + forms > 0; }
};

/// A fourth-order quotient of the number as something moves by h along each axis.
template <class Moved>
Vec3 quotient(const Moved& number) {
  constexpr double h = 1e-4;
  Vec3 out;
  for (int k = 0; k < 3; ++k) {
    const Vec3 e = h * Vec3::Unit(k);
    out[k] = (8.0 * (number(e) - number(-e)) - (number(2.0 * e) - number(-2.0 * e))) / (12.0 * h);
  }
  return out;
}

int wrong_slopes(const PoseRow& row, const Case& one) {
  const PosedPoints here = posed_points(one.g, one.here), home = posed_points(one.g, one.home);
  const auto number = [&](const PosedPoints& at, const PosedPoints& at_home, int item) {
    return row.number(PointLook(at, at_home, one.options), item);
  };
  int out = 0;
  for (int item = 0; item < row.items; ++item) {
    PointSlopes slopes;
    const double value = row.slopes(PointLook(here, home, one.options), item, slopes);
    out += !(std::abs(value - number(here, home, item)) <= 1e-14 * (1.0 + std::abs(value)));
    const auto differ = [&](const Vec3& a, const Vec3& b) { return !((a - b).norm() <= 1e-7 * (1.0 + a.norm())); };
    for (int point = 0; point < point_count; ++point) {
      Vec3 at = Vec3::Zero(), at_home = Vec3::Zero();
      for (int n = 0; n < slopes.points; ++n)
        if (slopes.at[at_index(n)].point == point) at += slopes.at[at_index(n)].slope;
      for (int n = 0; n < slopes.home_points; ++n)
        if (slopes.home[at_index(n)].point == point) at_home += slopes.home[at_index(n)].slope;
      out += differ(at, quotient([&](const Vec3& by) { return number(moved(here, point, by), home, item); }));
      out += differ(at_home, quotient([&](const Vec3& by) { return number(here, moved(home, point, by), item); }));
    }
    const Vec3 turn = slopes.turns ? slopes.turn : Vec3::Zero(), back = slopes.turns ? slopes.home_turn : Vec3::Zero();
    const auto by_length = [&](const Vec3& by) {  // the same along every axis
      return row.number(PointLook(here, home, one.options, 1.0 + by.sum()), item);
    };
    out += differ(Vec3::Constant(slopes.length), quotient(by_length));
    out += differ(turn, quotient([&](const Vec3& w) { return number(turned_alone(here, w), home, item); }));
    out += differ(back, quotient([&](const Vec3& w) { return number(here, turned_alone(home, w), item); }));
  }
  return out;
}

/// A box of positions, of s and of turns about z, and its poses.
struct PoseBox {
  const Case& one;
  double half;

  FormPose forms() const {
    FormPose out = form_pose(one.here);
    const auto along = [&](const Vec3& v, Eigen::Index k, std::size_t coordinate) {
      return PoseForm::coordinate(v[k] - half, v[k] + half, coordinate);
    };
    out.p = {along(one.here.position, 0, 0), along(one.here.position, 1, 1), along(one.here.position, 2, 2)};
    out.s = {along(one.here.internal_point, 0, 3), along(one.here.internal_point, 1, 4),
             PoseForm(one.here.internal_point.z())};
    const PoseForm yaw = PoseForm::coordinate(-half, half, 5), c = cos(yaw), s = sin(yaw);
    for (FormVector& v : out.q) v = {c * v.x - s * v.y, s * v.x + c * v.y, v.z};
    return out;
  }
  Configuration pose(const Vec6& t) const {
    Configuration c = one.here;
    c.position += half * t.head<3>();
    c.internal_point.head<2>() += half * t.segment<2>(3);
    c.rotation = rotation_about_z(half * t[5]) * c.rotation;
    return c;
  }
};

Interval at(const PoseForm& f, const Vec6& t) {
  if (!is_known(f)) return Interval::whole();
  double value = f.c, size = std::abs(f.c);
  for (std::size_t k = 0; k < PoseForm::size; ++k) {
    value += f.a[k] * t[static_cast<Eigen::Index>(k)];
    size += std::abs(f.a[k]);
  }
  const double room = f.r + 1e-15 * size;
  return {value - room, value + room};
}

/// The forms of a row at poses of a box, and the numbers there.
int wrong_forms(const PoseRow& row, const Case& one, double half, Random& random) {
  const PoseBox box{one, half};
  const FormPose pose = box.forms();
  const FormHome form_home(one.g, one.home, one.options);
  const AsBuilt drawn{one.g};
  const FormLook look(drawn, pose, form_home);
  const PosedPoints home = posed_points(one.g, one.home);
  int out = 0;
  for (int item = 0; item < row.items; ++item) {
    const PoseForm u = row.form(look, item);
    out += half < 1e-3 && !is_known(u);
    for (int n = 0; n < 1000 / row.items; ++n) {
      const Vec6 t = random.matrix<Vec6>().cwiseMax(-1.0).cwiseMin(1.0);
      const PosedPoints here = posed_points(one.g, box.pose(t));
      const double number = row.number(PointLook(here, home, one.options), item);
      const Interval read = row.read(at(u, t)), all = row.read({lower(u), upper(u)});
      const double room = 1e-13 * (1.0 + std::abs(number));
      out +=
          !(read.lo - room <= number && number <= read.hi + room && all.lo - room <= number && number <= all.hi + room);
    }
  }
  return out;
}

int wrong_distances(const Case& one, double half, Random& random) {
  const PoseBox box{one, half};
  const FormPose pose = box.forms();
  const FormHome form_home(one.g, one.home, one.options);
  const AsBuilt drawn{one.g};
  const FormLook look(drawn, pose, form_home);
  const PosedPoints home = posed_points(one.g, one.home);
  int out = 0;
  for (int pair = 0; pair < leg_pairs; ++pair) {
    const LegPairForms legs = leg_pair_forms(look, pair);
    const PoseForm above = squared_distance_above(legs);
    for (const FormVector& direction : {fixed_direction(legs), turning_direction(legs)}) {
      out += half < 1e-3 && !is_known(direction.x);
      const EndDistances ends = end_distances(legs, direction);
      for (int n = 0; n < 20; ++n) {
        const Vec6 t = random.matrix<Vec6>().cwiseMax(-1.0).cwiseMin(1.0);
        const PosedPoints here = posed_points(one.g, box.pose(t));
        const double distance = leg_clearance_row.number(PointLook(here, home, one.options), pair);
        double least = std::numeric_limits<double>::infinity();
        for (const PoseForm& end : ends.along) least = std::min(least, at(end, t).lo);
        out += !(distance * distance <= at(above, t).hi + 1e-13) || least > distance + 1e-13;
      }
    }
  }
  return out;
}

Broken broken_by(const PoseRow& row) {
  Random random(28);
  Broken out;
  for (int n = 0; n < cases(12); ++n) {
    const Case one(random, n);
    out.slopes += wrong_slopes(row, one);
    if (row.form != nullptr)
      for (const double half : {1e-6, 0.02, 0.2}) out.forms += wrong_forms(row, one, half, random);
  }
  return out;
}

template <int error>
PoseRow planted(const PoseRow& sound) {
  static PoseRow row;
  row = sound;
  PoseRow out = sound;
  if constexpr (error == 0)
    out.slopes = [](const PointLook& look, int item, PointSlopes& slopes) {
      const double value = row.slopes(look, item, slopes);
      for (int k = 0; k < slopes.points; ++k) slopes.at[at_index(k)].slope *= 1.0 + 1e-5;
      return value;
    };
  if constexpr (error == 1)
    out.number = [](const PointLook& look, int item) { return row.number(look, item) * (1.0 + 1e-6); };
  if constexpr (error == 2)
    out.form = [](const FormLook& look, int item) {
      PoseForm u = row.form(look, item);
      u.r *= 0.01;
      return u;
    };
  return out;
}

}  // namespace

TEST_SUITE("law") {
  TEST_CASE("every row of a pose keeps the law") {
    int rows = 0;
    for (const LimitRow& row : limit_rows()) {
      if (row.pose == nullptr) continue;
      ++rows;
      CAPTURE(std::string(row.info.name));
      const Broken broken = broken_by(*row.pose);
      CHECK(broken.slopes == 0);
      CHECK(broken.forms == 0);
      for (int item = 0; item < row.pose->items; ++item) CHECK(!row.pose->part(item).empty());
    }
    CHECK(rows >= 8);
  }

  TEST_CASE("u of a number is what the number is read from") {
    for (const LimitRow& row : limit_rows()) {
      if (row.pose == nullptr || row.pose->read == nullptr) continue;
      CAPTURE(std::string(row.info.name));
      for (const double number : {0.05, 0.3, 0.9}) {
        const Interval read = row.pose->read(row.pose->smooth(number));
        CHECK(contains(read, number));
        CHECK(width(read) < 1e-13);
        CHECK((row.pose->smooth(0.5).hi < row.pose->smooth(0.4).lo) == row.pose->falls);
      }
    }
  }

  TEST_CASE("a determinant, the determinants of the kernels and a limit that also holds on the way are the same rows") {
    for (const LimitRow& row : limit_rows()) {
      const bool sign = row.info.kind == LimitKind::sign;
      CHECK(row.on_the_way() == sign);
      if (sign) CHECK(row.pose->items == 3);
      if (row.pose != nullptr && row.pose->cone_body >= 0)
        CHECK(row.pose->first_at_body + row.pose->items <= legs_at_body);
      if (row.pose != nullptr && row.pose->pairs) CHECK(row.pose->items == leg_pairs);
    }
  }

  TEST_CASE("distances of legs are within their bounds") {
    Random random(5);
    for (int n = 0; n < cases(30); ++n) {
      const Case one(random, n);
      for (const double half : {1e-6, 0.02, 0.2}) CHECK(wrong_distances(one, half, random) == 0);
    }
  }

  TEST_CASE("a planted error breaks the law") {
    for (const LimitRow& row : limit_rows()) {
      if (row.pose == nullptr) continue;
      CAPTURE(std::string(row.info.name));
      CHECK(broken_by(planted<0>(*row.pose)).any());
      CHECK(broken_by(planted<1>(*row.pose)).any());
      if (row.pose->form != nullptr) CHECK(broken_by(planted<2>(*row.pose)).any());
    }
  }

  TEST_CASE("kernels agree with rows, and numerators with determinants") {
    Random random(6);
    for (int n = 0; n < 200; ++n) {
      const Case one(random, n);
      const PosedPoints here = posed_points(one.g, one.here), home = posed_points(one.g, one.home);
      const PointLook look(here, home, one.options);
      const Eigen::Matrix<double, 3, 3, Eigen::RowMajor> q = one.here.rotation;
      const batch::Configurations c{one.here.position.data(), q.data(), one.here.internal_point.data(), 1, 0, 0, 0};
      std::array<double, 9> lengths;
      std::array<double, 3> det;
      batch::leg_lengths(one.g, c, lengths.data());
      batch::singularity_margins(one.g, c, det.data());
      for (int leg = 0; leg < 9; ++leg)
        CHECK(leg_length_row.number(look, leg) == doctest::Approx(lengths[at_index(leg)]).epsilon(1e-13));
      const FormHome form_home(one.g, one.home, one.options);
      const AsBuilt drawn{one.g};
      const FormPose pose = form_pose(one.here);
      for (int k = 0; k < 3; ++k) {
        const double value = singularity_free_row.number(look, k), side = look.side(k);
        CHECK(std::abs(value - side * det[at_index(k)]) <= 1e-13);
        CHECK(side == form_home.side[at_index(k)]);
        const PoseForm numerator = singularity_free_row.numerator(FormLook(drawn, pose, form_home), k);
        if (std::abs(value) > 1e-10) CHECK(numerator.c * value > 0.0);
      }
    }
  }

  TEST_CASE("the numbers of the public header are those of the rows") {
    Random random(8);
    const Case one(random, 0);
    const PosedPoints here = posed_points(one.g, one.here), home = posed_points(one.g, one.home);
    for (const std::string& name : limits_of_poses()) {
      const LimitNumbers numbers(name, one.g, one.home, 1.0, one.options);
      const PoseRow& row = *limit_row(name).pose;
      REQUIRE(numbers.items() == row.items);
      REQUIRE(limit_parts(name).size() == static_cast<std::size_t>(row.items));
      std::vector<double> found(limit_parts(name).size());
      numbers.at(one.here, found.data());
      for (int item = 0; item < row.items; ++item)
        CHECK(found[at_index(item)] == row.number(PointLook(here, home, one.options), item));
    }
    CHECK(limits_over_lengths() == std::vector<std::string>{"leg_ratio", "stroke_ratio", "stroke"});
    CHECK_THROWS_WITH_AS(LimitNumbers("height", one.g, one.home, 1.0), doctest::Contains("height"), InvalidArgument);
    Triple same = one.g.base_internal();
    same[1] = one.g.base_external()[2];
    const Geometry coupled(one.g.base_external(), same, one.g.platform_external(), one.g.platform_internal());
    const std::array<bool, 21> exempt = pairs_sharing_a_joint(coupled);
    for (int pair = 0; pair < leg_pairs; ++pair)
      CHECK(exempt[at_index(pair)] == (leg_clearance_row.part(pair) == "l3-r2"));
  }

  TEST_CASE("rows of the design: slopes, and intervals that hold the value") {
    Random random(7);
    for (const LimitRow& row : limit_rows()) {
      if (row.design == nullptr) continue;
      CAPTURE(std::string(row.info.name));
      for (int n = 0; n < 20; ++n) {
        const Case one(random, n);
        const Points at = points(one.g, {Vec3::Zero(), Mat3::Identity(), Vec3::Zero()});
        const Joints joints = std::span(at).first<12>();
        for (const Side side : {Side::high, Side::low})
          for (int item = 0; item < row.design->items(side); ++item) {
            const auto [a, b] = row.design->joints(joints, side, item);
            Eigen::Matrix<double, 8, 1> x;
            x << joints[at_index(a)], joints[at_index(b)], 4.0, 2.2;
            const auto touched = [](const auto& v) {
              using T = std::decay_t<decltype(v[0])>;
              return Touched<T>{{v[0], v[1], v[2]}, {v[3], v[4], v[5]}, v[6], v[7]};
            };
            const DesignSlopes slopes = row.design->slopes(touched(x), item);
            Eigen::Matrix<double, 8, 1> by;
            by << slopes.a, slopes.b, slopes.zp, slopes.zs;
            for (Eigen::Index k = 0; k < 8; ++k) {
              const auto number = [&](double h) {
                Eigen::Matrix<double, 8, 1> y = x;
                y[k] += h;
                return row.design->number(touched(y), item);
              };
              CHECK(by[k] == doctest::Approx((number(1e-5) - number(-1e-5)) / 2e-5).epsilon(1e-6).scale(1.0));
            }
            std::array<Interval, 8> enclosed;
            for (std::size_t k = 0; k < 8; ++k) enclosed[k] = Interval(x[static_cast<Eigen::Index>(k)]);
            const double value = row.design->number(touched(x), item);
            CHECK(slopes.value == doctest::Approx(value).epsilon(1e-15));
            CHECK(contains(row.design->enclosure(touched(enclosed), item), value));
          }
      }
    }
  }
}
