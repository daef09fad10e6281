#include "ninedof/proof/bounds.hpp"

#include <algorithm>
#include <limits>

#include "ninedof/proof/closed_form_bounds.hpp"
#include "support/arrays.hpp"
#include "support/lengths.hpp"
#include "support/module.hpp"

namespace ninedof::python {
namespace {

constexpr long designs_at_once = 8192;

/// Row i of (count, 2, columns): lower bounds, then upper bounds. NaN for a configuration without data.
template <class Bounds>
Array rows_of_bounds(const ConfigurationStack& c, py::ssize_t columns, int threads, const Bounds& bounds) {
  require_sound_arithmetic();  // also for an empty stack
  return for_each_row(c.count(), 2 * columns, threads, py::none(), [&](long i, double* out) {
    const Configuration at = c[i];
    if (at.position.hasNaN() || at.rotation.hasNaN() || at.internal_point.hasNaN()) {
      std::fill(out, out + 2 * columns, std::numeric_limits<double>::quiet_NaN());
      return;
    }
    bounds(i, at, [&, k = py::ssize_t{0}](const Interval& x) mutable {
      out[k] = x.lo;
      out[columns + k++] = x.hi;
    });
  });
}

}  // namespace

void bind_bounds(py::module_& m) {
  m.def("leg_length_bounds", [](const Geometry& g, const ConfigurationStack& c, int threads) {
    return rows_of_bounds(c, 9, threads, [&](long, const Configuration& at, auto put) {
      for (const Interval& x : leg_length_bounds(g, at)) put(x);
    });
  });
  m.def("determinant_bounds", [](const Geometry& g, const ConfigurationStack& c, int threads) {
    return rows_of_bounds(c, 3, threads, [&](long, const Configuration& at, auto put) {
      const DeterminantBounds found = determinant_bounds(g, at);
      for (const Interval& x : {found.n, found.b, found.c}) put(x);
    });
  });
  const auto with_length = [&](const char* name, py::ssize_t columns, auto each) {
    m.def(name, [=](const Geometry& g, const ConfigurationStack& c, const Array& length, int threads) {
      const Lengths lc(length, c.count());
      return rows_of_bounds(c, columns, threads,
                            [&](long i, const Configuration& at, auto put) { each(g, at, lc[i], put); });
    });
  };
  with_length("condition_number_bounds", 1, [](const Geometry& g, const Configuration& c, double lc, auto& put) {
    put(condition_number_bounds(g, c, lc));
  });
  with_length("axis_condition_number_bounds", 1, [](const Geometry& g, const Configuration& c, double lc, auto& put) {
    put(axis_condition_number_bounds(g, c, lc));
  });
  with_length("singular_value_bounds", 6, [](const Geometry& g, const Configuration& c, double lc, auto& put) {
    for (const Interval& x : singular_value_bounds(g, c, lc)) put(x);
  });
  with_length("jacobian_bounds", 54, [](const Geometry& g, const Configuration& c, double lc, auto& put) {
    for (const auto& row : jacobian_bounds(g, c, lc))
      for (const Interval& x : row) put(x);
  });
  m.def("hexagonal_condition_number_bounds", [](const Array& designs, int threads) {
    const long count = static_cast<long>(designs.size() / 6);
    const double* x = rows("designs", designs, count, 6);
    require_sound_arithmetic();
    return for_each_block(count, 2, designs_at_once, threads, py::none(), [&](long first, long last, double* to) {
      hexagonal_condition_number_bounds(x + 6 * first, last - first, to);
    });
  });
}

}  // namespace ninedof::python
