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

void bind_results(py::module_& m) {
  py::class_<Candidate>(m, "Candidate", "A local optimum and the results of its checks.")
      .def_readonly("variables", &Candidate::variables, "A full set, in the order of the names of the problem.")
      .def_readonly("objective", &Candidate::objective, "The index: its worst value over the poses, or its mean.")
      .def_readonly("neutral_condition_number", &Candidate::condition_number, "At the neutral pose.")
      .def_property_readonly("conditions", tuple_of(&Candidate::conditions), "At each evaluated pose.")
      .def_readonly("characteristic_length", &Candidate::characteristic_length, "Of this design, a length.")
      .def_property_readonly("active", tuple_of(&Candidate::active), "Active bounds and constraints, by name.")
      .def_readonly("prices", &Candidate::prices, "Per cent of the objective for one of what is active.")
      .def_readonly("optimality_residual", &Candidate::optimality_residual,
                    "Of the first-order conditions; 0 at a stationary point.")
      .def_readonly("constraint_violation", &Candidate::constraint_violation, "Largest negative margin; 0 if none.")
      .def_readonly("reached", &Candidate::reached, "Starts that ended at this objective, warm ones aside.");
  py::class_<Result>(m, "Result", "Distinct local optima and how the search ended.")
      .def_property_readonly(
          "status", [](const Result& r) { return to_string(r.status); }, "optimal, unbounded, infeasible or stopped.")
      .def_readonly("reason", &Result::reason, "One sentence.")
      .def_property_readonly("causes", tuple_of(&Result::causes), "Variables or limits behind the status.")
      .def_readonly("candidates", &Result::candidates, "Best first.")
      .def_readonly("evaluations", &Result::evaluations, "Designs evaluated, over all starts.")
      .def_readonly("starts_done", &Result::starts_done, "Starts that ran.")
      .def_readonly("runs_abandoned", &Result::runs_abandoned, "Given up after a short run.")
      .def_readonly("runs_completed", &Result::runs_completed, "In the round that found the best design.")
      .def_readonly("interrupted", &Result::interrupted, "By Ctrl-C.");
  py::class_<RegionMean>(m, "RegionMean", "The harmonic mean of an index over a region.")
      .def_readonly("nodes", &RegionMean::nodes, "Poses of the quadrature that the search used.")
      .def_readonly("quadrature", &RegionMean::quadrature, "The mean over them.")
      .def_readonly("value", &RegionMean::value, "Over other poses.")
      .def_readonly("error", &RegionMean::error, "Of the quadrature.")
      .def_readonly("standard_error", &RegionMean::standard_error, "Of the value.");
  py::class_<RegionReport>(m, "RegionReport", "What is known of the best design over the region.")
      .def_readonly("poses", &RegionReport::poses, "Where limits and index were imposed.")
      .def_readonly("rounds", &RegionReport::rounds, "Designs that were searched over the region.")
      .def_readonly("looked_at", &RegionReport::looked_at, "Poses of the last search.")
      .def_readonly("objective", &RegionReport::objective, "The largest value of the index found.")
      .def_readonly("objective_at", &RegionReport::objective_at, "The pose where it is.")
      .def_readonly("margin", &RegionReport::margin, "The least of a limit found, relative.")
      .def_readonly("limit", &RegionReport::limit, "Its name; empty without limits.")
      .def_readonly("gain", &RegionReport::gain, "By how much the objective could still fall near this design.")
      .def_readonly("mean", &RegionReport::mean, "Where the objective is a mean.")
      .def_readonly("leg_ranges", &RegionReport::leg_ranges, "Lengths that O, placed at every pose, keeps.");
  py::class_<RegionResult>(m, "RegionResult", "The search of a study over a region.")
      .def_readonly("result", &RegionResult::result, "Its one candidate has variables of the poses of the report too.")
      .def_readonly("region", &RegionResult::region, "What is known of it over the region.");
  py::class_<Trace>(m, "Trace", "One run from one start.")
      .def_property_readonly("best", tuple_of(&Trace::best), "Least objective of a feasible design so far.")
      .def_readonly("end", &Trace::end, "The design at the end.");
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

}  // namespace

void bind_optimize(py::module_& m) {
  py::dict built_with;
  built_with["nlopt"] = solver_version();
  built_with["eigen"] = std::to_string(EIGEN_WORLD_VERSION) + "." + std::to_string(EIGEN_MAJOR_VERSION) + "." +
                        std::to_string(EIGEN_MINOR_VERSION);
  built_with["compiler"] = __VERSION__;
  m.attr("built_with") = built_with;

  const Settings defaults;
  py::class_<Settings>(m, "Settings", "How a study is searched.")
      .def(py::init([](int starts, std::uint64_t seed, int threads, int max_evaluations,
                       const std::optional<Vectors>& warm, double time_limit, bool explain) {
             Settings settings{starts, seed, threads, max_evaluations, {}, time_limit, explain};
             for (const std::vector<double>& x : warm ? *warm : Vectors()) settings.warm.push_back(vector_from(x));
             return settings;
           }),
           py::kw_only(), py::arg("starts") = defaults.starts, py::arg("seed") = defaults.seed,
           py::arg("threads") = defaults.threads, py::arg("max_evaluations") = defaults.max_evaluations,
           py::arg("warm") = py::none(), py::arg("time_limit") = defaults.time_limit,
           py::arg("explain") = defaults.explain);
  bind_results(m);
  m.def("region_poses", &region_poses);
  m.def("permitted_range", [](const Problem& problem, double zp, const Array& lengths) {
    return common_range(leg_ranges(problem, zp, lengths_from(lengths)), {});
  });
  request<PlacedDesign>(m, "PlacedDesign", "A design of a problem without poses, with O placed anew at every pose.")
      .def_readwrite("problem", &PlacedDesign::problem, "Without poses.")
      .def_property("variables", copy_of(&PlacedDesign::variables), setter_of(&PlacedDesign::variables), "A full set.")
      .def_readwrite("log_index", &PlacedDesign::log_index, "Logarithm of the index that placing is to reach.")
      .def_readwrite("leg_ranges", &PlacedDesign::leg_ranges, "Lengths that the legs keep at every pose, or None.")
      .def_property("known", copy_of(&PlacedDesign::known), setter_of(&PlacedDesign::known),
                    "Places of O to begin at: shifts of s in zp.");
  m.def("place_in_region", &places_in_region);
  m.def("optimize", [](const Problem& problem, const Settings& settings, const py::object& progress) {
    return interruptible(
        progress, [&](const Control& control) { return optimize(problem, settings, control); },
        [](Result& r) { return r.interrupted = true; });
  });
  m.def("optimize_region", [](const Problem& problem, const Region& r, const Settings& settings,
                              const py::object& progress, const py::object& phase) {
    RegionStudySettings s{settings};
    return interruptible(
        progress,
        [&](const WorkControl& control) {
          if (!phase.is_none())
            s.phase = [&](const std::string& words) { control.on_calling_thread([&] { phase(words); }); };
          return optimize_region(problem, r, s, control);
        },
        [](RegionResult& f) { return f.result.interrupted = true; });
  });
  m.def("trace", [](const Problem& problem, const std::vector<double>& start, const std::string& formulation) {
    const Formulation f = formulation_from(formulation);
    return interruptible(
        py::none(), [&](const Control& control) { return trace(problem, vector_from(start), f, {}, control.stop); });
  });
}

}  // namespace ninedof::python
