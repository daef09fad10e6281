#pragma once
/// Lists of the core as arrays, and back.

#include <algorithm>
#include <span>
#include <vector>

#include "support/arrays.hpp"

namespace ninedof::python {

/// Values as an array of numbers; of the shape (n,) unless another is given.
template <class T, class U>
py::array_t<T> column(const std::vector<U>& values, std::vector<py::ssize_t> shape = {}) {
  if (shape.empty()) shape.push_back(std::ssize(values));
  py::array_t<T> out(shape);
  std::transform(values.begin(), values.end(), out.mutable_data(), [](const U& v) { return static_cast<T>(v); });
  return out;
}

/// An array of `count` numbers as a list, or InvalidArgument naming the argument.
template <class T, class U = T>
std::vector<U> list_from(const char* name, const py::object& value, py::ssize_t count) {
  const auto a = value.cast<py::array_t<T, py::array::c_style | py::array::forcecast | aligned>>();
  if (a.size() != count) throw InvalidArgument(name, std::to_string(a.size()) + " numbers", std::to_string(count));
  std::vector<U> out;
  out.reserve(static_cast<std::size_t>(count));
  std::transform(a.data(), a.data() + count, std::back_inserter(out), [](T v) { return static_cast<U>(v); });
  return out;
}

/// Points as an array (n, 3).
inline Array array_from(const std::vector<Vec3>& points) {
  Array out(std::vector<py::ssize_t>{std::ssize(points), 3});
  double* to = out.mutable_data();
  for (const Vec3& point : points) to = write(point, to);
  return out;
}

/// Rotations as an array (n, 3, 3).
inline Array array_from(std::span<const Mat3> rotations) {
  Array out(std::vector<py::ssize_t>{std::ssize(rotations), 3, 3});
  double* to = out.mutable_data();
  for (const Mat3& q : rotations) to = write(q, to);
  return out;
}

/// An array (n, 3) as points, or InvalidArgument naming the argument.
inline std::vector<Vec3> points_from(const char* name, const py::object& value) {
  const auto a = value.cast<Array>();
  if (a.ndim() != 2 || a.shape(1) != 3) throw InvalidArgument(name, "another shape", "shape (n, 3)");
  std::vector<Vec3> out;
  for (py::ssize_t n = 0; n < a.shape(0); ++n) out.push_back(Eigen::Map<const Vec3>(a.data() + 3 * n));
  return out;
}

}  // namespace ninedof::python
