/// Workspaces: volumes known in closed form, parts of the search compared with brute force, the same bits for any
/// number of threads. The Python tests compare whole maps with plain numpy.

#include "ninedof/workspace/workspace.hpp"

#include <doctest/doctest.h>

#include "ninedof/limits/numbers.hpp"
#include "ninedof/math/rotation.hpp"
#include "ninedof/workspace/certified.hpp"
#include "support/support.hpp"
#include "workspace/cells/leaf.hpp"
#include "workspace/cells/tetrahedra.hpp"
#include "workspace/chart.hpp"
#include "workspace/criteria/limits.hpp"
#include "workspace/measures/near_points.hpp"
#include "workspace/sequence.hpp"

using namespace support;
using namespace ninedof;

namespace {

/// Positions at which leg l1 is at most `radius` long: a ball.
struct BallOfOneLeg {
  WorkspaceDomain domain;
  WorkspaceCriteria criteria;
  Vec3 centre = published.base_external()[0] - published.platform_external()[0];

  explicit BallOfOneLeg(double radius, double room = 1.2) {
    domain.low = centre - Vec3::Constant(room * radius);
    domain.high = centre + Vec3::Constant(room * radius);
    criteria.legs = LegLimits{};
    criteria.legs->high[0] = radius;
  }
};

Vec3 corner(int n) {
  return {static_cast<double>(n & 1), static_cast<double>((n >> 1) & 1), static_cast<double>(n >> 2)};
}

/// Margins at the corners of the unit cell that are linear in it.
std::array<PointMargins, 8> linear(const Vec3& normal, double offset) {
  std::array<PointMargins, 8> out;
  for (int n = 0; n < 8; ++n) {
    out[static_cast<std::size_t>(n)].margin[0] = normal.dot(corner(n)) + offset;
    out[static_cast<std::size_t>(n)].limit[0] = 7;
  }
  return out;
}

Corners pointers(const std::array<PointMargins, 8>& m) {
  Corners out;
  for (std::size_t n = 0; n < 8; ++n) out[n] = &m[n];
  return out;
}

}  // namespace

TEST_SUITE("workspace") {
  TEST_CASE("a ball has the volume, the surface, and the inscribed ball and box of the closed form") {
    const BallOfOneLeg ball(2.0);
    const double exact = 4.0 / 3.0 * pi * 8.0;
    for (const double tolerance : {1e-2, 1e-3, 1e-4}) {
      if (sanitized && tolerance < 1e-3) continue;
      WorkspaceSettings settings;
      settings.tolerance = tolerance;
      const WorkspaceMap map = workspace(published, ball.domain, {}, ball.criteria, settings);
      REQUIRE(map.status == WorkspaceStatus::converged);
      CHECK(map.error <= tolerance * map.volume);
      CHECK(std::abs(map.volume - exact) <= map.error);
      CHECK(relative_error(map.boundary_area, 16.0 * pi) < 0.3 * tolerance + 1e-4);
      CHECK(relative_error(map.ball.radius, 2.0) < 2e-3);
      CHECK((map.ball.centre - ball.centre).norm() < 2e-3);
      // The largest box in a ball is a cube, and a poor optimum is at most a little smaller.
      CHECK((map.box.high - map.box.low).prod() > 0.9 * std::pow(4.0 / std::sqrt(3.0), 3.0));
      for (int n = 0; n < 8; ++n) {
        const Vec3 at = map.box.low + corner(n).cwiseProduct(map.box.high - map.box.low);
        CHECK((at - ball.centre).norm() <= 2.0 + 1e-12);
      }
      CHECK(map.limit_area[limit::leg_high] == map.boundary_area);
      CHECK_FALSE(map.box_limits);
      CHECK(map.pieces.size() == 1);
    }
  }

  TEST_CASE("same bits for any number of threads") {
    const BallOfOneLeg ball(1.5);
    WorkspaceCriteria criteria = ball.criteria;
    criteria.condition_number = 12.0;
    criteria.limits = {{.name = "leg_clearance", .low = 0.05}};
    WorkspaceSettings settings;
    settings.points = 2000;
    settings.tolerance = 5e-3;
    for (const auto method :
         {WorkspaceSettings::Method::octree, WorkspaceSettings::Method::grid, WorkspaceSettings::Method::sample}) {
      settings.method = method;
      criteria.limits.resize(1);
      if (method != WorkspaceSettings::Method::sample) criteria.limits.push_back({.name = "singularity_free"});
      settings.threads = 1;
      const WorkspaceMap one = workspace(published, ball.domain, {}, criteria, settings);
      for (const int threads : {2, 5}) {
        settings.threads = threads;
        const WorkspaceMap other = workspace(published, ball.domain, {}, criteria, settings);
        CHECK(one.volume == other.volume);
        CHECK(one.error == other.error);
        CHECK(one.evaluations == other.evaluations);
        CHECK(one.cells.fraction == other.cells.fraction);
        CHECK(one.cells.limit == other.cells.limit);
      }
    }
  }

  TEST_CASE("a plane through a cell leaves the exact volume and area") {
    Random random(3);
    for (int trial = 0; trial < 200; ++trial) {
      const Vec3 normal = random.unit();
      const double offset =
          -normal.dot(Vec3(random.uniform(0.0, 1.0), random.uniform(0.0, 1.0), random.uniform(0.0, 1.0)));
      const std::array<PointMargins, 8> margins = linear(normal, offset);
      CutCell cell(pointers(margins), 1);
      // Along the steepest axis the plane is a height over the two others: integrate that.
      int axis = 0;
      normal.cwiseAbs().maxCoeff(&axis);
      const int a = (axis + 1) % 3, b = (axis + 2) % 3, steps = 400;
      double held = 0.0, seen = 0.0;
      for (int i = 0; i < steps; ++i)
        for (int k = 0; k < steps; ++k) {
          const double height =
              -(offset + normal[a] * (i + 0.5) / steps + normal[b] * (k + 0.5) / steps) / normal[axis];
          const double below = std::clamp(height, 0.0, 1.0);
          held += normal[axis] > 0.0 ? 1.0 - below : below;
          seen += height > 0.0 && height < 1.0 ? 1.0 : 0.0;
        }
      CHECK(std::abs(cell.fraction() - held / (steps * steps)) < 1e-5);
      std::vector<CutCell::Piece> pieces;
      cell.boundary(Vec3::Ones(), pieces);
      double area = 0.0;
      for (const CutCell::Piece& piece : pieces) {
        CHECK(piece.limit == 7);
        area += piece.area;
      }
      CHECK(std::abs(area - seen / (steps * steps) / std::abs(normal[axis])) < 1e-2);
    }
  }

  TEST_CASE("of two limits the one met first makes the boundary") {
    std::array<PointMargins, 8> margins = linear(Vec3(1.0, 0.0, 0.0), -0.25);  // x > 1/4
    for (int n = 0; n < 8; ++n) {
      PointMargins& m = margins[static_cast<std::size_t>(n)];
      m.margin[1] = 1000.0 * (0.75 - corner(n).x());  // x < 3/4, in another unit
      m.limit[1] = 9;
    }
    // No corner is allowed: a slab thinner than the cell is what division, not this, must find.
    CHECK(CutCell(pointers(margins), 2).fraction() == 0.0);
    for (int n = 0; n < 8; ++n) margins[static_cast<std::size_t>(n)].margin[0] += 0.25;  // x > 0
    CutCell cell(pointers(margins), 2);
    CHECK(cell.fraction() == doctest::Approx(0.75));
    std::vector<CutCell::Piece> pieces;
    cell.boundary(Vec3::Ones(), pieces);
    for (const CutCell::Piece& piece : pieces) CHECK(piece.limit == 9);
  }

  TEST_CASE("charts convert rotations both ways, and have the Haar measure of known regions") {
    Random random(4);
    WorkspaceDomain domain;
    domain.archetype = Archetype::orientation;
    domain.rotations = {random.rotation()};
    WorkspaceSettings settings;
    if (sanitized) settings.tolerance = 2e-2;
    for (const auto chart : {OrientationRegion::Chart::rotation_vector, OrientationRegion::Chart::tilt_torsion}) {
      domain.region = {chart, 1.2, -1.0, 0.7};
      const Chart c(domain);
      for (int n = 0; n < 50; ++n) {
        const Vec3 x = 0.6 * random.unit();
        CHECK((c.coordinates(c.rotation(x)) - x).norm() < 1e-12);
      }
      // Nothing forbids anything: the volume is the region's own, of a closed form that shares nothing with the
      // density.
      const WorkspaceMap map = workspace(published, domain, {}, {}, settings);
      CHECK(std::abs(map.volume - c.volume()) <= std::max(map.error, 1e-3 * map.volume));
      CHECK(map.box_limits);
    }
    domain.region = {OrientationRegion::Chart::rotation_vector, pi, 0.0, 0.0};
    CHECK(Chart(domain).volume() == doctest::Approx(8.0 * pi * pi));
    CHECK(relative_error(workspace(published, domain, {}, {}, settings).volume, 8.0 * pi * pi) <
          (sanitized ? 2e-2 : 1e-3));
    // The tilt of tilt and torsion is the angle between the platform's axis and that of Q0.
    domain.region = {OrientationRegion::Chart::tilt_torsion, 1.0, -3.0, 3.0};
    domain.rotations = {Mat3::Identity()};
    const Mat3 q = Chart(domain).rotation({0.3, 0.4, 1.1});
    CHECK(std::acos(q(2, 2)) == doctest::Approx(0.5));
    CHECK(std::atan2(q(1, 2), q(0, 2)) == doctest::Approx(std::atan2(0.4, 0.3)));
  }

  TEST_CASE("rotations of a set are spread by the Haar measure") {
    const std::vector<Mat3> all = spread_rotations(2000);
    CHECK(all.front() == Mat3::Identity());
    Mat3 mean = Mat3::Zero();
    int within = 0;
    for (const Mat3& q : all) {
      mean += q / 2000.0;
      within += log_rotation(q).norm() < 1.5 ? 1 : 0;
    }
    CHECK(mean.cwiseAbs().maxCoeff() < 0.01);
    CHECK(std::abs(within / 2000.0 - (1.5 - std::sin(1.5)) / pi) < 0.01);
    int rim = 0;
    for (const Mat3& q : spread_rotations(101, 0.4)) {
      const double angle = log_rotation(q).norm();
      CHECK(angle <= 0.4 + 1e-9);
      rim += angle > 0.4 - 1e-9 ? 1 : 0;
    }
    CHECK(rim == 50);
  }

  TEST_CASE("distance to the nearest of many points") {
    Random random(5);
    std::vector<Vec3> points;
    for (int n = 0; n < 300; ++n)
      points.push_back({random.uniform(0.0, 2.0), random.uniform(0.0, 0.5), random.uniform(0.0, 7.0)});
    const NearPoints near(Vec3::Zero(), Vec3(2.0, 1.0, 7.0), points);
    for (int n = 0; n < 300; ++n) {
      const Vec3 x(random.uniform(-0.5, 2.5), random.uniform(-0.5, 1.5), random.uniform(-1.0, 8.0));
      double least = infinity;
      for (const Vec3& point : points) least = std::min(least, (point - x).norm());
      CHECK(near.distance(x) == doctest::Approx(least).epsilon(1e-14));
    }
    CHECK(NearPoints(Vec3::Zero(), Vec3::Ones(), {}).distance(Vec3::Zero()) == infinity);
  }

  TEST_CASE("cells of different sizes that share a face form one piece") {
    const BallOfOneLeg ball(1.0);
    const Chart chart(ball.domain);
    const auto leaf = [](std::uint32_t i, std::uint32_t j, std::uint32_t k, std::uint8_t level, double measure) {
      Leaf l;
      l.cell = {i, j, k, level};
      l.state = CellState::inside;
      l.inside = 255;
      l.fraction = 1.0;
      l.measure = measure;
      return l;
    };
    std::vector<Leaf> leaves{leaf(0, 0, 0, 0, 1.0), leaf(2, 1, 1, 1, 0.125), leaf(3, 3, 3, 0, 3.0),
                             leaf(2, 2, 2, 1, 0.125)};
    const std::vector<double> pieces = find_pieces(leaves, 4, chart, {});
    REQUIRE(pieces.size() == 3);
    CHECK(pieces == std::vector<double>{3.0, 1.125, 0.125});  // the last touches the second at an edge only
    CHECK(leaves[0].piece == leaves[1].piece);
    const Vec3 home = chart.low() + 0.1 * (chart.high() - chart.low());
    CHECK(find_pieces(leaves, 4, chart, home).front() == 1.125);
    CHECK(leaves[2].piece == 1);
    const Vec3 elsewhere = chart.low() + Vec3(0.9, 0.1, 0.1).cwiseProduct(chart.high() - chart.low());
    CHECK(find_pieces(leaves, 4, chart, elsewhere).front() == 0.0);
  }

  TEST_CASE("an empty and a full box, a home outside, a stop before the first level") {
    BallOfOneLeg ball(2.0);
    ball.criteria.legs->high[1] = 0.01;
    ball.criteria.legs->high[2] = 0.01;
    const WorkspaceMap empty = workspace(published, ball.domain, {}, ball.criteria);
    CHECK(empty.status == WorkspaceStatus::empty);
    CHECK(empty.volume == 0.0);
    CHECK(empty.unseen == 0.0);  // proved by the lengths alone
    CHECK(std::isnan(empty.conditioning_index));

    const BallOfOneLeg small(2.0, 0.5);
    const WorkspaceMap whole = workspace(published, small.domain, {}, small.criteria);
    CHECK(whole.box_limits);
    CHECK(whole.volume == doctest::Approx(8.0));
    CHECK(whole.ball.radius == doctest::Approx(1.0));

    const BallOfOneLeg again(2.0);
    WorkspaceCriteria connected = again.criteria;
    connected.limits = {{.name = "singularity_free"}};
    Configuration home;
    home.position = again.centre + Vec3(2.3, 0.0, 0.0);
    home.internal_point = Vec3(0.0, 0.0, 1.0);
    const WorkspaceMap outside = workspace(published, again.domain, {}, connected, {}, home);
    CHECK_FALSE(outside.home_allowed);
    CHECK(limit_names()[static_cast<std::size_t>(outside.home_limit)] == "l1 high");
    CHECK(outside.status == WorkspaceStatus::empty);
    CHECK(outside.pieces.front() == 0.0);

    std::stop_source source;
    source.request_stop();
    const WorkspaceMap stopped =
        workspace(published, again.domain, {}, again.criteria, {}, {}, {source.get_token(), {}});
    CHECK(stopped.status == WorkspaceStatus::stopped);
    CHECK(std::isnan(stopped.volume));
  }

  TEST_CASE("a stop keeps the last complete level") {
    const BallOfOneLeg ball(2.0);
    WorkspaceSettings settings;
    settings.tolerance = 1e-5;
    std::stop_source source;
    const WorkspaceMap map = workspace(published, ball.domain, {}, ball.criteria, settings, {},
                                       {source.get_token(), [&](long done, long expected, double) {
                                          CHECK(expected >= done);
                                          if (done > 60'000) source.request_stop();
                                        }});
    CHECK(map.status == WorkspaceStatus::stopped);
    REQUIRE_FALSE(map.levels.empty());
    CHECK(map.volume == map.levels.back().volume);
    CHECK(relative_error(map.volume, 4.0 / 3.0 * pi * 8.0) < 1e-2);
  }

  TEST_CASE("pairs of legs that share a joint may meet if they are exempt, and others may not") {
    BallOfOneLeg ball(1.5);
    ball.criteria.limits = {{.name = "leg_clearance", .low = 0.05}};
    WorkspaceSettings settings;
    settings.tolerance = 2e-2;
    settings.points = 1000;
    const auto map = [&](const std::array<bool, 21>& exempt) {
      ball.criteria.exempt = exempt;
      return workspace(published, ball.domain, {}, ball.criteria, settings);
    };
    const auto certified = [&] {
      return certified_workspace(published, ball.domain, {}, ball.criteria, {.gap = 0.3, .boxes = 2000});
    };
    // Each external leg of this robot has an internal one at either end.
    const std::array<bool, 21> shared = pairs_sharing_a_joint(published);
    REQUIRE(std::ranges::count(shared, true) == 6);
    CHECK(map(all_pairs).volume == map(shared).volume);
    CHECK(map(shared).volume > 1.0);
    CHECK(certified().volume.low > 1.0);
    std::array<bool, 21> less = shared;
    *std::ranges::find(less, true) = false;
    CHECK(pairs_sharing_a_joint(published, less) == less);
    const WorkspaceMap empty = map(less);
    CHECK(empty.status == WorkspaceStatus::empty);
    REQUIRE(empty.home_limit >= 0);
    CHECK(limit_names()[static_cast<std::size_t>(empty.home_limit)].starts_with("leg_clearance "));
    CHECK(certified().volume.low == 0.0);
  }

  TEST_CASE("invalid arguments are named") {
    const BallOfOneLeg ball(2.0);
    const auto with = [&](const auto& change) {
      WorkspaceDomain d = ball.domain;
      WorkspaceCriteria c = ball.criteria;
      WorkspaceSettings s;
      change(d, c, s);
      return message_of([&] { workspace(published, d, {}, c, s); });
    };
    CHECK(with([](auto& d, auto&, auto&) { d.low[1] = d.high[1]; }).starts_with("box (y): got "));
    CHECK(with([](auto& d, auto&, auto&) { d.high[2] = infinity; }).starts_with("box (z): got "));
    CHECK(with([](auto& d, auto&, auto&) { d.low[0] = not_a_number; }).starts_with("box (x): got "));
    CHECK(with([](auto& d, auto&, auto&) { d.rotations.clear(); }).starts_with("rotations: got "));
    CHECK(with([](auto&, auto& c, auto&) {
            c.legs->low[4] = 9.0, c.legs->high[4] = 8.0;
          }).starts_with("limits of q2: got "));
    CHECK(with([](auto&, auto& c, auto&) { c.condition_number = 0.5; }).starts_with("condition_number: got "));
    CHECK(with([](auto&, auto& c, auto&) {
            c.limits = {{.name = "base_cone", .high = -1.0}};
          }).starts_with("base_cone: got "));
    CHECK(with([](auto&, auto& c, auto&) {
            c.limits = {{.name = "leg_clearance", .low = not_a_number}};
          }).starts_with("leg_clearance: got "));
    CHECK(with([](auto&, auto& c, auto&) {
            c.limits = {{.name = "stroke", .high = 1.0}};
          }).starts_with("criteria: got "));
    CHECK(with([](auto&, auto& c, auto&) {
            c.limits = {{.name = "leg_clearance", .low = 0.1, .of = Unit::zp}};
          }).starts_with("leg_clearance: got "));
    CHECK(with([](auto&, auto&, auto& s) { s.tolerance = 0.0; }).starts_with("tolerance: got "));
    CHECK(with([](auto&, auto&, auto& s) { s.resolution = 1; }).starts_with("resolution: got "));
    CHECK(with([](auto&, auto& c, auto& s) {
            s.method = WorkspaceSettings::Method::sample;
            c.limits = {{.name = "singularity_free"}};
          }).starts_with("method: got "));
  }
}
