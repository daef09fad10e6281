#include "workspace/cells/best_points.hpp"

#include <algorithm>
#include <bit>

#include "math/numbers.hpp"
#include "math/splitmix.hpp"

namespace ninedof {
namespace {

constexpr double audited = 1.0 / 128.0;  // of the poses

/// Whether a pose is searched as well: by chance, but always the same.
bool drawn(const Vec3& x, std::size_t r) {
  std::uint64_t z = r;
  for (const double value : x) z = (z ^ std::bit_cast<std::uint64_t>(value)) * 0x9E3779B97F4A7C15ULL + (z >> 29);
  return uniform_from(z) < audited;
}

}  // namespace

void BestPoints::reserve(std::size_t count) {
  kept_.resize(count * margins_.poses(), Vec3::Constant(not_a_number));
  mapped_.resize(count, 0);
}

void BestPoints::map(const std::vector<Vec3>& x, const std::vector<std::size_t>& shape,
                     const std::vector<std::size_t>& numbers, int threads, const std::stop_token& stop) {
  std::vector<PlatformPose> poses;
  for (std::size_t r = 0; r < margins_.poses(); ++r) {
    poses.clear();
    for (const Vec3& at : x) poses.push_back(margins_.pose(at, r));
    const InternalPointMap found = margins_.placement().best(PoseGrid{poses, shape, {}}, threads, stop);
    if (!found.complete) throw Stopped{};
    for (std::size_t n = 0; n < numbers.size(); ++n) keep(numbers[n], r, found.points[n].s);
    audit_.poses += found.audit.poses;
    audit_.missed += found.audit.missed;
    audit_.largest = std::max(audit_.largest, found.audit.largest);
  }
  for (const std::size_t number : numbers) mapped_[number] = 1;
}

InternalPoint BestPoints::at(std::size_t number, std::size_t r, const PlatformPose& pose) const {
  return margins_.placement().found_before(pose, kept(number, r));
}

InternalPoint BestPoints::between(const Anchors& from, const Vec3& x, std::size_t r, const PlatformPose& pose) {
  const auto& [a, b] = from;
  const Vec3 &s = kept(a.number, r), &t = kept(b.number, r);
  const double reach = branch_reach(margins_.size(), std::max(distance(x, a.x), distance(x, b.x)));
  std::vector<Guess> guesses;
  if ((s - t).norm() < 2.0 * reach) {
    const Vec3 way = b.x - a.x;
    guesses.push_back({s + std::clamp((x - a.x).dot(way) / way.squaredNorm(), 0.0, 1.0) * (t - s), reach});
  } else {
    for (const Vec3& known : {s, t})
      if (!known.hasNaN()) guesses.push_back({known, reach});
  }
  const InternalPoint followed = margins_.placement().best(pose, guesses);
  if (guesses.empty() || !drawn(x, r) || followed.s.hasNaN()) return followed;
  const InternalPoint searched = margins_.placement().best(pose);
  note(followed, searched);
  return searched.value < followed.value ? searched : followed;
}

double BestPoints::distance(const Vec3& x, const Vec3& y) const {
  const Chart& chart = margins_.chart();
  return (chart.positional() ? 1.0 : chart.turning() * margins_.size()) * (x - y).norm();
}

void BestPoints::note(const InternalPoint& followed, const InternalPoint& searched) {
  const double lost = followed.value / searched.value - 1.0;  // NaN where the search found nothing
  const std::lock_guard lock(guard_);
  ++audit_.poses;
  if (!(lost > MapAudit::deficit)) return;
  ++audit_.missed;
  audit_.largest = std::max(audit_.largest, lost);
}

}  // namespace ninedof
