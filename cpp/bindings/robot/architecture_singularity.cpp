#include "ninedof/robot/architecture_singularity.hpp"

#include "support/configurations.hpp"
#include "support/module.hpp"

namespace ninedof::python {

void bind_architecture_singularity(py::module_& m) {
  m.def("nearest_architecture_singularity", [](const Geometry& g) {
    const ArchitectureSingularity nearest = nearest_architecture_singularity(g);
    return py::make_tuple(static_cast<int>(nearest.kind), nearest.leg, nearest.other, nearest.distance,
                          nearest.relative);
  });
  m.def("similar_triangles", [](const Geometry& g) {
    const SimilarTriangles found = similar_triangles(g);
    Array rotations(std::vector<py::ssize_t>{2, 3, 3});
    using RowMajor = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;
    for (std::size_t k = 0; k < 2; ++k) Eigen::Map<RowMajor>(rotations.mutable_data() + 9 * k) = found.rotations[k];
    return py::make_tuple(found.dissimilarity, rotations);
  });
  m.def("homothety_residual",
        [](const Geometry& g, const ConfigurationStack& c) { return homothety_residual(g, c[0].rotation); });
}

}  // namespace ninedof::python
