/// Poses of cells against rotations made by Eigen and the volume of SO(3), statistics against a plain definition.

#include "ninedof/workspace/statistics.hpp"

#include "support/support.hpp"

using namespace support;
using namespace ninedof;

namespace {

/// A map of cells of one size, of which `allowed` says the share.
template <class Share>
WorkspaceMap even_map(const Vec3& low, const Vec3& high, int resolution, const Share& allowed) {
  WorkspaceMap map;
  map.low = low;
  map.high = high;
  map.resolution = resolution;
  for (int n = 0; n < resolution * resolution * resolution; ++n) {
    const Vec3 cell(n % resolution, n / resolution % resolution, n / (resolution * resolution));
    map.cells.centre.push_back(low + (cell + Vec3::Constant(0.5)).cwiseProduct(high - low) / resolution);
    map.cells.level.push_back(0);
    map.cells.fraction.push_back(allowed(map.cells.centre.back()));
    map.cells.piece.push_back(map.cells.centre.back().x() > 0.0 ? 0 : 1);
  }
  return map;
}

WorkspaceDomain rotations(OrientationRegion::Chart chart, double angle, const Mat3& centre) {
  WorkspaceDomain domain;
  domain.archetype = Archetype::orientation;
  domain.position = Vec3(0.1, -0.2, 4.0);
  domain.rotations = {centre};
  domain.region = {chart, angle, -pi, pi};
  return domain;
}

double sum(const std::vector<double>& values) {
  double out = 0.0;
  for (const double value : values) out += value;
  return out;
}

}  // namespace

TEST_SUITE("statistics") {
  TEST_CASE("the weights of all rotations sum to the volume of SO(3), in either chart") {
    using enum OrientationRegion::Chart;
    for (const auto chart : {rotation_vector, tilt_torsion}) {
      const WorkspaceMap map = even_map(Vec3::Constant(-pi), Vec3::Constant(pi), 48, [&](const Vec3& x) {
        return (chart == rotation_vector ? x.norm() : x.head<2>().norm()) < pi ? 1.0 : 0.0;
      });
      const WorkspacePoses poses = poses_of(published, rotations(chart, pi, Mat3::Identity()), {}, map, false);
      CHECK(sum(poses.weights) == doctest::Approx(8.0 * pi * pi).epsilon(3e-3));
    }
  }

  TEST_CASE("rotations are those of their coordinates, and O follows the rule") {
    Random random(1);
    const Mat3 centre = random.rotation();
    const Vec3 point(0.3, -0.4, 2.0);
    using Kind = InternalPointRule::Kind;
    using enum OrientationRegion::Chart;
    for (const auto chart : {rotation_vector, tilt_torsion}) {
      const WorkspaceDomain domain = rotations(chart, 0.9, centre);
      const WorkspaceMap map = even_map(Vec3::Constant(-0.9), Vec3::Constant(0.9), 4, [](const Vec3&) { return 1.0; });
      for (const auto kind : {Kind::fixed, Kind::platform, Kind::between}) {
        const WorkspacePoses poses = poses_of(published, domain, {kind, 0.3, point}, map, false);
        REQUIRE(poses.size() == 64);
        for (std::size_t n = 0; n < poses.size(); ++n) {
          const Vec3 x = poses.coordinates[n], tilt(-x.y(), x.x(), 0.0);
          const auto turn = [](const Vec3& v) {
            return Eigen::AngleAxisd(v.norm(), v.normalized()).toRotationMatrix();
          };
          const Mat3 q = chart == rotation_vector
                             ? Mat3(turn(x) * centre)
                             : Mat3(turn(tilt) * Eigen::AngleAxisd(x.z(), Vec3::UnitZ()).toRotationMatrix() * centre);
          const Configuration& c = poses.configurations[n];
          CHECK(c.position == domain.position);
          CHECK((c.rotation - q).norm() < 1e-13);
          Vec3 lower = Vec3::Zero(), upper = Vec3::Zero();
          for (std::size_t k = 0; k < 3; ++k) {
            lower += published.base_internal()[k] / 3.0;
            upper += (c.position + q * published.platform_internal()[k]) / 3.0;
          }
          const Vec3 s = kind == Kind::fixed      ? point
                         : kind == Kind::platform ? Vec3(c.position + q * point)
                                                  : Vec3(0.7 * lower + 0.3 * upper);
          CHECK((c.internal_point - s).norm() < 1e-13);
        }
      }
    }
  }

  TEST_CASE("positions have the rotation of the domain; what is not allowed or of another piece does not count") {
    WorkspaceDomain domain;
    domain.low = Vec3(-1.0, 0.0, 3.0);
    domain.high = Vec3(1.0, 1.0, 4.0);
    domain.rotations = {Random(2).rotation()};
    WorkspaceMap map = even_map(domain.low, domain.high, 4, [](const Vec3& x) { return x.z() > 3.5 ? 0.4 : 0.0; });
    const WorkspacePoses all = poses_of(published, domain, {}, map, false);
    CHECK(all.size() == 32);
    CHECK(sum(all.weights) == doctest::Approx(0.4 * 1.0).epsilon(1e-14));
    CHECK(std::ranges::count(all.inner, std::uint8_t{0}) == 32);
    for (const Configuration& c : all.configurations) CHECK(c.rotation == domain.rotations.front());
    const WorkspacePoses first = poses_of(published, domain, {}, map, true);
    CHECK(first.size() == 16);
    for (const Vec3& x : first.coordinates) CHECK(x.x() > 0.0);
    std::ranges::fill(map.cells.level, std::uint8_t{1});
    CHECK(sum(poses_of(published, domain, {}, map, false).weights) == doctest::Approx(0.05).epsilon(1e-14));
    map.resolution = 0;  // points of a sample have no size
    std::ranges::fill(map.cells.level, std::uint8_t{0});
    CHECK(poses_of(published, domain, {}, map, false).weights == std::vector<double>(32, 0.4));
  }

  TEST_CASE("mean and extremes are those of the definition") {
    Random random(3);
    WorkspacePoses poses;
    std::vector<double> values;
    for (int n = 0; n < 500; ++n) {
      poses.coordinates.push_back(random.unit());
      poses.weights.push_back(random.uniform(0.1, 1.0));
      poses.inner.push_back(random.sign() > 0.0);
      values.push_back(n % 7 == 0 ? not_a_number : random.uniform(-1.0, 2.0));
    }
    for (const bool by_modulus : {false, true}) {
      const IndexStatistics found = statistics_of(poses, values, by_modulus);
      std::vector<std::pair<double, std::size_t>> sizes;
      double total = 0.0, mean = 0.0;
      for (std::size_t n = 0; n < values.size(); ++n) {
        if (std::isnan(values[n])) continue;
        total += poses.weights[n];
        if (poses.inner[n] != 0) sizes.emplace_back(by_modulus ? std::abs(values[n]) : values[n], n);
      }
      for (std::size_t n = 0; n < values.size(); ++n)
        if (!std::isnan(values[n])) mean += values[n] * (poses.weights[n] / total);
      const auto [least, greatest] = std::ranges::minmax(sizes);
      CHECK(found.mean == doctest::Approx(mean).epsilon(1e-13));
      CHECK(found.least == values[least.second]);
      CHECK(found.least_at == poses.coordinates[least.second]);
      CHECK(found.greatest == values[greatest.second]);
      CHECK(found.greatest_at == poses.coordinates[greatest.second]);
    }
    std::ranges::fill(poses.inner, std::uint8_t{0});
    CHECK(std::isnan(statistics_of(poses, values, false).mean));
    CHECK(std::isnan(statistics_of({}, {}, false).least_at.x()));
    CHECK(message_of([&] { statistics_of(poses, {}, false); }).starts_with("values: got 0 numbers, expected 500"));
  }

  TEST_CASE("poses that are sets, or whose O is searched, are refused") {
    WorkspaceDomain domain;
    CHECK(message_of([&] {
            poses_of(published, domain, {InternalPointRule::Kind::best, 0.5, Vec3::Zero()}, {}, false);
          }).starts_with("internal_point: got \"best\""));
    domain.archetype = Archetype::reachable;
    CHECK(message_of([&] { poses_of(published, domain, {}, {}, false); }).starts_with("archetype: got a set"));
  }
}
