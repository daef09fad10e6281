#include "ninedof/singularity/singularity.hpp"

#include <cmath>

#include "support/arrays.hpp"
#include "support/module.hpp"
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

/// Distance, mechanism, direction, pose, and the motion (omega, dp, ds) that leads there, zero where none was found.
py::tuple row_of(const NearestSingularity& found, const Motions& motions) {
  Array direction(3), motion(9);
  write(found.direction, direction.mutable_data());
  Eigen::Map<Vec9>(motion.mutable_data()) =
      std::isfinite(found.distance) ? Vec9(found.distance * (motions * found.direction)) : Vec9(Vec9::Zero());
  return py::make_tuple(found.distance, code(found.mechanism), direction, found.pose, motion);
}

}  // namespace

void bind_singularity(py::module_& m) {
  m.def("singularity_margins",
        [](const Geometry& g, const Array& p, const Array& q, const Array& s, int threads, const py::object& out) {
          const ConfigurationStack c(p, q, s);
          return for_each_block(c.count(), 3, 1024, threads, out, [&](long first, long last, double* to) {
            batch::singularity_margins(g, c.view(first, last), to);
          });
        });
  m.def("singularity", [](const Geometry& g, const Array& p, const Array& q, const Array& s, int threads) {
    const ConfigurationStack c(p, q, s);
    return for_each_row(c.count(), 16, threads, py::none(), [&](long i, double* out) {
      const SingularityReport report = singularity(g, c[i]);
      out = write(report.sigma, write(report.margins, out));
      *out = code(report.mechanism);
      const Velocity& v = report.motion;
      write(v.sdot, write(v.pdot, write(v.omega, out + 1)));
    });
  });
  m.def("uncontrolled_motions",
        [](const Geometry& g, const Array& p, const Array& q, const Array& s, double tolerance) {
          const ConfigurationStack c(p, q, s);
          if (c.count() != 1)
            throw InvalidArgument("configuration", std::to_string(c.count()) + " configurations", "one");
          const std::vector<Vec9> motions = uncontrolled_motions(g, c[0], tolerance);
          Array out(std::vector<py::ssize_t>{static_cast<py::ssize_t>(motions.size()), 9});
          for (std::size_t k = 0; k < motions.size(); ++k) Eigen::Map<Vec9>(out.mutable_data() + 9 * k) = motions[k];
          return out;
        });
  m.def("distance_to_singularity", [](const Geometry& g, const Array& p, const Array& q, const Array& s,
                                      const Array& direction, double most, int threads) {
    const ConfigurationStack c(p, q, s);
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
  m.def("nearest_singularity", [](const Geometry& g, const Array& p, const Array& q, const Array& s,
                                  const Array& motions, double most, int directions, int threads) {
    if (motions.size() != 27) throw InvalidArgument("motions", std::to_string(motions.size()) + " numbers", "27");
    const std::vector<Configuration> poses = listed(ConfigurationStack(p, q, s));
    const Motions ways = Eigen::Map<const Eigen::Matrix<double, 9, 3, Eigen::RowMajor>>(motions.data());
    return row_of(interruptible(
                      py::none(),
                      [&](const Control& control) {
                        return nearest_singularity(g, poses, ways, most, directions, threads, control.stop);
                      },
                      [](NearestSingularity&) { return false; }),
                  ways);
  });
  m.def("nearest_singularities",
        [](const Geometry& g, const Array& p, const Array& q, const Array& s, bool internal_held) {
          const std::vector<Configuration> poses = listed(ConfigurationStack(p, q, s));
          const SingularMotions ways = singular_motions(internal_held);
          const NearestSingularities found = interruptible(
              py::none(),
              [&](const Control& control) { return nearest_singularities(g, poses, internal_held, 0, control.stop); },
              [](NearestSingularities&) { return false; });
          return py::make_tuple(row_of(found.shift, ways.shift), row_of(found.turn, ways.turn),
                                row_of(found.internal, ways.internal));
        });
}

}  // namespace ninedof::python
