#include <pybind11/stl.h>

#include <array>
#include <map>
#include <optional>
#include <vector>

#include "ninedof/redundancy/redundancy_map.hpp"
#include "ninedof/redundancy/redundancy_path.hpp"
#include "support/arrays.hpp"
#include "support/interruptible.hpp"
#include "support/map_audit.hpp"
#include "support/module.hpp"
#include "support/poses.hpp"

namespace ninedof::python {
namespace {

Criterion criterion_from(const std::string& word) {
  if (word == "condition_number") return Criterion::condition_number;
  if (word == "singularity") return Criterion::singularity;
  if (word == "leg_centring") return Criterion::leg_centring;
  throw InvalidArgument("criterion", "\"" + word + "\"", "\"condition_number\", \"singularity\" or \"leg_centring\"");
}

/// What Python has checked; see search_arguments.py.
InternalPointProblem internal_problem_from(const py::dict& d) {
  InternalPointProblem problem;
  problem.criterion = criterion_from(d["criterion"].cast<std::string>());
  const auto [low, high] = d["limits"].cast<std::pair<Array, Array>>();
  problem.limits = {Eigen::Map<const Vec9>(low.data()), Eigen::Map<const Vec9>(high.data())};
  problem.characteristic_length = d["characteristic_length"].cast<double>();
  problem.clearance = d["clearance"].cast<double>();
  validate(problem);
  return problem;
}

MapSettings map_settings_from(const py::dict& d) {
  return {d["seed_every"].cast<std::size_t>(), d["audit_every"].cast<std::size_t>(),
          d["audit_seed"].cast<std::uint64_t>(), d["threads"].cast<int>()};
}

/// n starts as (n, 3), which Python has checked; no rows mean the default.
std::vector<Vec3> starts_from(const Array& start) {
  std::vector<Vec3> out(static_cast<std::size_t>(start.size() / 3));
  for (std::size_t k = 0; k < out.size(); ++k) out[k] = Eigen::Map<const Vec3>(start.data() + 3 * k);
  return out;
}

/// Columns of n rows. Statuses are indices into internal_point_statuses, `active` keys of `active_names`: few sets of
/// bounds occur.
py::dict columns_of(const std::vector<InternalPoint>& points) {
  const auto n = static_cast<py::ssize_t>(points.size());
  Array s(std::vector<py::ssize_t>{n, 3}), value(std::vector<py::ssize_t>{n});
  py::array_t<std::uint8_t> status(n);
  py::array_t<std::uint32_t> active(n);
  std::map<std::uint32_t, ActiveBounds> bounds;
  for (py::ssize_t k = 0; k < n; ++k) {
    const InternalPoint& p = points[static_cast<std::size_t>(k)];
    Eigen::Map<Vec3>{s.mutable_data() + 3 * k} = p.s;
    value.mutable_data()[k] = p.value;
    status.mutable_data()[k] = static_cast<std::uint8_t>(p.status);
    active.mutable_data()[k] = p.active.bits();
    bounds.emplace(p.active.bits(), p.active);
  }
  py::dict names, out;
  for (const auto& [bits, set] : bounds) names[py::int_(bits)] = py::tuple(py::cast(set.names()));
  out["internal_point"] = s;
  out["value"] = value;
  out["status"] = status;
  out["active"] = active;
  out["active_names"] = names;
  return out;
}

py::dict best_points(const Geometry& g, const Array& position, const Array& rotation, const Array& start,
                     const py::dict& asked, int threads) {
  const InternalPointProblem problem = internal_problem_from(asked);
  const std::vector<PlatformPose> poses = poses_from(position, rotation);
  const std::vector<Vec3> starts = starts_from(start);
  if (!starts.empty() && starts.size() != poses.size())
    throw InvalidArgument("start", std::to_string(starts.size()) + " rows", std::to_string(poses.size()));
  return columns_of(interruptible(py::none(), [&](const Control& control) {
    std::vector<InternalPoint> points(poses.size());
    parallel_for(static_cast<long>(poses.size()), 4, threads, [&](long first, long last) {
      for (auto k = static_cast<std::size_t>(first); k < static_cast<std::size_t>(last); ++k) {
        if (control.stop.stop_requested()) throw Stopped{};
        const std::optional<Vec3> from = starts.empty() ? std::nullopt : std::optional(starts[k]);
        points[k] = best_internal_point(g, poses[k].position, poses[k].rotation, problem, from);
      }
    });
    return points;
  }));
}

py::dict best_path(const Geometry& g, const Array& position, const Array& rotation, const Array& start,
                   const py::dict& asked, double smoothness) {
  const InternalPointProblem problem = internal_problem_from(asked);
  const std::vector<PlatformPose> poses = poses_from(position, rotation);
  std::optional<Vec3> from;
  if (start.size() == 3) from = Eigen::Map<const Vec3>(start.data());
  return columns_of(interruptible(py::none(), [&](const Control& control) {
    return best_internal_path(g, poses, problem, smoothness, from, control);
  }));
}

py::dict best_map(const Geometry& g, const Array& position, const Array& rotation,
                  const std::vector<std::size_t>& shape, const Array& start, const py::dict& asked,
                  const py::dict& settings, const py::object& progress) {
  const InternalPointProblem problem = internal_problem_from(asked);
  const MapSettings how = map_settings_from(settings);
  const std::vector<PlatformPose> poses = poses_from(position, rotation);
  const std::vector<Vec3> starts = starts_from(start);
  const InternalPointMap map = interruptible(progress, [&](const Control& control) {
    return best_internal_map(g, {poses, shape, starts}, problem, how, control);
  });
  py::dict out = columns_of(map.points);
  out["audit"] = audit_dict(map.audit);
  out["searched"] = map.searched;
  out["followed"] = map.followed;
  return out;
}

}  // namespace

void bind_redundancy(py::module_& m) {
  py::list statuses;
  for (int k = 0; k <= static_cast<int>(InternalPointStatus::missing); ++k)
    statuses.append(to_string(static_cast<InternalPointStatus>(k)));
  m.attr("internal_point_statuses") = statuses;
  m.def("best_internal_point", &best_points);
  m.def("best_internal_path", &best_path);
  m.def("best_internal_map", &best_map);
}

}  // namespace ninedof::python
