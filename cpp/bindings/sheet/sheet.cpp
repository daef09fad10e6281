#include "ninedof/domains/region_sample.hpp"
#include "ninedof/sheet/sheet_region.hpp"
#include "support/loads.hpp"
#include "support/module.hpp"
#include "support/placing.hpp"
#include "support/without_gil.hpp"

namespace ninedof::python {
namespace {

/// The numbers of every group at every pose by name, shape (n, k); of several cones of one name those of the first.
py::dict numbers_at(const SheetQuestion& question, const ConfigurationStack& c) {
  const SheetNumbers all(question);
  py::dict out;
  for (std::size_t k = 0; k < all.groups().size(); ++k) {
    const SheetGroup& group = all.groups()[k];
    const py::str name(group.name);
    if (!out.contains(name))
      out[name] =
          for_each_row(c.count(), group.size, 0, py::none(), [&](long i, double* to) { all.evaluate(k, c[i], to); });
  }
  return out;
}

/// What gives every thread its own way to place O.
std::function<PlacedAt()> placing_from(const PlacedDesign& design, const Region& region, const Configuration& neutral) {
  return [=] {
    return [place = placer(design.problem, region, design.variables, design.goal(), design.known), region, neutral,
            zp = neutral.position[2] - design.problem.tool.position.z()](const Vec6& at) {
      Configuration out = region.configuration(at, neutral);
      out.internal_point = neutral.internal_point + zp * place(at).placed.shift;
      return out;
    };
  };
}

Array coordinates_of(const std::vector<Vec6>& poses) {
  Array out({std::ssize(poses), py::ssize_t{6}});
  double* to = out.mutable_data();
  for (const Vec6& at : poses) to = python::write(at, to);
  return out;
}

void bind_question(py::module_& m) {
  request<TwistMotion>(m, "TwistMotion", "A twist of the platform and its time derivative, (omega, pdot), base axes.")
      .def_readwrite("twist", &TwistMotion::twist,
                     "Angular velocity and velocity of the origin, shape (6,), rad/time and length/time.")
      .def_readwrite("rate", &TwistMotion::rate, "Its time derivative, shape (6,).");
  auto motion =
      request<PlatformMotion>(m, "PlatformMotion", "A motion of the platform in any direction, and a given one.");
  word_attribute(motion, "internal", &PlatformMotion::internal, std::array{"least", "held", "shifted", "carried"},
                 "How O moves.");
  motion.def_readwrite("linear_speed", &PlatformMotion::linear_speed, "Of the platform's origin, length/time.")
      .def_readwrite("angular_speed", &PlatformMotion::angular_speed, "rad/time.")
      .def_readwrite("given", &PlatformMotion::given, "A twist, or None.");
  request<Weight>(m, "Weight", "The weight of the platform.")
      .def_readwrite("mass", &Weight::mass, "Of the platform and what it carries.")
      .def_readwrite("centre", &Weight::centre, "Of mass, platform frame.")
      .def_readwrite("gravity", &Weight::gravity, "Force per mass, base axes.");
  request<PayloadLimits>(m, "PayloadLimits", "Greatest forces of the legs, and where a payload is.")
      .def_readwrite("push", &PayloadLimits::push, "Shape (9,).")
      .def_readwrite("pull", &PayloadLimits::pull, "Shape (9,).")
      .def_readwrite("centre", &PayloadLimits::centre, "Platform frame.")
      .def_readwrite("gravity", &PayloadLimits::gravity, "Force per mass, base axes.");
  request<Tolerances>(m, "Tolerances", "The largest errors of legs and joints.")
      .def_readwrite("legs", &Tolerances::legs, "Shape (9,).")
      .def_readwrite("joints", &Tolerances::joints, "Twelve.");
  py::class_<SheetQuestion>(m, "SheetQuestion", "A machine, and what its sheet is asked for.")
      .def(py::init([](const Geometry& g, const Configuration& neutral, const py::kwargs& given) {
        return with_keywords(SheetQuestion{.geometry = g, .neutral = neutral}, given);
      }))
      .def_readwrite("limits", &SheetQuestion::limits, "Limits at poses.")
      .def_readwrite("exempt", &SheetQuestion::exempt, "The pairs of legs that may meet.")
      .def_readwrite("motion", &SheetQuestion::motion, "For speeds and accelerations of the legs.")
      .def_property(
          "loads", [](const SheetQuestion& q) { return q.loads.size(); },
          [](SheetQuestion& q, const std::vector<Vec6>& rows) { q.loads = loads_from(rows); },
          "Rows (moment about p, force), base axes; their number is read.")
      .def_readwrite("weight", &SheetQuestion::weight, "Added to each load, or None.")
      .def_readwrite("masses", &SheetQuestion::masses, "Their weights are added too, or None.")
      .def_readwrite("gravity", &SheetQuestion::gravity, "Of the masses.")
      .def_readwrite("payload", &SheetQuestion::payload, "Limits of its forces, or None.")
      .def_readwrite("errors", &SheetQuestion::errors, "Tolerances, or None.")
      .def_readwrite("leg_stiffness", &SheetQuestion::leg_stiffness, "Shape (9,), or None.")
      .def_readwrite("characteristic_length", &SheetQuestion::characteristic_length, "None: no condition number.")
      .def_property(
          "locked", [](const SheetQuestion& q) { return q.locked.size(); },
          [](SheetQuestion& q, const std::vector<std::pair<int, int>>& sets) {
            q.locked.clear();
            for (const auto& [first, second] : sets) q.locked.push_back({first, second});
          },
          "Legs locked together, the second -1 for one alone; their number is read.");
}

}  // namespace

void bind_sheet(py::module_& m) {
  bind_question(m);
  py::class_<SheetRegion>(m, "SheetRegion", "The poses of a region at which the numbers of a sheet are worst.")
      .def_property_readonly(
          "worst", [](const SheetRegion& found) { return coordinates_of(found.worst); }, "Coordinates, shape (n, 6).")
      .def_readonly("looked_at", &SheetRegion::poses, "Poses.")
      .def_readonly("mean", &SheetRegion::mean, "Condition number over the even poses.")
      .def_readonly("mean_error", &SheetRegion::mean_error, "Standard error of it.");
  m.def("sheet_numbers", &numbers_at);
  m.def("sheet_over_region", [](const SheetQuestion& question, const Region& region, long samples,
                                const std::optional<PlacedDesign>& placed) {
    const auto placing = placed ? placing_from(*placed, region, question.neutral) : std::function<PlacedAt()>{};
    return interruptible(py::none(), [&](const Control& control) {
      return sheet_over_region(question, region, {.samples = samples}, placing, control);
    });
  });
  m.def("even_poses", [](const Region& region, long count) {
    std::vector<Vec6> at;
    for (long n = 0; n < count; ++n) at.push_back(even_sample(region, n));
    return coordinates_of(at);
  });
  m.def("leg_lengths_over", [](const Geometry& g, const Configuration& neutral, const Region& region, long samples) {
    const std::array<Vec9, 2> found = interruptible(py::none(), [&](const Control& control) {
      return leg_lengths_over(g, neutral, region, {.samples = samples}, control);
    });
    return py::make_tuple(array_from(found[0]), array_from(found[1]));
  });
}

}  // namespace ninedof::python
