#pragma once
/// Python's Configuration as the core takes it, and back.

#include <optional>
#include <utility>

#include "ninedof/batch/batch.hpp"
#include "ninedof/robot/configuration.hpp"
#include "support/arrays.hpp"

namespace ninedof::python {

/// n configurations as three arrays (..., 3), (..., 3, 3), (..., 3). Python has checked and broadcast them.
class ConfigurationStack {
 public:
  ConfigurationStack(Array position, Array rotation, Array internal_point)
      : position_(std::move(position)), rotation_(std::move(rotation)), internal_point_(std::move(internal_point)) {
    if (rotation_.size() != 9 * count() || position_.size() != 3 * count() || internal_point_.size() != 3 * count())
      throw InvalidArgument("configuration", "arrays that do not match", "shapes (..., 3), (..., 3, 3), (..., 3)");
    p_ = position_.data();
    q_ = rotation_.data();
    s_ = internal_point_.data();
  }

  long count() const { return static_cast<long>(position_.size() / 3); }

  /// Those of [first, last).
  batch::Configurations view(long first, long last) const {
    return {p_ + 3 * first, q_ + 9 * first, s_ + 3 * first, last - first};
  }

  Configuration operator[](long i) const {
    using RowMajor3 = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;
    return {Eigen::Map<const Vec3>(p_ + 3 * i), Eigen::Map<const RowMajor3>(q_ + 9 * i),
            Eigen::Map<const Vec3>(s_ + 3 * i)};
  }

 private:
  Array position_, rotation_, internal_point_;
  const double *p_, *q_, *s_;
};

/// What has the three arrays of a Configuration of Python as attributes.
inline ConfigurationStack stack_from(const py::handle& c) {
  const auto part = [&](const char* name) { return c.attr(name).cast<Array>(); };
  return {part("position"), part("rotation"), part("internal_point")};
}

/// Stacks (n, 3), (n, 3, 3), (n, 3) of positions, rotations and internal points.
inline py::tuple arrays_of(const std::vector<Configuration>& all) {
  const py::ssize_t n = std::ssize(all);
  Array p(std::vector<py::ssize_t>{n, 3}), q(std::vector<py::ssize_t>{n, 3, 3}), s(std::vector<py::ssize_t>{n, 3});
  double *to_p = p.mutable_data(), *to_q = q.mutable_data(), *to_s = s.mutable_data();
  for (const Configuration& c : all) {
    to_p = write(c.position, to_p);
    to_q = write(c.rotation, to_q);
    to_s = write(c.internal_point, to_s);
  }
  return py::make_tuple(p, q, s);
}

/// Configurations as Python's: a stack (n,).
inline py::object stack_of(const std::vector<Configuration>& all) {
  return py::module_::import("ninedof.robot.configuration").attr("Configuration").attr("_of")(*arrays_of(all));
}

}  // namespace ninedof::python

namespace pybind11::detail {

/// A single Configuration of Python.
template <>
struct type_caster<ninedof::Configuration> {
  PYBIND11_TYPE_CASTER(ninedof::Configuration, const_name("Configuration"));
  bool load(handle from, bool) {
    if (!hasattr(from, "internal_point")) return false;
    const ninedof::python::ConfigurationStack stack = ninedof::python::stack_from(from);
    if (stack.count() != 1) return false;
    value = stack[0];
    return true;
  }
  static handle cast(const ninedof::Configuration& c, return_value_policy, handle) {
    return ninedof::python::stack_of({c}).attr("__getitem__")(0).release();
  }
};

/// A Configuration of Python of any shape.
template <>
struct type_caster<ninedof::python::ConfigurationStack> {
  static constexpr auto name = const_name("Configuration");
  template <class>
  using cast_op_type = const ninedof::python::ConfigurationStack&;
  operator const ninedof::python::ConfigurationStack&() const { return *value; }
  bool load(handle from, bool) {
    if (!hasattr(from, "internal_point")) return false;
    value.emplace(ninedof::python::stack_from(from));
    return true;
  }
  std::optional<ninedof::python::ConfigurationStack> value;
};

}  // namespace pybind11::detail
