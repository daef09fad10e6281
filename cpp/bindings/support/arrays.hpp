#pragma once
/// The one place where Python arrays become our types and back: type, shape, contiguity and alignment are checked here.

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <functional>
#include <string>
#include <vector>

#include "ninedof/math/error.hpp"
#include "ninedof/robot/geometry.hpp"
#include "support/interruptible.hpp"

namespace ninedof::python {

namespace py = pybind11;

/// The text of a value for a message, as the package words it: of one line, cut where it is long, whatever it is.
inline std::string shown(const py::handle& value) {
  return py::module_::import("ninedof.support.arguments").attr("shown")(value).cast<std::string>();
}

// numpy's arrays may lie at any address: views into a message, as Dask has them, or a field of packed records. Only an
// aligned one may be read as doubles. pybind11 has no public name for the flag.
constexpr int aligned = py::detail::npy_api::NPY_ARRAY_ALIGNED_;

using Array = py::array_t<double, py::array::c_style | py::array::forcecast | aligned>;

/// "(3, 3)"
inline std::string shape_text(const std::vector<py::ssize_t>& shape) {
  std::string text = "(";
  for (const py::ssize_t n : shape) text += (text.size() > 1 ? ", " : "") + std::to_string(n);
  return text + ")";
}

/// A float64 array of exactly this shape, or InvalidArgument naming the argument.
inline Array array_of_shape(const std::string& name, const py::object& value, const std::vector<py::ssize_t>& shape) {
  // Real numbers only: numpy would turn text into numbers, drop imaginary parts and forget masks.
  const py::array raw = py::array::ensure(value);
  PyErr_Clear();
  const bool real =
      raw && std::string("biuf").find(raw.dtype().kind()) != std::string::npos && !py::hasattr(value, "mask");
  if (!real) throw InvalidArgument(name, shown(value), "real numbers of shape " + shape_text(shape));
  const Array a = Array::ensure(raw);
  const std::vector<py::ssize_t> got(a.shape(), a.shape() + a.ndim());
  if (got != shape) throw InvalidArgument(name, "shape " + shape_text(got), "shape " + shape_text(shape));
  return a;
}

/// A Python number as a double, or InvalidArgument naming the argument.
inline double number_from(const std::string& name, const py::object& value) {
  const Array a = array_of_shape(name, value, {});
  return a.data()[0];
}

inline Triple triple_from(const std::string& name, const py::object& value) {
  const Array a = array_of_shape(name, value, {3, 3});
  Triple t;
  for (py::ssize_t i = 0; i < 3; ++i) t[static_cast<std::size_t>(i)] = Vec3(a.at(i, 0), a.at(i, 1), a.at(i, 2));
  return t;
}

inline Array array_from(const Triple& t) {
  Array a(std::vector<py::ssize_t>{3, 3});
  for (py::ssize_t i = 0; i < 3; ++i)
    for (py::ssize_t k = 0; k < 3; ++k) a.mutable_at(i, k) = t[static_cast<std::size_t>(i)][k];
  a.attr("setflags")(py::arg("write") = false);
  return a;
}

inline Eigen::VectorXd vector_from(const std::vector<double>& x) {
  return Eigen::VectorXd::Map(x.data(), static_cast<Eigen::Index>(x.size()));
}

template <class Derived>
Array array_from(const Eigen::MatrixBase<Derived>& m) {
  std::vector<py::ssize_t> shape{m.rows()};
  if constexpr (Derived::ColsAtCompileTime != 1) shape.push_back(m.cols());
  Array a(shape);
  Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>(a.mutable_data(), m.rows(),
                                                                                     m.cols()) = m;
  return a;
}

/// Writes a matrix row-major at `to`; returns the place after it.
template <class Derived>
double* write(const Eigen::MatrixBase<Derived>& m, double* to) {
  using RowMajor = Eigen::Matrix<double, Derived::RowsAtCompileTime, Derived::ColsAtCompileTime,
                                 Derived::ColsAtCompileTime == 1 ? Eigen::ColMajor : Eigen::RowMajor>;
  Eigen::Map<RowMajor> view(to);
  view = m;
  return to + m.size();
}

/// `columns` numbers for each of `count` configurations, or InvalidArgument naming the argument.
inline const double* rows(const std::string& name, const Array& a, long count, long columns) {
  if (a.size() != columns * count)
    throw InvalidArgument(name, std::to_string(a.size()) + " numbers", std::to_string(columns * count));
  return a.data();
}

/// Lengths of the nine legs at n poses, shape (n, 9).
inline std::vector<Vec9> lengths_from(const Array& lengths) {
  const long count = static_cast<long>(lengths.size() / 9);
  const double* row = rows("leg_lengths", lengths, count, 9);
  std::vector<Vec9> out;
  for (long k = 0; k < count; ++k, row += 9) out.push_back(Vec9::Map(row));
  return out;
}

/// Rows of `columns` numbers: those of `out` where one is given, else a new array (count, columns).
inline Array result_rows(long count, py::ssize_t columns, const py::object& out) {
  if (out.is_none()) return Array(std::vector<py::ssize_t>{count, columns});
  // Not `ensure`: a converted copy would be filled and thrown away.
  const bool fits = py::isinstance<Array>(out) && out.cast<py::array>().size() == count * columns;
  if (!fits || !out.cast<py::array>().writeable() || (out.cast<py::array>().flags() & aligned) == 0)
    throw InvalidArgument("out", py::repr(py::type::handle_of(out)).cast<std::string>(),
                          "a writeable aligned C-contiguous float64 array of the result's shape");
  return py::reinterpret_borrow<Array>(out);
}

/// Calls block(first, last, output row first) for blocks of rows, none longer than `most`, as in_slices does: on
/// `threads` threads and without the GIL, so that nothing in it may touch Python.
inline Array for_each_block(long count, py::ssize_t columns, long most, int threads, const py::object& out,
                            const std::function<void(long, long, double*)>& block) {
  Array result = result_rows(count, columns, out);
  double* data = result.mutable_data();
  in_slices(count, most, threads, [&](long first, long last) { block(first, last, data + first * columns); });
  return result;
}

/// Calls row(i, output row i) for every i of [0, count), likewise.
template <class Row>
Array for_each_row(long count, py::ssize_t columns, int threads, const py::object& out, const Row& row) {
  return for_each_block(count, columns, 64, threads, out, [&](long first, long last, double* to) {
    for (long i = first; i < last; ++i, to += columns) row(i, to);
  });
}

}  // namespace ninedof::python
