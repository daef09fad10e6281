#include <benchmark/benchmark.h>

#include <memory>

#include "ninedof/redundancy/redundancy_map.hpp"
#include "redundancy/map/continuation.hpp"
#include "support/data.hpp"
#include "support/figure.hpp"

namespace bench {
namespace {

constexpr std::size_t side = 32;  // of a grid of poses; a piece is a row of it

/// A plane of poses of the published design at its height, and their best points.
struct Plane {
  ninedof::Geometry geometry = ninedof::Geometry::hexagonal(0.0, 5.8124, 2.9062, 0.0);
  ninedof::InternalPointProblem problem;
  std::vector<ninedof::PlatformPose> poses;
  ninedof::InternalPointMap map;

  ninedof::InternalPointMap placed() const {
    ninedof::MapSettings settings;
    settings.threads = 1;
    return ninedof::best_internal_map(geometry, {poses, {side, side}, {}}, problem, settings);
  }
};

std::shared_ptr<const Plane> plane(bool limited) {
  Plane out;
  if (limited) {
    out.problem.limits.low.tail<6>().setConstant(2.2);
    out.problem.limits.high.tail<6>().setConstant(4.4);
  }
  const double step = 3.0 / (side - 1);
  for (std::size_t k = 0; k < side * side; ++k) {
    const double x = step * static_cast<double>(k / side) - 1.5, y = step * static_cast<double>(k % side) - 1.5;
    out.poses.push_back({ninedof::Vec3(x, y, 3.9828), ninedof::Mat3::Identity()});
  }
  out.map = out.placed();
  return std::make_shared<const Plane>(std::move(out));
}

ninedof::InternalPoint searched(const Plane& p, std::size_t k) {
  return ninedof::best_internal_point(p.geometry, p.poses[k].position, p.poses[k].rotation, p.problem);
}

Figures figures_of(const std::string& name, const std::shared_ptr<const Plane>& data) {
  Figures out;
  int as_good = 0;
  for (std::size_t k = 0; k < side * side; ++k) {
    const ninedof::InternalPoint one = searched(*data, k);
    require(one.status == ninedof::InternalPointStatus::found, "a pose of the plane has no best O");
    as_good += data->map.points[k].value <= one.value * (1.0 + 1e-6);
  }
  out.counted.push_back({name + ", in a map: at least as good as searched", as_good, side * side, true});

  const auto by_row = [data](auto function) {
    return [data, function](std::size_t row) {
      for (std::size_t k = row * side + 1; k < (row + 1) * side; ++k) benchmark::DoNotOptimize(function(*data, k));
    };
  };
  const auto continued = [](const Plane& p, std::size_t k) {
    const std::vector<ninedof::Guess> guess{{p.map.points[k - 1].s, 0.0}};
    return ninedof::continued_from(p.geometry, p.poses[k], p.problem, {}, guess, {});
  };
  out.timed.push_back({name + ", from a neighbour's",
                       "best_internal_point",
                       side,
                       side - 1,
                       by_row(continued),
                       by_row(searched),
                       {},
                       false,
                       3});
  const auto whole = [data](std::size_t) { benchmark::DoNotOptimize(data->placed()); };
  const auto one_by_one = [data](std::size_t) {
    for (std::size_t k = 0; k < side * side; ++k) benchmark::DoNotOptimize(searched(*data, k));
  };
  out.timed.push_back({name + ", map of 1024, seeds and audit included",
                       "best_internal_point",
                       1,
                       side * side,
                       whole,
                       one_by_one,
                       {},
                       false,
                       3});
  return out;
}

}  // namespace

Figures redundancy() {
  Figures out = figures_of("best O", plane(false));
  Figures limited = figures_of("best O within limits", plane(true));
  for (Figure& f : limited.timed) out.timed.push_back(std::move(f));
  for (Count& c : limited.counted) out.counted.push_back(std::move(c));
  return out;
}

}  // namespace bench
