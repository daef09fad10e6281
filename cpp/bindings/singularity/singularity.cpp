#include "ninedof/singularity/singularity.hpp"

#include <cmath>

#include "support/module.hpp"
#include "support/struct.hpp"
#include "support/without_gil.hpp"

namespace ninedof::python {
namespace {

double* write(const PerMechanism& x, double* to) {
  to[0] = x.n;
  to[1] = x.b;
  to[2] = x.c;
  return to + 3;
}

double* write(const Vec3& x, double* to) {
  Eigen::Map<Vec3>{to} = x;
  return to + 3;
}

/// As a number, for an array of numbers; Python has the words in the same order.
double code(Mechanism mechanism) {
  return static_cast<double>(mechanism);
}

std::vector<Configuration> listed(const ConfigurationStack& c) {
  std::vector<Configuration> out;
  for (long i = 0; i < c.count(); ++i) out.push_back(c[i]);
  return out;
}

/// The nearest singularity of some poses, and the configuration there: that of the pose where none was found.
struct SingularityPlace : NearestSingularity {
  SingularityPlace(const NearestSingularity& found, const std::vector<Configuration>& poses, const Motions& motions)
      : NearestSingularity(found), there(poses[static_cast<std::size_t>(found.pose)]) {
    if (std::isfinite(distance)) there = plus(there, distance * (motions * direction));
  }
  Configuration there;
};

}  // namespace

void bind_singularity(py::module_& m) {
  m.def("singularity_margins", [](const Geometry& g, const ConfigurationStack& c, int threads, const py::object& out) {
    return for_each_block(c.count(), 3, 1024, threads, out, [&](long first, long last, double* to) {
      batch::singularity_margins(g, c.view(first, last), to);
    });
  });
  m.def("singularity", [](const Geometry& g, const ConfigurationStack& c, int threads) {
    return for_each_row(c.count(), 16, threads, py::none(), [&](long i, double* out) {
      const SingularityReport report = singularity(g, c[i]);
      out = write(report.sigma, write(report.margins, out));
      *out = code(report.mechanism);
      const Velocity& v = report.motion;
      write(v.sdot, write(v.pdot, write(v.omega, out + 1)));
    });
  });
  m.def("uncontrolled_motions", [](const Geometry& g, const ConfigurationStack& c, double tolerance) {
    if (c.count() != 1) throw InvalidArgument("configuration", std::to_string(c.count()) + " configurations", "one");
    const std::vector<Vec9> motions = uncontrolled_motions(g, c[0], tolerance);
    Array out(std::vector<py::ssize_t>{static_cast<py::ssize_t>(motions.size()), 9});
    for (std::size_t k = 0; k < motions.size(); ++k) Eigen::Map<Vec9>(out.mutable_data() + 9 * k) = motions[k];
    return out;
  });
  m.def("distance_to_singularity", [](const Geometry& g, const ConfigurationStack& c, const Array& direction,
                                      double most, int threads) {
    if (direction.size() != 9 * c.count())
      throw InvalidArgument("direction", std::to_string(direction.size()) + " numbers", std::to_string(9 * c.count()));
    const double* along = direction.data();
    return for_each_row(c.count(), 6, threads, py::none(), [&](long i, double* out) {
      const SingularityDistance found = distance_to_singularity(g, c[i], Eigen::Map<const Vec9>(along + 9 * i), most);
      out[0] = found.distance;
      out[1] = code(found.mechanism);
      out[2] = found.resolved ? 1.0 : 0.0;
      write(found.each, out + 3);
    });
  });
  using Place = SingularityPlace;
  py::class_<Place>(m, "NearestSingularity", "The nearest singularity about some configurations.")
      .def_readonly("distance", &Place::distance, "In the unit of the motions; infinite where none was found.")
      .def_property_readonly(
          "mechanism", [](const Place& p) { return static_cast<int>(p.mechanism); },
          "The determinant that is 0 there: 0 none, 1 N, 2 B, 3 C.")
      .def_property_readonly(
          "direction", [](const Place& p) { return array_from(p.direction); },
          "Of unit length, in the coordinates of the motions.")
      .def_readonly("pose", &Place::pose, "Index in the stack.")
      .def_property_readonly("configuration", [](const Place& p) { return p.there; }, "The singular one.");
  m.def("nearest_singularity", [](const Geometry& g, const ConfigurationStack& c, const Motions& motions, double most,
                                  int directions, int threads) {
    const std::vector<Configuration> poses = listed(c);
    return interruptible(py::none(), [&](const Control& control) {
      return Place(nearest_singularity(g, poses, motions, most, directions, threads, control.stop), poses, motions);
    });
  });
  m.def("nearest_singularities", [](const Geometry& g, const ConfigurationStack& c, bool internal_held) {
    const std::vector<Configuration> poses = listed(c);
    const SingularMotions ways = singular_motions(internal_held);
    const NearestSingularities found = interruptible(py::none(), [&](const Control& control) {
      return nearest_singularities(g, poses, internal_held, 0, control.stop);
    });
    return std::array{Place(found.shift, poses, ways.shift), Place(found.turn, poses, ways.turn),
                      Place(found.internal, poses, ways.internal)};
  });
}

}  // namespace ninedof::python
