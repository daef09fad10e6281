#include "ninedof/robot/architecture_singularity.hpp"

#include "support/configurations.hpp"
#include "support/module.hpp"
#include "support/struct.hpp"

namespace ninedof::python {

void bind_architecture_singularity(py::module_& m) {
  constexpr std::array kinds{"lower_on_line", "upper_on_line", "base_in_point", "platform_in_point", "legs_coincide"};
  py::class_<ArchitectureSingularity>(m, "ArchitectureSingularity", "A design that is singular at every pose.")
      .def_property_readonly("kind", word_of(&ArchitectureSingularity::kind, kinds), "Its class.")
      .def_readonly("leg", &ArchitectureSingularity::leg, "Of legs_coincide, the first external leg, from 0.")
      .def_readonly("other", &ArchitectureSingularity::other, "Of legs_coincide, the second external leg, from 0.")
      .def_readonly("distance", &ArchitectureSingularity::distance, "Length by which a joint must move.")
      .def_readonly("relative", &ArchitectureSingularity::relative, "Over the longest side of a triangle of joints.");
  py::class_<SimilarTriangles>(m, "SimilarTriangles", "How far the external triangles are from similar ones.")
      .def_readonly("dissimilarity", &SimilarTriangles::dissimilarity, "0 to 1.")
      .def_property_readonly("rotations", copy_of(&SimilarTriangles::rotations),
                             "At which they are as parallel as they can be, shape (2, 3, 3).");
  m.def("nearest_architecture_singularity", &nearest_architecture_singularity);
  m.def("similar_triangles", &similar_triangles);
  m.def("homothety_residual",
        [](const Geometry& g, const ConfigurationStack& c) { return homothety_residual(g, c[0].rotation); });
}

}  // namespace ninedof::python
