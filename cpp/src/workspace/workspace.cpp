#include "ninedof/workspace/workspace.hpp"

#include <algorithm>
#include <cmath>

#include "ninedof/math/error.hpp"
#include "workspace/measures/summary.hpp"
#include "workspace/methods/sampling.hpp"
#include "workspace/requirements.hpp"

namespace ninedof {
namespace {

void require_whole(const char* name, long value, long least, long most) {
  if (value < least || value > most)
    throw InvalidArgument(name, std::to_string(value),
                          "a whole number from " + std::to_string(least) + " to " + std::to_string(most));
}

/// Throws InvalidArgument naming the argument that is not valid.
void require_workspace(const WorkspaceDomain& domain, const InternalPointRule& rule, const WorkspaceCriteria& criteria,
                       const WorkspaceSettings& settings, const std::optional<Configuration>& home) {
  require_question(domain, rule, criteria, home);
  using Method = WorkspaceSettings::Method;
  for (const Limit& limit : criteria.limits)
    if (settings.method == Method::sample && limit_row(limit.name).on_the_way())
      throw InvalidArgument("method", "\"sample\" with " + limit.name,
                            "\"octree\" or \"grid\": a sample has no neighbouring cells");
  require_whole("resolution", settings.resolution, 2, settings.method == Method::grid ? 512 : 128);
  require_whole("points", settings.points, 1, 100'000'000);
  require_whole("shifts", settings.shifts, 2, 1000);
  require_whole("most_evaluations", settings.most_evaluations, 1, 1'000'000'000);
  require_positive("tolerance", settings.tolerance);
}

void map_by_octree(const LimitsAtPoints& margins, const WorkspaceSettings& settings, bool connected,
                   const Control& control, WorkspaceMap& map) {
  CellLattice lattice(margins, settings.resolution, settings.threads);
  Octree tree = grow_octree(margins, lattice, settings, connected, map.home_allowed, control);
  map.status = tree.status;
  map.levels = tree.levels;
  map.evaluations = tree.evaluations;
  map.resolution = settings.resolution;
  map.internal_points = lattice.audit();
  if (tree.levels.empty()) return;  // stopped before the first level
  map.volume = tree.levels.back().volume;
  map.error = tree.levels.back().error;
  map.pieces = find_pieces(tree.leaves, settings.resolution, margins.chart(),
                           connected ? std::optional(margins.home()) : std::nullopt, map.home_allowed);
  // The extrapolated volume is distributed over the pieces.
  double found = 0.0;
  for (std::size_t n = 0; n < (connected ? std::min<std::size_t>(1, map.pieces.size()) : map.pieces.size()); ++n)
    found += map.pieces[n];
  if (found > 0.0)
    for (double& piece : map.pieces) piece *= map.volume / found;
  map.unseen = tree.unseen;
  if (!(map.volume > 0.0) && map.status != WorkspaceStatus::stopped) map.status = WorkspaceStatus::empty;
  const Surface surface = surface_of(tree, lattice, margins, connected, settings.resolution);
  map.limit_area = surface.area;
  summarize(tree.leaves, lattice, connected, map);
  if (map.status != WorkspaceStatus::stopped) inscribe(tree.leaves, lattice, margins, surface, connected, control, map);
}

}  // namespace

const char* to_string(WorkspaceStatus status) {
  switch (status) {
    case WorkspaceStatus::converged: return "converged";
    case WorkspaceStatus::limited: return "limited";
    case WorkspaceStatus::empty: return "empty";
    case WorkspaceStatus::stopped: return "stopped";
  }
  return "";
}

WorkspaceMap workspace(const Geometry& g, const WorkspaceDomain& domain, const InternalPointRule& rule,
                       const WorkspaceCriteria& criteria, const WorkspaceSettings& settings,
                       const std::optional<Configuration>& home, const Control& control) {
  require_workspace(domain, rule, criteria, settings, home);
  const LimitsAtPoints margins(g, domain, rule, criteria, home);
  WorkspaceMap map;
  map.low = margins.chart().low();
  map.high = margins.chart().high();
  map.chart_volume = margins.chart().volume();
  map.limit_area.assign(limit::count(), 0.0);
  try {
    PointMargins at_home;
    margins.evaluate(&margins.home(), 1, &at_home, control.stop);
    map.home_allowed = at_home.allowed(margins.groups());
    if (!map.home_allowed) map.home_limit = static_cast<std::int16_t>(margins.violated(at_home));
    if (!margins.in_chart(margins.home())) {
      map.home_allowed = false;
      map.home_limit = static_cast<std::int16_t>(limit::box());
    }
    using enum WorkspaceSettings::Method;
    const bool connected = asks_for_connection(criteria);
    if (settings.method == octree) map_by_octree(margins, settings, connected, control, map);
    // A part of a grid or of a sample is no result: a stop leaves the map as it was.
    WorkspaceMap whole = map;
    if (settings.method == grid) map_by_grid(margins, settings, connected, control, whole);
    if (settings.method == sample) map_by_sample(margins, settings, control, whole);
    if (settings.method != octree) map = std::move(whole);
  } catch (const Stopped&) {
    map.status = WorkspaceStatus::stopped;
  }
  for (const double area : map.limit_area) map.boundary_area += area;
  map.box_limits = map.limit_area[limit::box()] > 0.0 || map.limit_area[limit::region()] > 0.0;
  return map;
}

}  // namespace ninedof
