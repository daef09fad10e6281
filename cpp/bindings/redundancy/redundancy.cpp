#include <pybind11/stl.h>

#include <array>
#include <map>
#include <optional>
#include <vector>

#include "ninedof/redundancy/redundancy_map.hpp"
#include "ninedof/redundancy/redundancy_path.hpp"
#include "support/arrays.hpp"
#include "support/module.hpp"

namespace ninedof::python {
namespace {

Criterion criterion_from(const std::string& word) {
  if (word == "condition_number") return Criterion::condition_number;
  if (word == "singularity") return Criterion::singularity;
  if (word == "leg_centring") return Criterion::leg_centring;
  throw InvalidArgument("criterion", "\"" + word + "\"", "\"condition_number\", \"singularity\" or \"leg_centring\"");
}

InternalPointProblem problem_from(const std::string& criterion, const Array& low, const Array& high, double length,
                                  double clearance) {
  InternalPointProblem problem;
  problem.criterion = criterion_from(criterion);
  problem.limits = {Eigen::Map<const Vec9>(low.data()), Eigen::Map<const Vec9>(high.data())};
  problem.characteristic_length = length;
  problem.clearance = clearance;
  validate(problem);
  return problem;
}

/// n poses as (n, 3) and (n, 3, 3), which Python has checked.
std::vector<PlatformPose> poses_from(const Array& position, const Array& rotation) {
  std::vector<PlatformPose> poses(static_cast<std::size_t>(position.size() / 3));
  for (std::size_t k = 0; k < poses.size(); ++k)
    poses[k] = {Eigen::Map<const Vec3>(position.data() + 3 * k),
                Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(rotation.data() + 9 * k)};
  return poses;
}

/// (n, 3) points, (n) values, and for each the status and its bounds.
py::tuple result(const std::vector<InternalPoint>& points) {
  const auto n = static_cast<py::ssize_t>(points.size());
  Array s(std::vector<py::ssize_t>{n, 3}), value(std::vector<py::ssize_t>{n});
  py::list status, active;
  for (py::ssize_t k = 0; k < n; ++k) {
    const InternalPoint& p = points[static_cast<std::size_t>(k)];
    Eigen::Map<Vec3>{s.mutable_data() + 3 * k} = p.s;
    value.mutable_data()[k] = p.value;
    status.append(to_string(p.status));
    py::list names;
    for (const std::string& name : p.active.names()) names.append(name);
    active.append(py::tuple(names));
  }
  return py::make_tuple(s, value, status, active);
}

/// Starts come as (n, 3), or as no rows for the default.
py::tuple best_points(const Geometry& g, const Array& position, const Array& rotation, const Array& start,
                      const std::string& criterion, const Array& low, const Array& high, double length,
                      double clearance, int threads) {
  const InternalPointProblem problem = problem_from(criterion, low, high, length, clearance);
  const std::vector<PlatformPose> poses = poses_from(position, rotation);
  const bool default_start = start.size() == 0;
  if (!default_start && start.size() != position.size())
    throw InvalidArgument("start", std::to_string(start.size()) + " numbers", std::to_string(position.size()));
  const double* from = start.data();
  std::vector<InternalPoint> points(poses.size());
  {
    const py::gil_scoped_release nogil;
    parallel_for(static_cast<long>(poses.size()), 4, threads, [&](long first, long last) {
      for (auto k = static_cast<std::size_t>(first); k < static_cast<std::size_t>(last); ++k) {
        std::optional<Vec3> x;
        if (!default_start) x = Eigen::Map<const Vec3>(from + 3 * k);
        points[k] = best_internal_point(g, poses[k].position, poses[k].rotation, problem, x);
      }
    });
  }
  return result(points);
}

py::tuple best_path(const Geometry& g, const Array& position, const Array& rotation, const Array& start,
                    const std::string& criterion, const Array& low, const Array& high, double length, double clearance,
                    double smoothness) {
  const InternalPointProblem problem = problem_from(criterion, low, high, length, clearance);
  const std::vector<PlatformPose> poses = poses_from(position, rotation);
  std::optional<Vec3> x;
  if (start.size() == 3) x = Eigen::Map<const Vec3>(start.data());
  const std::vector<InternalPoint> points = [&] {
    const py::gil_scoped_release nogil;
    return best_internal_path(g, poses, problem, smoothness, x);
  }();
  return result(points);
}

/// (n, 3) starts, which Python has checked; none for no rows.
std::vector<Vec3> starts_from(const Array& start) {
  std::vector<Vec3> out(static_cast<std::size_t>(start.size() / 3));
  for (std::size_t k = 0; k < out.size(); ++k) out[k] = Eigen::Map<const Vec3>(start.data() + 3 * k);
  return out;
}

/// (n, 3) points, (n) values, (n) places of a status among the words that follow, (n) keys of bounds and their names.
py::tuple compact(const std::vector<InternalPoint>& points) {
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
  py::list words;
  for (int k = 0; k <= static_cast<int>(InternalPointStatus::missing); ++k)
    words.append(to_string(static_cast<InternalPointStatus>(k)));
  py::dict names;
  for (const auto& [bits, set] : bounds) {
    py::list all;
    for (const std::string& name : set.names()) all.append(name);
    names[py::int_(bits)] = py::tuple(all);
  }
  return py::make_tuple(s, value, status, words, active, names);
}

/// Called by the core, without the GIL, between slices of work: a signal or an exception of `progress` ends the map as an exception.
bool report(const py::object& progress, std::size_t done, std::size_t total, std::size_t& reported) {
  const py::gil_scoped_acquire gil;
  if (PyErr_CheckSignals() != 0) throw py::error_already_set();
  if (!progress.is_none() && done > reported) progress(done, total);
  reported = done;
  return true;
}

py::tuple best_map(const Geometry& g, const Array& position, const Array& rotation,
                   const std::vector<std::size_t>& shape, const Array& start, const std::string& criterion,
                   const Array& low, const Array& high, double length, double clearance, int threads,
                   std::size_t seed_every, std::size_t audit_every, std::uint64_t audit_seed,
                   const py::object& progress) {
  const InternalPointProblem problem = problem_from(criterion, low, high, length, clearance);
  const std::vector<PlatformPose> poses = poses_from(position, rotation);
  const std::vector<Vec3> starts = starts_from(start);
  std::size_t reported = 0;
  const MapSettings settings{seed_every, audit_every, audit_seed, threads, [&](std::size_t done, std::size_t total) {
                               return report(progress, done, total, reported);
                             }};
  const InternalPointMap map = [&] {
    const py::gil_scoped_release nogil;
    return best_internal_map(g, {poses, shape, starts}, problem, settings);
  }();
  return py::make_tuple(compact(map.points), py::make_tuple(map.audit.poses, map.audit.missed, map.audit.largest),
                        map.searched, map.followed);
}

}  // namespace

void bind_redundancy(py::module_& m) {
  m.def("best_internal_point", &best_points);
  m.def("best_internal_path", &best_path);
  m.def("best_internal_map", &best_map);
}

}  // namespace ninedof::python
