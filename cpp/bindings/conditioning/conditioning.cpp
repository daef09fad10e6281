#include "ninedof/conditioning/conditioning.hpp"

#include <pybind11/stl.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <utility>
#include <vector>

#include "ninedof/batch/batch.hpp"
#include "ninedof/conditioning/axis_spectrum.hpp"
#include "ninedof/conditioning/characteristic_length.hpp"
#include "ninedof/conditioning/locked_legs.hpp"
#include "support/arrays.hpp"
#include "support/lengths.hpp"
#include "support/module.hpp"

namespace ninedof::python {
namespace {

constexpr long block = 1024;

/// Binds an index over a stack of configurations: fill(geometry, configurations, lengths, out) writes one number each.
template <class Fill>
void bind_index(py::module_& m, const char* name, Fill fill) {
  m.def(name, [fill](const Geometry& g, const ConfigurationStack& c, const Array& length, int threads,
                     const py::object& out) {
    const Lengths lc(length, c.count());
    return for_each_block(c.count(), 1, block, threads, out,
                          [&](long first, long last, double* to) { fill(g, c.view(first, last), lc.from(first), to); });
  });
}

/// A `fill` for an index that is a function of the singular values.
template <class OfSigma>
auto by_singular_values(OfSigma index) {
  return [index](const Geometry& g, const batch::Configurations& c, const batch::Lengths& lc, double* out) {
    std::vector<double> sigma(static_cast<std::size_t>(6 * c.count));
    batch::singular_values(g, c, lc, sigma.data());
    for (long k = 0; k < c.count; ++k) out[k] = index(Vec6(Eigen::Map<const Vec6>(sigma.data() + 6 * k)));
  };
}

}  // namespace

void bind_conditioning(py::module_& m) {
  const auto of_norm = [](Norm norm) {
    return [norm](const Geometry& g, const batch::Configurations& c, const batch::Lengths& lc, double* out) {
      batch::condition_numbers(g, c, lc, norm, out);
    };
  };
  bind_index(m, "condition_number_two", of_norm(Norm::two));
  bind_index(m, "condition_number_frobenius", of_norm(Norm::frobenius));
  bind_index(m, "reciprocal_condition_number",
             [](const Geometry& g, const batch::Configurations& c, const batch::Lengths& lc, double* out) {
               batch::condition_numbers(g, c, lc, Norm::two, out);
               for (long k = 0; k < c.count; ++k) out[k] = 1.0 / out[k];
             });
  bind_index(m, "manipulability", by_singular_values([](const Vec6& sigma) { return manipulability(sigma); }));
  bind_index(m, "isotropy_residual", by_singular_values([](const Vec6& sigma) { return isotropy_residual(sigma); }));

  m.def("singular_values",
        [](const Geometry& g, const ConfigurationStack& c, const Array& length, int threads, const py::object& out) {
          const Lengths lc(length, c.count());
          return for_each_block(c.count(), 6, block, threads, out, [&](long first, long last, double* to) {
            batch::singular_values(g, c.view(first, last), lc.from(first), to);
          });
        });
  m.def("locked_condition_numbers", [](const Geometry& g, const ConfigurationStack& c, const Array& length,
                                       const std::vector<std::pair<int, int>>& sets, int threads) {
    const Lengths lc(length, c.count());
    return for_each_row(c.count(), std::ssize(sets), threads, py::none(), [&](long i, double* to) {
      const PosedPoints here = posed_points(g, c[i]);
      const LockedLegs legs(here.at, here.legs, lc[i]);
      for (const auto& [first, second] : sets) *to++ = legs.condition_number({first, second});
    });
  });
  m.def("relative_manipulability", [](const Geometry& g, const ConfigurationStack& c, int threads) {
    return for_each_row(c.count(), 9, threads, py::none(), [&](long i, double* to) {
      const PosedPoints here = posed_points(g, c[i]);
      const LockedLegs legs(here.at, here.legs, 1.0);
      for (int leg = 0; leg < 9; ++leg) *to++ = legs.relative_manipulability(leg);
    });
  });
  m.def("hexagonal_condition_numbers", [](const Array& designs, int threads, const py::object& out) {
    const long count = static_cast<long>(designs.size() / 6);
    const double* x = rows("designs", designs, count, 6);
    return for_each_block(count, 1, 8 * block, threads, out, [&](long first, long last, double* to) {
      batch::hexagonal_condition_numbers(x + 6 * first, last - first, to);
    });
  });
  m.def("simd_level", &batch::simd_level);
  m.def("axis_singular_values", [](const Geometry& g, const ConfigurationStack& c, const Array& length, int threads) {
    const Lengths lc(length, c.count());
    return for_each_row(c.count(), 6, threads, py::none(), [&](long i, double* out) {
      const Configuration pose = c[i];
      Vec6 sigma;
      if (pose.position.hasNaN() || pose.rotation.hasNaN() || pose.internal_point.hasNaN()) {
        Eigen::Map<Vec6>{out} = sigma.setConstant(std::numeric_limits<double>::quiet_NaN());
        return;
      }
      const AxisSpectrum<double> a = axis_spectrum_of_any_size(axis_design(g, pose), lc[i]);
      sigma << a.axial_max, a.axial_min, a.transverse_max, a.transverse_max, a.transverse_min, a.transverse_min;
      sigma = sigma.cwiseInverse().eval();
      if (!sigma.hasNaN()) std::sort(sigma.begin(), sigma.end(), std::greater<>());
      Eigen::Map<Vec6>{out} = sigma;
    });
  });
  m.def("characteristic_length",
        [](const Geometry& g, const ConfigurationStack& c, const std::string& kind, int threads) {
          const LengthKind k = length_kind(kind);
          return for_each_row(c.count(), 1, threads, py::none(),
                              [&](long i, double* out) { *out = characteristic_length(g, c[i], k); });
        });
}

}  // namespace ninedof::python
