#include <memory>

#include "ninedof/domains/region.hpp"
#include "ninedof/limits/numbers.hpp"
#include "ninedof/optimize/evaluate.hpp"
#include "ninedof/optimize/optimize.hpp"
#include "support/module.hpp"
#include "support/struct.hpp"

namespace ninedof::python {
namespace {

/// The words that are not empty.
py::tuple words(std::initializer_list<const char*> all) {
  py::list out;
  for (const char* word : all)
    if (*word != '\0') out.append(word);
  return py::tuple(out);
}

void bind_tables(py::module_& m) {
  using Row = ConstraintInfo;
  py::class_<Row>(m, "ConstraintInfo", "A row of the table of constraints, or of criteria of workspaces.")
      .def_readonly("name", &Row::name, "Name of the limit.")
      .def_property_readonly(
          "kind", [](const Row& row) { return to_string(row.kind); },
          "ratio, length, angle, sign, number, rate or power.")
      .def_property_readonly(
          "sides",
          [](const Row& row) {
            return words(
                {row.sides == LimitSides::only_high ? "" : "min", row.sides == LimitSides::only_low ? "" : "max"});
          },
          "min, max or both.")
      .def_property_readonly(
          "units",
          [](const Row& row) {
            return words({to_string(Unit::length), row.of == Unit::length ? "" : to_string(row.of)});
          },
          "Values of the option `of`, the default first.")
      .def_property_readonly(
          "options", [](const Row& row) { return words({row.option}); }, "radius, axis or steps.")
      .def_property_readonly(
          "default_low",
          [](const Row& row) { return row.default_low > 0.0 ? std::optional(row.default_low) : std::nullopt; },
          "min where none is given, or None.")
      .def_property_readonly(
          "needs", [](const Row& row) { return py::tuple(py::str(row.needs).attr("split")()); },
          "Tables that a study must have for it: loads, speeds.")
      .def_property_readonly(
          "is_angle", [](const Row& row) { return row.kind == LimitKind::angle; },
          "Whether it is of angles, in radians.")
      .def_property_readonly(
          "body", [](const Row& row) { return row.kind == LimitKind::angle ? limit_body(row.name) : ""; },
          "Of the joints whose angles are limited, base or platform; empty for other limits.");
  m.attr("constraint_table") = constraint_table();
  m.attr("criterion_table") = criterion_table();
  py::class_<VariableInfo>(m, "VariableInfo", "A variable of a design family.")
      .def_readonly("name", &VariableInfo::name, "Name of the variable.")
      .def_property_readonly(
          "kind", [](const VariableInfo& v) { return to_string(v.kind); }, "length, coordinate or angle.")
      .def_readonly("low", &VariableInfo::low, "Default bound, in characteristic lengths or radians.")
      .def_readonly("high", &VariableInfo::high, "Default bound; the same where the variable is fixed.");
  m.def("family_variables", [](const std::string& family) { return design_family(family).variables(); });
}

StudyLength length_from(const py::object& value) {
  StudyLength out;
  if (py::isinstance<py::str>(value)) {
    out.choice = StudyLength::Choice::kind;
    out.kind = length_kind(value.cast<std::string>());
  } else if (py::isinstance<py::tuple>(value)) {
    out.choice = StudyLength::Choice::free;
    const auto [low, high] = value.cast<std::pair<double, double>>();
    out.bounds = {low, high};
  } else {
    out.value = value.cast<double>();
  }
  return out;
}

void bind_requests(py::module_& m) {
  request<Pose>(m, "Pose", "A pose of the platform and of O, relative to the neutral one.")
      .def_readwrite("position", &Pose::position, "Shift of p.")
      .def_readwrite("rotation", &Pose::rotation, "Rotation vector in base axes, after the neutral rotation.")
      .def_readwrite("internal", &Pose::internal, "Shift of s.")
      .def_readwrite("best_internal", &Pose::best_internal, "Whether the shift of s is a variable.")
      .def_readwrite("in_zp", &Pose::in_zp, "Whether both shifts are in fractions of zp.")
      .def_readwrite("weight", &Pose::weight, "In a mean over the poses.");
  auto objective = request<Objective>(m, "Objective", "What a study minimizes.");
  word_attribute(objective, "index", &Objective::index,
                 std::array{"condition_number", "frobenius", "speed", "six_legged"}, "What is looked at.");
  word_attribute(objective, "aggregate", &Objective::aggregate, std::array{"worst", "mean_inverse", "weighted"},
                 "How the poses are taken together.");
  objective.def_readwrite("weight", &Objective::weight, "Of the neutral pose in a mean.")
      .def_readwrite("condition_limit", &Objective::condition_limit, "Greatest condition number, or infinity.")
      .def_readwrite("neutral_condition_limit", &Objective::neutral_condition_limit, "The same at the neutral pose.")
      .def_property("poses", copy_of(&Objective::poses), setter_of(&Objective::poses),
                    "Besides the neutral one, copied.");
  auto region = request<Region>(m, "Region", "Every tilt and yaw at every position of a box, ball, cylinder or path.");
  word_attribute(region, "shape", &Region::shape, std::array{"box", "ball", "cylinder", "path"}, "Of the positions.");
  region.def_readwrite("size", &Region::size, "Half edges; the radius of a ball; radius and half height of a cylinder.")
      .def_property("corners", copy_of(&Region::corners), setter_of(&Region::corners), "Of a path, copied.")
      .def_readwrite("tilt", &Region::tilt, "Greatest angle about a horizontal axis, radians.")
      .def_readwrite("yaw", &Region::yaw, "Rotations about z go from minus to plus this.")
      .def_readwrite("shifted", &Region::shifted, "Whether s moves with p, or is held.")
      .def_readwrite("placed", &Region::placed, "Whether s is placed anew at every pose.")
      .def_readwrite("in_zp", &Region::in_zp, "Whether positions are in fractions of zp.")
      .def_readwrite("tool_height", &Region::tool_height,
                     "Of p above the plate at home: zp is the height of p less it.")
      .def_property_readonly(
          "reach", [](const Region& r) { return array_from(r.reach()).attr("tolist")(); },
          "Greatest moduli of the six coordinates of a pose.");
}

void bind_evaluation(py::module_& m) {
  using Margin = Evaluation::Margin;
  py::class_<Margin>(m, "Margin", "The smallest margin of a constraint.")
      .def_readonly("name", &Margin::name, "Of the constraint, with its pose.")
      .def_readonly("value", &Margin::value, "Relative, negative where the limit is violated.")
      .def_readonly("gradient", &Margin::gradient, "By the variables, shape (n,).")
      .def_readonly("limited", &Margin::limited, "What is limited, in the unit of the limit.")
      .def_readonly("part", &Margin::part, "The leg, pair of legs or determinant that reaches it, if it has parts.");
  py::class_<Evaluation>(m, "Evaluation", "One design of a problem.")
      .def_property_readonly(
          "objective", [](const Evaluation& e) { return std::exp(e.log_objective); }, "The index over the poses.")
      .def_readonly("log_objective", &Evaluation::log_objective, "Its logarithm.")
      .def_readonly("gradient", &Evaluation::gradient, "Of the logarithm, by the variables, shape (n,).")
      .def_readonly("condition_number", &Evaluation::condition_number, "At the neutral pose.")
      .def_readonly("conditions", &Evaluation::conditions, "Condition numbers at the evaluated poses.")
      .def_readonly("characteristic_length", &Evaluation::characteristic_length, "A length.")
      .def_readonly("margins", &Evaluation::margins, "One for each constraint.");
}

/// The neutral configuration, then the poses of the objective.
py::tuple configurations_at(const Problem& problem, const std::vector<double>& x) {
  return arrays_of(configurations(problem, vector_from(x)));
}

}  // namespace

void bind_problem(py::module_& m) {
  bind_requests(m);
  bind_evaluation(m);
  bind_tables(m);
  m.def("design_family_names", &design_family_names);
  m.attr("singularity_free_steps") = py::make_tuple(Limit{}.steps, Limit::most_steps);
  py::class_<Problem>(m, "Problem", "A design problem as the core takes it; made by `Study`.")
      .def(py::init([](std::string family, const std::vector<std::pair<double, double>>& bounds,
                       std::vector<Limit> limits, const py::object& characteristic_length, const Objective& objective,
                       const Vec3& tool_position, const Vec3& tool_rotation) {
             Problem p;
             p.family = std::move(family);
             for (const auto& [low, high] : bounds) p.variables.push_back({low, high});
             p.limits = std::move(limits);
             p.characteristic_length = length_from(characteristic_length);
             p.objective = objective;
             p.tool = {tool_position, tool_rotation};
             p.validate();
             return p;
           }),
           py::arg("family"), py::arg("bounds"), py::arg("limits"), py::arg("characteristic_length"),
           py::arg("objective"), py::arg("tool_position") = Vec3(0.0, 0.0, 0.0),
           py::arg("tool_rotation") = Vec3(0.0, 0.0, 0.0))
      .def_property_readonly("names", &Problem::names, "Of the variables, in the order of a full set.")
      .def("with_limits",
           [](Problem p, const std::vector<Limit>& limits, double condition_limit, double neutral_condition_limit) {
             p.limits = limits;
             p.objective.condition_limit = condition_limit;
             p.objective.neutral_condition_limit = neutral_condition_limit;
             return p;
           })
      .def("geometry", [](const Problem& p, const std::vector<double>& x) { return geometry(p, vector_from(x)); })
      .def("configurations", &configurations_at)
      .def("characteristic_length",
           [](const Problem& p, const std::vector<double>& x) { return characteristic_length(p, vector_from(x)); })
      .def("exempt_pairs", &exempt_pairs)
      .def("evaluate", [](const Problem& p, const std::vector<double>& x) { return evaluate(p, vector_from(x)); })
      .def("starts", [](const Problem& p, int count, std::uint64_t seed) {
        Settings settings;
        settings.starts = count;
        settings.seed = seed;
        auto found = std::make_unique<Eigen::MatrixXd>(
            interruptible(py::none(), [&](const Control& control) { return starts(p, settings, control.stop); }));
        // A column of the matrix is a row of the array: not copied, there may be very many.
        const std::vector<py::ssize_t> shape{found->cols(), found->rows()};
        const double* data = found->data();
        return Array(shape, data,
                     py::capsule(found.release(), [](void* own) { delete static_cast<Eigen::MatrixXd*>(own); }));
      });
}

}  // namespace ninedof::python
