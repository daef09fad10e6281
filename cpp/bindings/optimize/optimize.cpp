#include "ninedof/optimize/optimize.hpp"

#include <algorithm>
#include <optional>

#include "ninedof/optimize/region_study.hpp"
#include "ninedof/optimize/trace.hpp"
#include "support/arrays.hpp"
#include "support/interruptible.hpp"
#include "support/module.hpp"
#include "support/placing.hpp"
#include "support/struct.hpp"

namespace ninedof::python {
namespace {

using Vectors = std::vector<std::vector<double>>;

Formulation formulation_from(const std::string& word) {
  if (word == "minimax") return Formulation::minimax;
  if (word == "plain") return Formulation::plain;
  throw InvalidArgument("formulation", "\"" + word + "\"", "\"minimax\" or \"plain\"");
}

/// The fields of a Candidate under the names of the Python class, which adds the robot.
py::dict fields_of(const Problem& problem, const Candidate& c) {
  py::dict variables;
  const std::vector<std::string> names = problem.names();
  for (std::size_t k = 0; k < names.size(); ++k)
    variables[py::str(names[k])] = c.variables[static_cast<Eigen::Index>(k)];
  py::dict out;
  out["objective"] = c.objective;
  out["condition_number"] = c.condition_number;
  out["conditions"] = c.conditions;
  out["characteristic_length"] = c.characteristic_length;
  out["variables"] = variables;
  out["active"] = c.active;
  out["prices"] = c.prices;
  out["optimality_residual"] = c.optimality_residual;
  out["constraint_violation"] = c.constraint_violation;
  out["reached"] = c.reached;
  return out;
}

/// The fields of a Result, likewise.
py::dict fields_of(const Problem& problem, const Result& r) {
  py::list candidates;
  for (const Candidate& c : r.candidates) candidates.append(fields_of(problem, c));
  py::dict out;
  out["status"] = to_string(r.status);
  out["reason"] = r.reason;
  out["causes"] = r.causes;
  out["candidates"] = candidates;
  out["evaluations"] = r.evaluations;
  out["starts_done"] = r.starts_done;
  out["runs_abandoned"] = r.runs_abandoned;
  out["runs_completed"] = r.runs_completed;
  out["interrupted"] = r.interrupted;
  return out;
}

/// The fields of a Pose: shift of p, rotation vector, shift of s, whether s is best, whether in zp, weight.
py::tuple fields_of(const Pose& pose) {
  const auto three = [](const Vec3& v) { return py::make_tuple(v[0], v[1], v[2]); };
  return py::make_tuple(three(pose.position), three(pose.rotation), three(pose.internal), pose.best_internal,
                        pose.in_zp, pose.weight);
}

/// The fields of a RegionReport.
py::dict fields_of(const RegionReport& r) {
  py::list poses;
  for (const Pose& pose : r.poses) poses.append(fields_of(pose));
  py::dict out;
  out["poses"] = poses;
  out["rounds"] = r.rounds;
  out["looked_at"] = r.looked_at;
  out["objective"] = r.objective;
  out["objective_at"] = fields_of(r.objective_at);
  out["margin"] = r.margin;
  out["limit"] = r.limit;
  out["gain"] = r.gain;
  py::list ranges;
  for (Eigen::Index leg = 0; leg < 9 && r.leg_ranges; ++leg)
    ranges.append(py::make_tuple(r.leg_ranges->low[leg], r.leg_ranges->high[leg]));
  out["leg_ranges"] = py::tuple(ranges);
  out["mean"] = py::none();
  if (r.mean) {
    py::dict mean;
    mean["nodes"] = r.mean->nodes;
    mean["quadrature"] = r.mean->quadrature;
    mean["value"] = r.mean->value;
    mean["error"] = r.mean->error;
    mean["standard_error"] = r.mean->standard_error;
    out["mean"] = mean;
  }
  return out;
}

Problem posed_problem(Problem problem, const std::vector<Pose>& poses) {
  problem.objective.poses.insert(problem.objective.poses.end(), poses.begin(), poses.end());
  return problem;
}

std::array<double, 6> numbers(const Vec6& at) {
  std::array<double, 6> out;
  Vec6::Map(out.data()) = at;
  return out;
}

/// Shift of p, rotation vector and shift of s at given coordinates.
py::tuple region_pose(const Region& r, const std::array<double, 6>& at) {
  const Pose pose = r.pose(r.nearest(Vec6::Map(at.data())));
  const auto three = [](const Vec3& v) { return py::make_tuple(v[0], v[1], v[2]); };
  return py::make_tuple(three(pose.position), three(pose.rotation), three(pose.internal));
}

/// For rows of coordinates: those of the nearest poses of the region, then shift of p, rotation vector and shift of s.
Array region_poses(const Region& r, const py::object& at) {
  const py::ssize_t count = py::len(at);
  const Array given = array_of_shape("at", at, {count, 6});
  Array out({count, py::ssize_t{15}});
  for (py::ssize_t n = 0; n < count; ++n) {
    const Vec6 near = r.nearest(Vec6::Map(given.data(n, 0)));
    const Pose pose = r.pose(near);
    Eigen::Map<Eigen::Matrix<double, 15, 1>>(out.mutable_data(n, 0)) << near, pose.position, pose.rotation,
        pose.internal;
  }
  return out;
}

/// Margins as (name, row, margin, coordinates of the pose), logarithms of the index with theirs, and the coordinates
/// where each leg is longest and shortest.
py::dict worst_of_region(const Problem& problem, const Region& r, const std::vector<double>& x, long samples,
                         std::uint64_t seed, int threads) {
  const Eigen::VectorXd variables = Eigen::VectorXd::Map(x.data(), static_cast<Eigen::Index>(x.size()));
  const RegionWorst found = interruptible(py::none(), [&](const Control& control) {
    return search_region(problem, r, variables, {samples, seed, threads, 1e-5}, control);
  });
  py::list limits, index, longest, shortest;
  for (const RegionWorst::Index& end : found.index) index.append(py::make_tuple(end.logarithm, numbers(end.at)));
  for (const RegionWorst::Limit& limit : found.limits)
    limits.append(py::make_tuple(limit.name, limit.row, limit.margin, numbers(limit.at)));
  for (const Vec6& at : found.longest_at) longest.append(numbers(at));
  for (const Vec6& at : found.shortest_at) shortest.append(numbers(at));
  py::dict out;
  out["limits"] = limits;
  out["index"] = index;
  out["longest_at"] = longest;
  out["shortest_at"] = shortest;
  out["poses"] = found.poses;
  return out;
}

/// The ranges of a design about leg lengths at some poses.
std::vector<RangeEntry> ranges_about(const Problem& problem, double zp, const Array& lengths) {
  std::vector<RangeEntry> out;
  for (const LegRange& range : leg_ranges(problem, zp, lengths_from(lengths))) {
    std::array<double, 9> low{}, high{};
    std::ranges::transform(range.low, low.begin(), [&](double measure) { return range.length(measure); });
    std::ranges::transform(range.high, high.begin(), [&](double measure) { return range.length(measure); });
    out.emplace_back(range.limit, low, high, range.logarithm ? 0.0 : range.size);
  }
  return out;
}

/// Coordinates of the poses, shape (n, 6), and the shifts of s in zp that are best there, shape (n, 3).
py::tuple places_in_region(const PlacedDesign& design, const Region& r, const py::object& at, int threads) {
  const py::ssize_t count = py::len(at);
  const Array given = array_of_shape("at", at, {count, 6});
  std::vector<Vec6> poses;
  for (py::ssize_t k = 0; k < count; ++k) poses.push_back(Vec6::Map(given.data(k, 0)));
  const std::vector<PlacedEnd> found = interruptible(py::none(), [&](const Control& control) {
    return place_in_region(design.problem, r, design.variables, design.goal(), design.known, poses, threads, control);
  });
  Array near({count, py::ssize_t{6}}), moved({count, py::ssize_t{3}});
  for (std::size_t k = 0; k < found.size(); ++k) {
    Vec6::Map(near.mutable_data(static_cast<py::ssize_t>(k), 0)) = found[k].placed.at;
    Vec3::Map(moved.mutable_data(static_cast<py::ssize_t>(k), 0)) = found[k].placed.shift;
  }
  return py::make_tuple(near, moved);
}

/// Ends of the ascents as (coordinates of the pose, shift of s in zp, excess, logarithm of the index, least margin, its
/// limit).
/// `ranges`: (limit, low, high, size) of the lengths of the nine legs; `known`: (coordinates, shift).
py::dict worst_with_placing(const Problem& problem, const Region& r, const std::vector<double>& x, double log_index,
                            const std::vector<RangeEntry>& ranges, const py::sequence& known, long samples,
                            std::uint64_t seed, int threads) {
  const Eigen::VectorXd variables = Eigen::VectorXd::Map(x.data(), static_cast<Eigen::Index>(x.size()));
  const PlacementGoal goal{log_index, ranges_from(problem, ranges)};
  std::vector<Placed> places;
  for (const py::handle& place : known) {
    const auto [at, shift] = place.cast<std::tuple<std::array<double, 6>, std::array<double, 3>>>();
    places.push_back({Vec6::Map(at.data()), Vec3::Map(shift.data())});
  }
  const PlacedWorst found = interruptible(py::none(), [&](const Control& control) {
    return search_region_placed(problem, r, variables, goal, places,
                                {.samples = samples, .seed = seed, .threads = threads}, control);
  });
  py::list ends;
  for (const PlacedEnd& end : found.ends) {
    const Vec3& s = end.placed.shift;
    ends.append(py::make_tuple(numbers(end.placed.at), py::make_tuple(s[0], s[1], s[2]), end.excess, end.log_index,
                               end.margin, end.limit));
  }
  py::dict out;
  out["ends"] = ends;
  out["at_known"] = found.at_known;
  out["poses"] = found.poses;
  return out;
}

}  // namespace

void bind_optimize(py::module_& m) {
  py::dict built_with;
  built_with["nlopt"] = solver_version();
  built_with["eigen"] = std::to_string(EIGEN_WORLD_VERSION) + "." + std::to_string(EIGEN_MAJOR_VERSION) + "." +
                        std::to_string(EIGEN_MINOR_VERSION);
  built_with["compiler"] = __VERSION__;
  m.attr("built_with") = built_with;

  const Settings defaults;
  py::class_<Settings>(m, "Settings")
      .def(py::init([](int starts, std::uint64_t seed, int threads, int max_evaluations,
                       const std::optional<Vectors>& warm, double time_limit) {
             Settings settings{starts, seed, threads, max_evaluations, {}, time_limit};
             for (const std::vector<double>& x : warm ? *warm : Vectors())
               settings.warm.emplace_back(Eigen::VectorXd::Map(x.data(), static_cast<Eigen::Index>(x.size())));
             return settings;
           }),
           py::kw_only(), py::arg("starts") = defaults.starts, py::arg("seed") = defaults.seed,
           py::arg("threads") = defaults.threads, py::arg("max_evaluations") = defaults.max_evaluations,
           py::arg("warm") = py::none(), py::arg("time_limit") = defaults.time_limit);
  m.def("region_pose", &region_pose);
  m.def("region_poses", &region_poses);
  m.def("search_region", &worst_of_region);
  m.def("leg_ranges", &ranges_about);
  m.def("search_region_placed", &worst_with_placing);
  request<PlacedDesign>(m, "PlacedDesign", "A design of a problem without poses, with O placed anew at every pose.")
      .def_readwrite("problem", &PlacedDesign::problem, "Without poses.")
      .def_readwrite("variables", &PlacedDesign::variables, "A full set.")
      .def_readwrite("log_index", &PlacedDesign::log_index, "Logarithm of the index that placing is to reach.")
      .def_readwrite("ranges", &PlacedDesign::ranges, "(limit, low, high, size) of the lengths of the nine legs.")
      .def_readwrite("known", &PlacedDesign::known, "Places of O to begin at: shifts of s in zp.");
  m.def("place_in_region", &places_in_region);
  m.def("optimize", [](const Problem& problem, const Settings& settings, const py::object& progress) {
    const Result result = interruptible(
        progress, [&](const Control& control) { return optimize(problem, settings, control); },
        [](Result& r) { return r.interrupted = true; });
    return fields_of(problem, result);
  });
  m.def("optimize_region", [](const Problem& problem, const Region& r, const Settings& settings,
                              const py::object& progress, const py::object& phase) {
    RegionStudySettings s{settings};
    const RegionResult found = interruptible(
        progress,
        [&](const WorkControl& control) {
          if (!phase.is_none())
            s.phase = [&](const std::string& words) { control.on_calling_thread([&] { phase(words); }); };
          return optimize_region(problem, r, s, control);
        },
        [](RegionResult& f) { return f.result.interrupted = true; });
    py::dict out = fields_of(posed_problem(problem, found.region.poses), found.result);
    out["region"] = fields_of(found.region);
    return out;
  });
  m.def("trace", [](const Problem& problem, const std::vector<double>& start, const std::string& formulation) {
    const Formulation f = formulation_from(formulation);
    const Trace t = interruptible(py::none(), [&](const Control& control) {
      return trace(problem, Eigen::VectorXd::Map(start.data(), static_cast<Eigen::Index>(start.size())), f, {},
                   control.stop);
    });
    return py::make_tuple(t.best, fields_of(problem, t.end));
  });
}

}  // namespace ninedof::python
