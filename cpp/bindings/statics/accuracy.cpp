#include "ninedof/statics/accuracy.hpp"

#include <algorithm>

#include "support/configurations.hpp"
#include "support/module.hpp"

namespace ninedof::python {
namespace {

using RowMajor9 = Eigen::Matrix<double, 9, 9, Eigen::RowMajor>;

/// 21 numbers for each configuration: nine legs, then twelve joints.
Tolerances tolerances_at(const double* from) {
  Tolerances t;
  t.legs = Eigen::Map<const Vec9>(from);
  std::copy_n(from + 9, 12, t.joints.begin());
  return t;
}

void require_tolerances(const Array& a, long count) {
  if (a.size() != 21 * count)
    throw InvalidArgument("tolerances", std::to_string(a.size()) + " numbers", std::to_string(21 * count));
}

}  // namespace

void bind_accuracy(py::module_& m) {
  m.def("error_map", [](const Geometry& g, const ConfigurationStack& c, int threads) {
    return for_each_row(c.count(), 81, threads, py::none(),
                        [&](long i, double* out) { Eigen::Map<RowMajor9>{out} = error_map(g, c[i]); });
  });
  m.def("error_bounds", [](const Geometry& g, const ConfigurationStack& c, const Array& tolerances, int threads) {
    require_tolerances(tolerances, c.count());
    const double* t = tolerances.data();
    return for_each_row(c.count(), 93, threads, py::none(), [&](long i, double* out) {
      const ErrorBounds b = error_bounds(g, c[i], tolerances_at(t + 21 * i));
      Eigen::Map<Eigen::Matrix<double, 12, 1>>{out} << b.components, b.rotation, b.position, b.internal_point;
      Eigen::Map<RowMajor9>{out + 12} = b.covariance;
    });
  });
  m.def("error_samples", [](const Geometry& g, const ConfigurationStack& c, const Array& tolerances, long count,
                            std::uint64_t seed, int threads) {
    const Configuration at = c[0];
    require_tolerances(tolerances, 1);
    const Tolerances t = tolerances_at(tolerances.data());
    return for_each_row(count, 9, threads, py::none(), [&](long i, double* out) {
      Eigen::Map<Vec9>{out} = error_sample(g, at, t, seed, static_cast<std::uint64_t>(i));
    });
  });
}

}  // namespace ninedof::python
