#include "ninedof/redundancy/redundancy_map.hpp"

#include <string>

#include "ninedof/math/error.hpp"
#include "redundancy/map/wavefront.hpp"

namespace ninedof {
namespace {

void require_period(const char* name, std::size_t every) {
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

InternalPointMap best_internal_map(const Geometry& g, const PoseGrid& grid, const InternalPointProblem& problem,
                                   const MapSettings& settings, const Control& control) {
  validate(problem);
  validate(grid);
  require_period("seed_every", settings.seed_every);
  require_period("audit_every", settings.audit_every);
  return map_by_wavefront(g, grid, problem, settings, control);
}

}  // namespace ninedof
