#include "ninedof/redundancy/redundancy_map.hpp"

#include <string>

#include "ninedof/math/error.hpp"
#include "redundancy/map/waves.hpp"
#include "redundancy/search/nearby.hpp"
#include "redundancy/search/pose_search.hpp"

namespace ninedof {
namespace {

void require_share(const char* name, std::size_t every) {
  if (every == 0) throw InvalidArgument(name, "0", "one or more");
}

void validate(const PoseGrid& grid) {
  const std::size_t n = grid.poses.size();
  std::size_t product = 1;
  for (const std::size_t length : grid.shape) product *= length;
  if (product != n) throw InvalidArgument("shape", std::to_string(product) + " poses", std::to_string(n));
  if (grid.starts.size() > 1 && grid.starts.size() != n)
    throw InvalidArgument("starts", std::to_string(grid.starts.size()), "none, one or " + std::to_string(n));
}

}  // namespace

InternalPoint nearby_internal_point(const Geometry& g, const Vec3& position, const Mat3& rotation,
                                    const InternalPointProblem& problem, const Vec3& start) {
  validate(problem);
  if (start.hasNaN()) return {};
  InternalPoint out = before_search(g, position, rotation, problem).point;
  if (out.status != InternalPointStatus::singular) return out;
  const Scene scene(g, position, rotation, problem);
  const Vec3 x = scene.inward(start);
  if (!in_a_chamber(scene, problem, x)) return out;
  Merit merit(scene, problem);
  merit.enter(x);
  return answer(merit, nearby_minimum(merit, x));
}

InternalPointMap best_internal_map(const Geometry& g, const PoseGrid& grid, const InternalPointProblem& problem,
                                   const MapSettings& settings, const Control& control) {
  validate(problem);
  validate(grid);
  require_share("seed_every", settings.seed_every);
  require_share("audit_every", settings.audit_every);
  return map_in_waves(g, grid, problem, settings, control);
}

}  // namespace ninedof
