#include "support/motion.hpp"

#include <pybind11/eigen.h>
#include <pybind11/stl.h>

#include "ninedof/dynamics/drives.hpp"
#include "ninedof/motion/follow.hpp"
#include "support/module.hpp"
#include "support/poses.hpp"
#include "support/struct.hpp"

namespace ninedof::python {
namespace {

/// A word of RULES, or the fraction of "between".
TrajectoryRule trajectory_rule_from(const py::object& rule) {
  using enum TrajectoryRule::Kind;
  if (!py::isinstance<py::str>(rule)) return {between, rule.cast<double>()};
  const auto word = rule.cast<std::string>();
  for (const auto& [name, kind] :
       {std::pair("carried", carried), std::pair("shifted", shifted), std::pair("held", held), std::pair("best", best)})
    if (word == name) return {kind};
  throw InvalidArgument("internal_point", "\"" + word + "\"",
                        "\"carried\", \"shifted\", \"held\", \"best\" or a fraction");
}

LegLimits limits_from(const Array& low, const Array& high) {
  return {Eigen::Map<const Vec9>(rows("low", low, 1, 9)), Eigen::Map<const Vec9>(rows("high", high, 1, 9))};
}

std::span<const double> span_of(const Array& values) {
  return {values.data(), static_cast<std::size_t>(values.size())};
}

/// One row of `columns` numbers for each entry.
template <class T>
Array table(const std::vector<T>& entries, py::ssize_t columns) {
  Array out({static_cast<py::ssize_t>(entries.size()), columns});
  double* to = out.mutable_data();
  for (const T& entry : entries) to = write(entry, to);
  return out;
}

/// det N, det B, det C as three rows, shape (3, n).
Array rows_from(const std::vector<PerMechanism>& determinants) {
  Eigen::Matrix3Xd out(3, static_cast<Eigen::Index>(determinants.size()));
  for (Eigen::Index k = 0; k < out.cols(); ++k) {
    const PerMechanism& d = determinants[static_cast<std::size_t>(k)];
    out.col(k) << d.n, d.b, d.c;
  }
  return array_from(out);
}

Followed followed(const Geometry& g, const Configuration& home, const Array& time, const Array& position,
                  const Array& rotation, const py::object& rule, const std::pair<Array, Array>& limits,
                  double characteristic_length) {
  const Trajectory trajectory{{time.data(), time.data() + time.size()}, poses_from(position, rotation)};
  const FollowSettings settings{trajectory_rule_from(rule), limits_from(limits.first, limits.second),
                                characteristic_length};
  return interruptible(py::none(),
                       [&](const Control& control) { return follow(g, trajectory, home, settings, control); });
}

/// A getter of one row of nine numbers for each pose.
template <class T>
auto legs_of(std::vector<T> Followed::* member) {
  return [member](const Followed& motion) { return table(motion.*member, 9); };
}

void bind_followed(py::module_& m) {
  py::class_<Followed>(m, "Followed", "A motion along a trajectory of n poses, legs in the order of leg_lengths.")
      .def_property_readonly("internal_point", points_of(&Followed::internal_point), "O, shape (n, 3).")
      .def_property_readonly("leg_lengths", legs_of(&Followed::leg_lengths), "Shape (n, 9).")
      .def_property_readonly("leg_rates", legs_of(&Followed::leg_rates), "Length/time, shape (n, 9).")
      .def_property_readonly("leg_accelerations", legs_of(&Followed::leg_accelerations), "Length/time^2, shape (n, 9).")
      .def_property_readonly(
          "velocity", [](const Followed& motion) { return table(motion.derivatives.velocity, 9); },
          "Angular velocity, velocities of p and O, base frame, shape (n, 9).")
      .def_property_readonly(
          "acceleration", [](const Followed& motion) { return table(motion.derivatives.acceleration, 9); },
          "Their time derivatives, shape (n, 9).")
      .def_property_readonly("condition_number", column_of<double>(&Followed::condition_number),
                             "Infinite where singular, shape (n,).")
      .def_property_readonly(
          "singularity_margins", [](const Followed& motion) { return rows_from(motion.singularity_margins); },
          "det N, det B and det C, shape (3, n).")
      .def_readonly("tracked", &Followed::tracked, "Poses from the first on that `track` returns.")
      .def_readonly("tracking_error", &Followed::tracking_error, "Of Q, and of p and O over the longest leg.");
  py::class_<LimitBreak>(m, "LimitBreak", "A stretch of time in which a limit is not kept.")
      .def_readonly("limit", &LimitBreak::limit,
                    "\"l1 low\": the leg is shorter than its limit; \"q2 high\": longer; \"det B\": singular.")
      .def_readonly("begin", &LimitBreak::begin, "Time, linear between the samples.")
      .def_readonly("end", &LimitBreak::end, "Time, linear between the samples.")
      .def_readonly("worst", &LimitBreak::worst,
                    "The value that is limited; 0 for a determinant that changes its sign.")
      .def_readonly("at", &LimitBreak::at, "The time of the worst.");
  py::class_<DriveFigures>(m, "DriveFigures", "Greatest forces and powers of the legs over a motion, and their work.")
      .def_readonly("push", &DriveFigures::push, "Greatest force that pushes, at least 0, shape (9,).")
      .def_readonly("pull", &DriveFigures::pull, "Greatest force that pulls, at least 0, shape (9,).")
      .def_readonly("rms", &DriveFigures::rms, "Root of the mean of force^2 over time, shape (9,).")
      .def_readonly("power", &DriveFigures::power, "Greatest of force times rate, at least 0, shape (9,).")
      .def_readonly("braking", &DriveFigures::braking, "Greatest of -force times rate, at least 0, shape (9,).")
      .def_readonly("work", &DriveFigures::work, "Integral of the power where it is positive, shape (9,).")
      .def_readonly("returned", &DriveFigures::returned,
                    "Integral of the power back where it is negative, shape (9,).");
}

}  // namespace

void bind_motion(py::module_& m) {
  bind_followed(m);
  m.def("follow", &followed);
  m.def("drive_figures", [](const Array& time, const Array& forces, const Array& rates) {
    return drive_figures(span_of(time), lengths_from(forces), lengths_from(rates));
  });
  m.def("leg_margins", [](const Array& lengths, const Array& low, const Array& high) {
    const LegLimits limits = limits_from(low, high);
    std::vector<Vec9> out;
    for (const Vec9& row : lengths_from(lengths)) {
      const LegMargins margins = leg_margins(row, limits);
      out.push_back(margins.low.cwiseMin(margins.high));
    }
    return table(out, 9);
  });
  m.def("stretches",
        [](const std::string& limit, const Array& time, const Array& values, const Array& margin, double tolerance) {
          return stretches(limit, span_of(time), span_of(values), span_of(margin), tolerance);
        });
  m.def("limit_breaks",
        [](const Array& time, const Array& lengths, const Array& low, const Array& high, const Array& determinants) {
          std::vector<PerMechanism> margins;
          for (py::ssize_t k = 0; k < determinants.shape(1); ++k)
            margins.push_back({determinants.at(0, k), determinants.at(1, k), determinants.at(2, k)});
          return limit_breaks(span_of(time), lengths_from(lengths), limits_from(low, high), margins);
        });
}

}  // namespace ninedof::python
