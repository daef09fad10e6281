#include <pybind11/stl.h>

#include <cmath>

#include "ninedof/math/rotation.hpp"
#include "support/configurations.hpp"
#include "support/module.hpp"

namespace ninedof::python {
namespace {

constexpr long stack_block = 1024;  // configurations between two looks at the clock

Orbit orbit_from(const std::string& name, const py::object& value) {
  const Array a = array_of_shape(name, value, {3});
  return {a.at(0), a.at(1), a.at(2)};
}

/// Throws unless every rotation is proper and every number finite. In a stack NaN marks a pose without data and is
/// allowed.
void check_configurations(const Array& position, const Array& rotation, const Array& internal_point, bool is_stack) {
  const ConfigurationStack stack(position, rotation, internal_point);
  in_slices(stack.count(), stack_block, 1, [&](long first, long last) {
    for (long i = first; i < last; ++i) {
      const Configuration c = stack[i];
      const bool missing = c.position.hasNaN() || c.rotation.hasNaN() || c.internal_point.hasNaN();
      if (!(is_stack && missing)) validate(c);
    }
  });
}

/// Three arrays to fill with configurations.
struct ConfigurationArrays {
  explicit ConfigurationArrays(py::ssize_t n)
      : position(std::vector<py::ssize_t>{n, 3}),
        rotation(std::vector<py::ssize_t>{n, 3, 3}),
        internal_point(std::vector<py::ssize_t>{n, 3}) {}

  py::tuple result() const { return py::make_tuple(position, rotation, internal_point); }

  Array position, rotation, internal_point;
};

/// Where their numbers lie, for use without the GIL.
struct ConfigurationPlaces {
  explicit ConfigurationPlaces(ConfigurationArrays& a)
      : position(a.position.mutable_data()),
        rotation(a.rotation.mutable_data()),
        internal_point(a.internal_point.mutable_data()) {}

  void set(long i, const Configuration& c) const {
    Eigen::Map<Vec3>(position + 3 * i) = c.position;
    Eigen::Map<Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(rotation + 9 * i) = c.rotation;
    Eigen::Map<Vec3>(internal_point + 3 * i) = c.internal_point;
  }

  double *position, *rotation, *internal_point;
};

void require_size(const std::string& name, const Array& a, py::ssize_t size) {
  if (a.size() != size) throw InvalidArgument(name, std::to_string(a.size()) + " numbers", std::to_string(size));
}

py::tuple neutral_stack(const Array& zp, const Array& zs, const Array& theta_z, bool is_stack) {
  require_size("zs", zs, zp.size());
  require_size("theta_z", theta_z, zp.size());
  ConfigurationArrays out(zp.size());
  const ConfigurationPlaces to(out);
  const double *heights = zp.data(), *of_o = zs.data(), *angles = theta_z.data();
  in_slices(zp.size(), stack_block, 1, [&](long first, long last) {
    for (long i = first; i < last; ++i) {
      const double p = heights[i], s = of_o[i], angle = angles[i];
      const bool missing = is_stack && (std::isnan(p) || std::isnan(s) || std::isnan(angle));
      to.set(i, missing ? Configuration{Vec3(0.0, 0.0, p), rotation_about_z(angle), Vec3(0.0, 0.0, s)}
                        : neutral(p, s, angle));
    }
  });
  return out.result();
}

py::tuple moved_stack(const Array& position, const Array& rotation, const Array& internal_point, const Array& tangent) {
  const ConfigurationStack stack(position, rotation, internal_point);
  require_size("tangent", tangent, 9 * stack.count());
  ConfigurationArrays out(stack.count());
  const ConfigurationPlaces to(out);
  const double* from = tangent.data();
  in_slices(stack.count(), stack_block, 1, [&](long first, long last) {
    for (long i = first; i < last; ++i) to.set(i, plus(stack[i], Eigen::Map<const Vec9>(from + 9 * i)));
  });
  return out.result();
}

Geometry hexagonal_from(const py::object& a1, const py::object& a2, const py::object& b1, const py::object& b2) {
  return Geometry::hexagonal(number_from("a1", a1), number_from("a2", a2), number_from("b1", b1),
                             number_from("b2", b2));
}

bool equal(const Geometry& a, const Geometry& b) {
  return a.base_external() == b.base_external() && a.base_internal() == b.base_internal() &&
         a.platform_external() == b.platform_external() && a.platform_internal() == b.platform_internal();
}

py::tuple state(const Geometry& g) {
  return py::make_tuple(array_from(g.base_external()), array_from(g.base_internal()), array_from(g.platform_external()),
                        array_from(g.platform_internal()));
}

Geometry from_arrays(const py::object& base_external, const py::object& base_internal,
                     const py::object& platform_external, const py::object& platform_internal) {
  return {triple_from("base_external", base_external), triple_from("base_internal", base_internal),
          triple_from("platform_external", platform_external), triple_from("platform_internal", platform_internal)};
}

}  // namespace

void bind_geometry(py::module_& m) {
  py::class_<Geometry>(m, "Geometry", R"(The twelve joint centres, fixed once the robot is built.

Four arrays of shape (3, 3), one row per joint, all in the same length unit. Base joints are in the base frame, platform
joints in the platform frame. Immutable, hashable by value, picklable.

Parameters
----------
base_external : array_like, shape (3, 3)
    Joints r_i of the external legs on the base (eq. 37a).
base_internal : array_like, shape (3, 3)
    Joints r^_i of the lower internal legs on the base (eq. 37b).
platform_external : array_like, shape (3, 3)
    Joints u_i of the external legs on the platform (eq. 38a).
platform_internal : array_like, shape (3, 3)
    Joints u~_i of the upper internal legs on the platform (eq. 38b).

Raises
------
ValueError
    If an array has another shape, a coordinate is not finite, or the robot is singular at every pose: internal joints
    on one line, three external joints of a plate in one point, or two external legs with the same joints. The message
    names the argument and the determinant that is 0.

Examples
--------
>>> import ninedof as nd
>>> nd.Geometry.hexagonal(a1=0.0, a2=5.8124, b1=2.9062, b2=0.0).base_external.shape
(3, 3)
)")
      .def(py::init(&from_arrays), py::arg("base_external"), py::arg("base_internal"), py::arg("platform_external"),
           py::arg("platform_internal"))
      .def_static("hexagonal", &hexagonal_from, py::arg("a1"), py::arg("a2"), py::arg("b1"), py::arg("b2"),
                  R"(Return the semi-regular hexagons of eqs. (37)-(38).

Parameters
----------
a1, a2 : float
    Alternating sides of the base, length, >= 0 and not both zero. a1 = 0 gives a triangle with coupled joints.
b1, b2 : float
    Alternating sides of the platform, with the same conditions.

Raises
------
ValueError
    If a side is negative or not finite, or both sides of the base or of the platform are zero.
)")
      .def_static(
          "symmetric",
          [](const py::object& base_external, const py::object& base_internal, const py::object& platform_external,
             const py::object& platform_internal) {
            return Geometry::symmetric(
                orbit_from("base_external", base_external), orbit_from("base_internal", base_internal),
                orbit_from("platform_external", platform_external), orbit_from("platform_internal", platform_internal));
          },
          py::arg("base_external"), py::arg("base_internal"), py::arg("platform_external"),
          py::arg("platform_internal"),
          R"(Return four C3 orbits about z, each given by its first joint as (radius, angle, height).

Radius (> 0) and height in length units, angle in radians. Joints 2 and 3 follow at -120 and -240 degrees, the numbering
of eqs. (37)-(38).

Raises
------
ValueError
    If a radius is not positive or a number is not finite.
)")
      .def_property_readonly(
          "base_external", [](const Geometry& g) { return array_from(g.base_external()); },
          "r_i, base frame, shape (3, 3), read-only.")
      .def_property_readonly(
          "base_internal", [](const Geometry& g) { return array_from(g.base_internal()); },
          "r^_i, base frame, shape (3, 3), read-only.")
      .def_property_readonly(
          "platform_external", [](const Geometry& g) { return array_from(g.platform_external()); },
          "u_i, platform frame, shape (3, 3), read-only.")
      .def_property_readonly(
          "platform_internal", [](const Geometry& g) { return array_from(g.platform_internal()); },
          "u~_i, platform frame, shape (3, 3), read-only.")
      .def("__eq__", &equal, py::is_operator())
      .def("__hash__",
           [](const Geometry& g) {
             // The numbers and not their bytes: 0.0 and -0.0 are equal and must have the same hash.
             py::list rows;
             for (const Triple* t : {&g.base_external(), &g.platform_external()})
               for (const Vec3& joint : *t) rows.append(py::make_tuple(joint.x(), joint.y(), joint.z()));
             return py::hash(py::tuple(rows));
           })
      .def("__repr__",
           [](const Geometry& g) {
             const auto list = [](const Triple& t) {
               return py::repr(array_from(t).attr("tolist")()).cast<std::string>();
             };
             return "Geometry(base_external=" + list(g.base_external()) + ", base_internal=" + list(g.base_internal()) +
                    ", platform_external=" + list(g.platform_external()) +
                    ", platform_internal=" + list(g.platform_internal()) + ")";
           })
      .def(py::pickle(&state, [](const py::tuple& t) { return from_arrays(t[0], t[1], t[2], t[3]); }));

  m.def("check_configurations", &check_configurations, py::arg("position"), py::arg("rotation"),
        py::arg("internal_point"), py::arg("is_stack"));
  m.def("moved", &moved_stack, py::arg("position"), py::arg("rotation"), py::arg("internal_point"), py::arg("tangent"));
  m.def("neutral", &neutral_stack, py::arg("zp"), py::arg("zs"), py::arg("theta_z"), py::arg("is_stack"));
}

}  // namespace ninedof::python
