/// The checker of sets of designs: its numbers over boxes hold those of the library at designs and poses drawn from
/// them, which share nothing with it; and what becomes of changed files.

#include "proof/checker/replay.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <sstream>

#include "ninedof/conditioning/conditioning.hpp"
#include "ninedof/conditioning/locked_legs.hpp"
#include "ninedof/limits/numbers.hpp"
#include "ninedof/proof/admissible.hpp"
#include "ninedof/robot/legs.hpp"
#include "proof/checker/spelling.hpp"
#include "proof/checker/workspace.hpp"
#include "support/support.hpp"

using namespace ninedof;
using namespace support;
namespace sets = ninedof::checker::sets;
using sets::Want;

namespace {

Limit limited(const std::string& name, double low, double high, Unit of = Unit::length,
              const Vec3& axis = Vec3::Zero()) {
  Limit out;
  out.name = name;
  if (low > 0.0) out.low = low;
  out.high = high;
  out.of = of;
  out.axis = axis;
  return out;
}

struct Kind {
  std::string family;
  std::vector<double> at;
  std::vector<int> varied;
};
const std::vector<Kind> kinds{
    {"hexagonal", {0.4, 6.0, 3.0, 0.3, 5.0, 3.0, 0.2}, {1, 2, 4, 6}},
    {"symmetric", {4.0, 3.5, 0.7, 2.0, 0.9, 2.2, -0.4, 5.0, 3.0}, {0, 2, 4, 8}},
    {"symmetric_nonplanar", {4.0, 3.5, 0.7, 2.0, 0.9, 2.2, -0.4, 5.0, 3.0, 0.1, -0.2, 0.3, 0.05}, {1, 3, 9, 12}},
    {"general", {}, {0, 10, 22, 36}},
};

Duty duty_where(InternalMotion internal) {
  Duty out;
  out.loads = {{Vec3(3.0, -2.0, 4.0), Vec3(5.0, 1.0, -10.0), Vec3(0.5, -1.0, 0.2)},
               {Vec3::Zero(), Vec3(-4.0, 6.0, 3.0), Vec3::Zero()}};
  out.gravity = Vec3(0.1, 0.2, -9.81);
  Masses& m = out.masses;
  m.platform = 0.7;
  m.centre = Vec3(0.1, -0.05, 0.2);
  m.internal_point = 0.1;
  for (int k = 0; k < 9; ++k) {
    m.cylinder[k] = 0.02 + 0.01 * k;
    m.cylinder_centre[k] = 0.3 + 0.1 * k;
    m.rod[k] = k % 2 == 0 ? 0.05 : 0.0;
    m.rod_centre[k] = 0.2;
  }
  out.motion.internal = internal;
  out.motion.linear_speed = 0.8;
  out.motion.angular_speed = 0.2;
  return out;
}

/// Every limit that has bounds, poses of each kind.
DesignQuestion question(const Kind& kind, Region::Shape shape, bool in_zp, double half) {
  DesignQuestion out;
  out.problem.family = kind.family;
  const DesignFamily& family = design_family(kind.family);
  out.at = kind.at;
  for (std::size_t k = out.at.size(); k < family.variables().size(); ++k)
    out.at.push_back(0.5 * (family.variables()[k].low + family.variables()[k].high));
  if (kind.family == "general") out.at[36] = 5.0, out.at[37] = 3.0;
  for (const double x : out.at) out.problem.variables.push_back({x, x});
  out.varied = kind.varied;
  for (const int k : kind.varied) {
    out.low.push_back(out.at[static_cast<std::size_t>(k)] - half);
    out.high.push_back(out.at[static_cast<std::size_t>(k)] + half);
  }
  Region region;
  region.shape = shape;
  const double unit = in_zp ? 0.2 : 1.0;
  region.size = unit * Vec3(0.5, 0.4, 0.3);
  if (shape == Region::Shape::path)
    region.corners = {unit * Vec3(-0.5, 0, 0), unit * Vec3(0, 0.4, 0), unit * Vec3(0.1, 0.4, 0.6)};
  region.tilt = 0.2;
  region.yaw = 0.3;
  region.in_zp = in_zp;
  region.shifted = !in_zp;
  out.region = {region};
  Pose pose;
  pose.position = Vec3(0.1, 0.2, -0.1);
  pose.rotation = Vec3(0.1, -0.4, 0.5);
  pose.internal = Vec3(0.0, 0.1, 0.1);
  pose.in_zp = in_zp;
  out.problem.objective.poses = {pose};
  out.problem.tool.position = Vec3(0.1, -0.2, 0.3);
  out.problem.tool.rotation = Vec3(0.2, 0.1, -0.3);
  out.problem.limits = {limited("leg_length", 3.0, 7.0),
                        limited("upper_length", 0.3, 1.2, Unit::zp),
                        limited("base_cone", 0.0, 0.5),
                        limited("platform_cone", 0.0, 0.4),
                        limited("base_cone_internal", 0.0, 0.8, Unit::length, Vec3(0.1, 0.2, 1.0)),
                        limited("platform_cone_internal", 0.0, 0.8, Unit::length, Vec3(0.1, 0.2, 1.0)),
                        limited("platform_cone_external", 0.0, 2.6, Unit::length, Vec3(0.1, 0.2, 1.0)),
                        limited("leg_clearance", 0.2, infinity),
                        limited("singularity_free", 0.01, infinity),
                        limited("stroke_ratio", 0.0, 1.3),
                        limited("stroke", 0.0, 0.4, Unit::zp),
                        limited("leg_ratio", 0.0, 2.0),
                        limited("radius_ratio", 1.2, 2.0),
                        limited("zs_fraction", 0.5, 0.7),
                        limited("height", 4.9, 5.1),
                        limited("footprint", 3.0, 4.0),
                        limited("joint_height", 0.0, 0.08, Unit::radius),
                        limited("joint_spacing", 0.4, infinity, Unit::radius),
                        limited("force", 0.0, 40.0),
                        limited("rate", 0.0, 1.3),
                        limited("power", 0.0, 50.0),
                        limited("upper_rate", 0.0, 0.6),
                        limited("lower_force", 0.0, 20.0)};
  const auto duty = std::make_shared<const Duty>(duty_where(static_cast<InternalMotion>(shape)));
  for (std::size_t k = 18; k < out.problem.limits.size(); ++k) out.problem.limits[k].duty = duty;
  out.condition = 9.0;
  return out;
}

struct DrawnDesign {
  sets::Cube cube{};
  Eigen::VectorXd x;
};
/// The limits of lengths, angles, determinants and distances, as the checker has their margins.
double margin_of(const DesignQuestion& q, const Want& want, const DrawnDesign& design, const Configuration& at,
                 const Configuration& other) {
  const Geometry g = geometry(q.problem, design.x);
  const Configuration home = configurations(q.problem, design.x).front();
  const double zp = design.x[design_family(q.problem.family).index("zp")];
  const double zs = design.x[design_family(q.problem.family).index("zs")];
  if (want.limit == 1) return want.item == 0 ? zp - zs : zs;
  const auto n = static_cast<std::size_t>(want.limit - 2);
  const bool condition = n == q.problem.limits.size() && want.limit > 0;
  const Limit limit = want.limit == 0 ? limited("singularity_free", 0.0, infinity)
                      : condition     ? limited("condition_number", 0.0, q.condition)
                                      : q.problem.limits[n];
  const double bound = want.limit == 0 ? 0.0 : (want.high ? limit.high : limit.low) * (limit.of == Unit::zp ? zp : 1.0);
  if (condition) return bound - condition_number(g, at, q.problem.characteristic_length.value);
  if (want.about == Want::About::spread) {
    const double longest = leg_lengths(g, at)[want.item], shortest = leg_lengths(g, other)[want.second];
    return limit.name == "stroke" ? bound - longest + shortest : bound * shortest - longest;
  }
  if (want.about == Want::About::design) {
    const Geometry own = design_family(q.problem.family).geometry({design.x.data(), q.at.size()});
    std::vector<Vec3> joints;
    for (const Triple* t :
         {&own.base_external(), &own.base_internal(), &own.platform_external(), &own.platform_internal()})
      joints.insert(joints.end(), t->begin(), t->end());
    const auto radius = [&](std::size_t first, std::size_t count) {
      double most = 0.0;
      for (std::size_t k = first; k < first + count; ++k) most = std::max(most, joints[k].head<2>().norm());
      return most;
    };
    const double sign = want.high ? 1.0 : -1.0;
    if (limit.name == "height") return sign * (bound - zp);
    if (limit.name == "zs_fraction") return sign * (bound * zp - zs);
    if (limit.name == "footprint") return sign * (bound - radius(0, 6));
    if (limit.name == "radius_ratio") return sign * (bound * radius(6, 6) - radius(0, 6));
    double least = infinity;
    for (std::size_t i = 0; i < 12; ++i) {
      if (limit.name == "joint_height") least = std::min(least, bound * radius(0, 12) - std::abs(joints[i].z()));
      for (std::size_t j = i - i % 6; j < i && limit.name == "joint_spacing"; ++j)
        least = std::min(least, (joints[i] - joints[j]).norm() - bound * radius(i - i % 6, 6));
    }
    return least;
  }
  const LimitNumbers numbers(limit.name, g, home, 1.0, limit.options());
  std::array<double, 21> all{};
  numbers.at(at, all.data());
  if (want.about == Want::About::duty) return bound - *std::ranges::max_element(all);
  const bool internal = limit.name.ends_with("internal") || limit.name.starts_with("upper");
  const double value = all[static_cast<std::size_t>(internal ? want.item - 3 : want.item)];
  switch (want.about) {
    case Want::About::length: return (want.high ? 1.0 : -1.0) * (bound * bound - value * value);
    case Want::About::cone: return std::cos(value) - std::cos(bound);
    default: return value - bound;
  }
}

/// A pose of a patch, as the library has it; the corners of boxes as often as what is between.
Configuration drawn_pose(const DesignQuestion& q, const DrawnDesign& design, const sets::Patch& patch,
                         std::mt19937_64& random, sets::Patch& at) {
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  at = patch;
  for (std::size_t k = 0; k < 6; ++k) {
    const double t = unit(random);
    at.low[k] = at.high[k] = patch.low[k] + (t < 0.25   ? 0.0
                                             : t > 0.75 ? 1.0
                                                        : 2.0 * t - 0.5) *
                                                (patch.high[k] - patch.low[k]);
  }
  const std::vector<Configuration> listed = configurations(q.problem, design.x);
  if (patch.piece < 0) return listed[static_cast<std::size_t>(-1 - patch.piece)];
  Region region = q.region.front();
  Vec6 x;
  std::copy(at.low.begin(), at.low.end(), x.begin());
  if (region.shape == Region::Shape::path) {  // the same point of its part alone
    const auto k = static_cast<std::size_t>(patch.piece);
    region.corners = {region.corners[k], region.corners[k + 1]};
    x[0] = 2.0 * x[0] - 1.0;
  }
  region.tool_height = (listed.front().position - configurations(
                                                      [&] {
                                                        Problem own = q.problem;
                                                        own.tool = {};
                                                        return own;
                                                      }(),
                                                      design.x)
                                                      .front()
                                                      .position)
                           .z();
  return region.configuration(x, listed.front());
}

sets::DesignsFile designs_of(const std::string& bytes) {
  std::istringstream in(bytes);
  checker::Stream file(in);
  return sets::read_designs(file);
}

std::string resealed(const std::string& file, const std::string& from, const std::string& to) {
  std::string body = file.substr(file.find("family"));
  const std::size_t at = body.find(from);
  REQUIRE_MESSAGE(at != std::string::npos, from);
  body.replace(at, from.size(), to);
  return checker::sealed(sets::kind_of_designs, body);
}

}  // namespace

TEST_SUITE("replay") {
  TEST_CASE("numbers over boxes hold those of designs and poses in them") {
    std::mt19937_64 random(11);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    std::array<int, 9> known{}, broken{};
    for (const Kind& kind : kinds)
      for (const Region::Shape shape :
           {Region::Shape::box, Region::Shape::ball, Region::Shape::cylinder, Region::Shape::path})
        for (const double half : {1e-6, 0.02}) {
          const DesignQuestion q = question(kind, shape, shape == Region::Shape::ball || half > 0.01, half);
          DesignSet nothing;
          nothing.pieces.resize(1);
          std::copy(q.low.begin(), q.low.end(), nothing.pieces[0].low.begin());
          std::copy(q.high.begin(), q.high.end(), nothing.pieces[0].high.begin());
          const sets::DesignsFile file = designs_of(design_certificate(q, nothing));
          std::vector<std::string> unknown;
          const std::vector<Want> wants = sets::wants_of(file, unknown);
          REQUIRE(unknown.empty());
          sets::Cube cube{};
          for (std::size_t k = 0; k < 4; ++k) cube[k] = {q.low[k], q.high[k]};
          const sets::Weigher weigher(file, cube);
          std::vector<sets::Patch> roots = sets::all_poses(file);
          roots.push_back({});
          for (int n = 0; n < cases(12); ++n) {
            const auto smaller = [&](sets::Patch patch) {
              const double share = n % 3 == 0 ? 0.0 : half;  // a single pose too
              for (std::size_t k = 0; k < 6; ++k) {
                const double middle = patch.low[k] + unit(random) * (patch.high[k] - patch.low[k]);
                const double width = share * (patch.high[k] - patch.low[k]);
                patch.low[k] = std::max(patch.low[k], middle - width);
                patch.high[k] = std::min(patch.high[k], middle + width);
              }
              return patch;
            };
            const auto any = [&] {
              return roots[static_cast<std::size_t>(unit(random) * static_cast<double>(roots.size()))];
            };
            const sets::Spot spot{smaller(any()), smaller(any())};
            DrawnDesign design;
            design.x = Eigen::Map<const Eigen::VectorXd>(q.at.data(), static_cast<Eigen::Index>(q.at.size()));
            for (std::size_t k = 0; k < 4; ++k)
              design.x[q.varied[k]] = q.low[k] + unit(random) * (q.high[k] - q.low[k]);
            sets::Spot at;
            const Configuration here = drawn_pose(q, design, spot.at, random, at.at),
                                there = drawn_pose(q, design, spot.other, random, at.other);
            if (sets::beside(file, at.at) || sets::beside(file, at.other)) continue;
            for (const Want& want : wants) {
              const sets::Weighed found = weigher.weigh(want, spot);
              const double margin = margin_of(q, want, design, here, there);
              INFO(kind.family << " limit " << want.limit << " item " << want.item << " " << want.second << " half "
                               << half << " piece " << spot.at.piece << " margin " << margin << " low " << found.low);
              const bool sign = want.about == Want::About::condition || want.about == Want::About::duty ||
                                want.limit == 0 || want.limit == 19;  // of another size
              const auto about = static_cast<std::size_t>(want.about);
              const double slack = 1e-12;
              if (!sign || found.low > 0.0) CHECK(margin > (sign ? -1e-9 : found.low - slack));
              if (n % 3 == 0 && found.high < 0.0) CHECK(margin < slack);
              if (found.low > 0.0) ++known[about];
              if (n % 3 == 0 && found.high < 0.0) ++broken[about];
              // Narrow boxes leave little open.
              if (n % 3 == 0 && half < 1e-3 && std::abs(margin) > 0.01 && want.limit > 0)
                CHECK((margin > 0.0 ? found.low > 0.0 : found.high < 0.0));
            }
          }
        }
    for (const int count : known) CHECK(count > 10);
    for (std::size_t k = 1; k < broken.size(); ++k)
      if (k != static_cast<std::size_t>(Want::About::determinant)) CHECK(broken[k] > 0);
  }

  TEST_CASE("sums, products and curves of linear numbers hold the exact ones") {
    using checker::Linear;
    std::mt19937_64 random(12);
    std::uniform_real_distribution<double> unit(-1.0, 1.0);
    const auto positive = [&](double width) {
      Linear out(2.0 + unit(random), 0.1 * width);
      for (double& a : out.a) a = 0.1 * width * unit(random);
      return out;
    };
    for (int n = 0; n < cases(4000); ++n) {
      const double width = n % 2 == 0 ? 1.0 : 0.1;
      const Linear x = positive(width), y = positive(width);
      std::array<double, checker::symbols> t;
      for (double& one : t) one = n % 3 == 0 ? unit(random) : std::copysign(1.0, unit(random));
      if (n % 5 == 0)
        for (std::size_t k = 0; k < t.size(); ++k) t[k] = std::copysign(1.0, x.a[k]);  // where it is greatest
      const auto at = [&](const Linear& z, double error) {
        double out = z.c + error * z.r;
        for (std::size_t k = 0; k < t.size(); ++k) out += z.a[k] * t[k];
        return out;
      };
      const double a = at(x, std::copysign(1.0, unit(random))), b = at(y, std::copysign(1.0, unit(random)));
      const auto holds = [&](const Linear& z, double exact) {
        CHECK(std::abs(at(z, 0.0) - exact) <= z.r + 1e-13);  // the rounding of this line
        CHECK(z.r < 20.0 * width);
      };
      holds(x + y, a + b);
      holds(x - y, a - b);
      holds(3.0 * x, 3.0 * a);
      holds(x * y, a * b);
      holds(x * x, a * a);
      holds(checker::sine(x), std::sin(a));
      holds(checker::cosine(x), std::cos(a));
      holds(checker::of_angle_squared(x, 1), std::sin(std::sqrt(a)) / std::sqrt(a));
      holds(checker::of_angle_squared(x, 2), (1.0 - std::cos(std::sqrt(a))) / a);
      if (!(checker::lower_end(x) > 0.3)) continue;
      holds(checker::square_root(x), std::sqrt(a));
      holds(checker::inverse(x), 1.0 / a);
      holds(checker::inverse_root(x), 1.0 / std::sqrt(a));
    }
    CHECK_FALSE(checker::lower_end(checker::inverse(Linear(0.0, 1.0))) > -infinity);
  }

  TEST_CASE("a bound of the condition number is not confirmed where a design passes it, and near by it is") {
    std::mt19937_64 random(13);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    int confirmed = 0, broken = 0;
    for (const Kind& kind : kinds)
      for (int n = 0; n < cases(24); ++n) {
        if (kind.family == "general") continue;  // coupled plates, whose condition number hardly changes
        const double half = n % 2 == 0 ? 3e-4 : 0.01;
        const int locked = n % 4 < 2 ? -1 : 3 + n / 4 % 6;
        const DesignQuestion q = question(kind, Region::Shape::box, false, half);
        DesignSet nothing;
        nothing.pieces.resize(1);
        const sets::DesignsFile file = designs_of(design_certificate(q, nothing));
        sets::Patch patch = sets::all_poses(file).front();
        for (std::size_t k = 0; k < 6; ++k) {
          const double middle = patch.low[k] + unit(random) * (patch.high[k] - patch.low[k]);
          patch.low[k] = middle;
          patch.high[k] = middle + (n % 3 == 0 || k % 2 == 0 ? 0.0 : half);
        }
        sets::Cube cube{};
        for (std::size_t k = 0; k < 4; ++k) cube[k] = {q.low[k], q.high[k]};
        double least = infinity, most = 0.0;
        for (int m = 0; m < 200; ++m) {
          DrawnDesign design;
          design.x = Eigen::Map<const Eigen::VectorXd>(q.at.data(), static_cast<Eigen::Index>(q.at.size()));
          for (std::size_t k = 0; k < 4; ++k) design.x[q.varied[k]] = unit(random) < 0.5 ? q.low[k] : q.high[k];
          sets::Patch at;
          const Configuration here = drawn_pose(q, design, patch, random, at);
          const Geometry g = geometry(q.problem, design.x);
          const double length = q.problem.characteristic_length.value;
          const PosedPoints there = posed_points(g, here);
          const double kappa = locked < 0 ? condition_number(g, here, length)
                                          : LockedLegs(there.at, there.legs, length).condition_number({locked});
          least = std::min(least, kappa);
          most = std::max(most, kappa);
        }
        const sets::Mount m = sets::mount(file, cube);
        const sets::Stand at = sets::stand(file, m, patch);
        CHECK(sets::condition_within(m, at, file.length, most * (1.0 - 1e-9), locked) < 1);
        CHECK(sets::condition_within(m, at, file.length, 0.9 * least, locked) < 1);
        if (half < 0.001) confirmed += sets::condition_within(m, at, file.length, most * 1.01, locked) == 1;
        if (n % 3 != 0) continue;
        CHECK(sets::condition_within(m, at, file.length, least * (1.0 + 1e-9), locked) > -1);
        if (half < 0.001) broken += sets::condition_within(m, at, file.length, least * 0.99, locked) == -1;
      }
    CHECK(confirmed > cases(30));
    CHECK(broken > cases(10));
  }

  TEST_CASE("a singularity is between a pose and the home of each design") {
    // At home O is below the plate in some of the designs, at the pose with O held below in all.
    DesignQuestion q = question(kinds[0], Region::Shape::box, true, 0.02);
    q.varied = {1, 2, 5, 6};
    q.low[2] = 4.99;
    q.high[2] = 5.03;
    q.problem.tool = {};
    DesignSet nothing;
    nothing.pieces.resize(1);
    const sets::DesignsFile file = designs_of(design_certificate(q, nothing));
    sets::Patch lifted = sets::all_poses(file).front();
    lifted.low = lifted.high = {0.0, 0.0, 0.06, 0.0, 0.0, 0.0};
    const Want upper{Want::About::determinant, 0, 2};
    sets::Cube cube{};
    for (std::size_t k = 0; k < 4; ++k) cube[k] = {q.low[k], q.high[k]};
    CHECK_FALSE(sets::Weigher(file, cube).weigh(upper, {lifted, lifted}).high < 0.0);
    cube[2].a = 5.01;
    CHECK(sets::Weigher(file, cube).weigh(upper, {lifted, lifted}).high < 0.0);
  }

  TEST_CASE("the part of a box below a plane is that of many points, whatever its slopes") {
    std::mt19937_64 random(7);
    std::uniform_real_distribution<double> even(-1.0, 1.0), power(-9.0, 0.0);
    constexpr int steps = 40;
    for (int n = 0; n < 300; ++n) {
      checker::Linear x(even(random), n % 3 == 0 ? 0.1 : 0.0);
      for (std::size_t k = 0; k < 3; ++k)
        x.a[k] = n % 7 == 0 && k == 1 ? 0.0 : even(random) * std::pow(10.0, power(random));
      long surely = 0, perhaps = 0;
      for (int i = 0; i < steps * steps * steps; ++i) {
        const auto place = [&](int of) { return (2.0 * (of % steps) + 1.0) / steps - 1.0; };
        const double at = x.c + x.a[0] * place(i) + x.a[1] * place(i / steps) + x.a[2] * place(i / steps / steps);
        surely += at + x.r < 0.0 ? 1 : 0;
        perhaps += at - x.r < 0.0 ? 1 : 0;
      }
      const checker::Range share = sets::share_below_zero(x);
      const double all = std::pow(steps, 3.0), room = 3.0 / steps;
      CHECK(share.a <= static_cast<double>(surely) / all + room);
      CHECK(share.a >= static_cast<double>(surely) / all - room);
      CHECK(share.b <= static_cast<double>(perhaps) / all + room);
      CHECK(share.b >= static_cast<double>(perhaps) / all - room);
      const double level = x.c - 0.2;
      for (const sets::Point& t : sets::corners_beyond({x.a[0], x.a[1], x.a[2]}, level))
        CHECK(x.a[0] * t[0] + x.a[1] * t[1] + x.a[2] * t[2] >= level - 1e-12);
    }
    checker::Linear one(0.0);
    one.a[0] = one.a[1] = one.a[2] = 1.0;
    one.c = 2.0;  // an eighth of the sides is cut off at a corner: (1/2)^3 / 6
    CHECK(sets::share_below_zero(one).a == doctest::Approx(1.0 / 48.0));
    CHECK(sets::share_below_zero(one).b == doctest::Approx(1.0 / 48.0));
    CHECK(sets::share_below_zero(checker::unknown_number()) == checker::Range(0.0, 1.0));
  }

  TEST_CASE("a genuine certificate is proved, and refused once it says more") {
    DesignQuestion q;
    q.problem.variables = {{0.0, 0.0}, {2.0, 10.0}, {1.0, 5.0}, {0.0, 0.0}, {5.0, 5.0}, {3.0, 3.0}, {0.0, 0.0}};
    q.problem.limits = {limited("leg_length", 0.0, 6.6)};
    q.at = {0.0, 6.0, 3.0, 0.0, 5.0, 3.0, 0.0};
    q.varied = {2, 1};  // not in the order of the family
    q.low = {1.0, 2.0};
    q.high = {5.0, 10.0};
    q.condition = 6.0;
    DesignSettings settings;
    settings.resolution = 0.1;
    const DesignSet set = admissible_designs(q, settings);
    const std::string file = design_certificate(q, set);
    const checker::Verdict good = checker::check(file);
    CHECK_MESSAGE(good.proved, good.words);
    CHECK(good.leaves == static_cast<long>(set.pieces.size()));

    for (const auto& [from, to] :
         {std::pair<std::string, std::string>{" outside 3", " outside 2"},
          {" undecided", " inside"},
          {" inside", " undecided"},
          {"variable a2 0x1p+1", "variable a2 0x1.8p+0"},
          {"variable zp 0x1.4p+2 0x1.4p+2", "variable zp 0x1.8p+2 0x1.8p+2"},
          {"limit condition_number 0x0p+0 0x1.8p+2", "limit condition_number 0x0p+0 0x1p+2"},
          {"limit condition_number 0x0p+0 0x1.8p+2 length poses", "limit fault_tolerant 0x0p+0 0x1p+2 length poses"}}) {
      INFO(from << " -> " << to);
      const checker::Verdict bad = checker::check(resealed(file, from, to));
      CHECK_FALSE(bad.proved);
      CHECK_FALSE(bad.words.empty());
    }
    std::string damaged = file;
    damaged[file.size() / 2] = static_cast<char>(damaged[file.size() / 2] ^ 1);
    CHECK_FALSE(checker::check(damaged).proved);
    CHECK_FALSE(checker::check(file.substr(0, file.size() / 2)).proved);

    DesignSet without = set;
    without.demands.clear();
    CHECK_THROWS_AS(design_certificate(q, without), InvalidArgument);
  }
}
