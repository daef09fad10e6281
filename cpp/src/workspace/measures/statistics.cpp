/// Declared in ninedof/workspace/statistics.hpp.

#include "ninedof/workspace/statistics.hpp"

#include <cmath>

#include "math/numbers.hpp"
#include "ninedof/math/error.hpp"
#include "workspace/chart.hpp"
#include "workspace/criteria/placement.hpp"

namespace ninedof {

WorkspacePoses poses_of(const Geometry& g, const WorkspaceDomain& domain, const InternalPointRule& rule,
                        const WorkspaceMap& map, bool first_piece_alone) {
  if (domain.archetype == Archetype::reachable || domain.archetype == Archetype::inclusive)
    throw InvalidArgument("archetype", "a set of rotations", "one rotation at each pose");
  if (rule.kind == InternalPointRule::Kind::best) throw InvalidArgument("internal_point", "\"best\"", "a formula");
  const Chart chart(domain);
  const Placement placement(g, rule, {});
  const double undivided = map.resolution > 0 ? chart.box_volume() / std::pow(map.resolution, 3) : 1.0;
  WorkspacePoses out;
  for (std::size_t n = 0; n < map.cells.size(); ++n) {
    const double fraction = map.cells.fraction[n];
    if (!(fraction > 0.0) || (first_piece_alone && map.cells.piece[n] != 0)) continue;
    const Vec3& at = map.cells.centre[n];
    const Vec3 p = chart.positional() ? at : domain.position;
    const Mat3 q = chart.positional() ? domain.rotations.front() : chart.rotation(at);
    out.coordinates.push_back(at);
    out.configurations.push_back({p, q, placement.point(p, q)});
    out.weights.push_back(fraction * std::ldexp(undivided, -3 * map.cells.level[n]) * chart.density(at));
    out.inner.push_back(fraction >= 0.5);
  }
  return out;
}

IndexStatistics statistics_of(const WorkspacePoses& poses, std::span<const double> values, bool by_modulus) {
  if (values.size() != poses.size())
    throw InvalidArgument("values", std::to_string(values.size()) + " numbers", std::to_string(poses.size()));
  IndexStatistics out;
  double total = 0.0, sum = 0.0, least = infinity, greatest = -infinity;
  for (std::size_t n = 0; n < values.size(); ++n) {
    if (std::isnan(values[n])) continue;
    total += poses.weights[n];
    sum += poses.weights[n] * values[n];
    if (poses.inner[n] == 0) continue;
    const double size = by_modulus ? std::abs(values[n]) : values[n];
    if (size < least || std::isnan(out.least)) {
      least = size;
      out.least = values[n];
      out.least_at = poses.coordinates[n];
    }
    if (size > greatest || std::isnan(out.greatest)) {
      greatest = size;
      out.greatest = values[n];
      out.greatest_at = poses.coordinates[n];
    }
  }
  if (!(total > 0.0) || std::isnan(out.least)) return {};
  out.mean = sum / total;
  return out;
}

}  // namespace ninedof
