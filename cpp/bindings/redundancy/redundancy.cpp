#include <algorithm>
#include <map>
#include <optional>
#include <vector>

#include "ninedof/math/parallel.hpp"
#include "ninedof/redundancy/redundancy_map.hpp"
#include "ninedof/redundancy/redundancy_path.hpp"
#include "support/interruptible.hpp"
#include "support/module.hpp"
#include "support/poses.hpp"
#include "support/struct.hpp"

namespace ninedof::python {
namespace {

/// Those of n poses; a class of its own, as Python has the columns.
struct InternalPoints : std::vector<InternalPoint> {
  using vector::vector;
  explicit InternalPoints(std::vector<InternalPoint> points) : vector(std::move(points)) {}
};

/// Bits of `active` of each point; few sets of bounds occur.
py::array_t<std::uint32_t> active_of(const InternalPoints& points) {
  py::array_t<std::uint32_t> out(std::ssize(points));
  std::ranges::transform(points, out.mutable_data(), [](const InternalPoint& p) { return p.active.bits(); });
  return out;
}

/// Indices into internal_point_statuses.
py::array_t<std::uint8_t> statuses_of(const InternalPoints& points) {
  py::array_t<std::uint8_t> out(std::ssize(points));
  std::ranges::transform(points, out.mutable_data(),
                         [](const InternalPoint& p) { return static_cast<std::uint8_t>(p.status); });
  return out;
}

py::dict names_of(const InternalPoints& points) {
  std::map<std::uint32_t, ActiveBounds> bounds;
  for (const InternalPoint& p : points) bounds.emplace(p.active.bits(), p.active);
  py::dict out;
  for (const auto& [bits, set] : bounds) out[py::int_(bits)] = py::tuple(py::cast(set.names()));
  return out;
}

void bind_points(py::module_& m) {
  py::class_<InternalPoints>(m, "InternalPoints", "The internal points of n poses, in columns.")
      .def_property_readonly(
          "internal_point",
          [](const InternalPoints& points) {
            std::vector<Vec3> out;
            for (const InternalPoint& p : points) out.push_back(p.s);
            return array_from(out);
          },
          "O, lengths, base frame, shape (n, 3); NaN where there is none.")
      .def_property_readonly(
          "value",
          [](const InternalPoints& points) {
            std::vector<double> out;
            for (const InternalPoint& p : points) out.push_back(p.value);
            return column<double>(out);
          },
          "Of the criterion, shape (n,).")
      .def_property_readonly("status", &statuses_of, "Indices into internal_point_statuses, shape (n,).")
      .def_property_readonly("active", &active_of, "A bit for each active bound, shape (n,).")
      .def_property_readonly("active_names", &names_of, "The words of each number in `active`.");
  py::class_<InternalPointMap>(m, "InternalPointMap", "The internal points of a grid.")
      .def_property_readonly(
          "points", [](const InternalPointMap& map) { return InternalPoints(map.points); },
          "One for each pose of the grid.")
      .def_readonly("audit", &InternalPointMap::audit, "Of the map before what it found was entered.")
      .def_readonly("searched", &InternalPointMap::searched, "Poses that were searched, audited ones included.")
      .def_readonly("followed", &InternalPointMap::followed, "Local optima continued from a neighbour.");
}

InternalPoints best_points(const Geometry& g, const Array& position, const Array& rotation, const Array& start,
                           const InternalPointProblem& problem, int threads) {
  validate(problem);
  const std::vector<PlatformPose> poses = poses_from(position, rotation);
  const std::vector<Vec3> starts = points_from("start", start);
  if (!starts.empty() && starts.size() != poses.size())
    throw InvalidArgument("start", std::to_string(starts.size()) + " rows", std::to_string(poses.size()));
  return interruptible(py::none(), [&](const Control& control) {
    InternalPoints points(poses.size());
    parallel_for(static_cast<long>(poses.size()), 4, threads, [&](long first, long last) {
      for (auto k = static_cast<std::size_t>(first); k < static_cast<std::size_t>(last); ++k) {
        if (control.stop.stop_requested()) throw Stopped{};
        const std::optional<Vec3> from = starts.empty() ? std::nullopt : std::optional(starts[k]);
        points[k] = best_internal_point(g, poses[k].position, poses[k].rotation, problem, from);
      }
    });
    return points;
  });
}

InternalPoints best_path(const Geometry& g, const Array& position, const Array& rotation,
                         const std::optional<Vec3>& start, const InternalPointProblem& problem, double smoothness) {
  validate(problem);
  const std::vector<PlatformPose> poses = poses_from(position, rotation);
  return interruptible(py::none(), [&](const Control& control) {
    return InternalPoints(best_internal_path(g, poses, problem, smoothness, start, control));
  });
}

InternalPointMap best_map(const Geometry& g, const Array& position, const Array& rotation,
                          const std::vector<std::size_t>& shape, const Array& start,
                          const InternalPointProblem& problem, const MapSettings& settings,
                          const py::object& progress) {
  validate(problem);
  const std::vector<PlatformPose> poses = poses_from(position, rotation);
  const std::vector<Vec3> starts = points_from("start", start);
  return interruptible(progress, [&](const Control& control) {
    return best_internal_map(g, {poses, shape, starts}, problem, settings, control);
  });
}

}  // namespace

void bind_redundancy(py::module_& m) {
  bind_points(m);
  py::list statuses;
  for (int k = 0; k <= static_cast<int>(InternalPointStatus::missing); ++k)
    statuses.append(to_string(static_cast<InternalPointStatus>(k)));
  m.attr("internal_point_statuses") = statuses;
  auto problem = request<InternalPointProblem>(m, "InternalPointProblem", "What an internal point is best for.");
  word_attribute(problem, "criterion", &InternalPointProblem::criterion,
                 std::array{"condition_number", "singularity", "leg_centring"}, "What is optimised over O.");
  problem.def_readwrite("limits", &InternalPointProblem::limits, "Of the lengths of legs.")
      .def_readwrite("characteristic_length", &InternalPointProblem::characteristic_length, "Of the condition number.")
      .def_readwrite("clearance", &InternalPointProblem::clearance, "Lower bound of each determinant.");
  request<MapSettings>(m, "MapSettings", "How the map of a grid is searched.")
      .def_readwrite("seed_every", &MapSettings::seed_every, "Poses per seed.")
      .def_readwrite("audit_every", &MapSettings::audit_every, "Poses per audited pose.")
      .def_readwrite("audit_seed", &MapSettings::audit_seed, "Selects them.")
      .def_readwrite("threads", &MapSettings::threads, "0: one for each processor.");
  m.def("best_internal_point", &best_points);
  m.def("best_internal_path", &best_path);
  m.def("best_internal_map", &best_map);
}

}  // namespace ninedof::python
