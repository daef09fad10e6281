#include "support/support.hpp"

#include <Eigen/Geometry>
#include <sstream>

namespace support {

double Random::uniform(double low, double high) {
  return low + (high - low) * 0x1p-53 * static_cast<double>(engine_() >> 11);
}
double Random::log_uniform(double low, double high) {
  return std::exp(uniform(std::log(low), std::log(high)));
}
double Random::sign() {
  return uniform(-1.0, 1.0) < 0.0 ? -1.0 : 1.0;
}
double Random::normal() {
  return std::sqrt(-2.0 * std::log(uniform(0x1p-60, 1.0))) * std::cos(uniform(0.0, 2.0 * pi));
}

template Vec3 Random::matrix<Vec3>();
template Vec6 Random::matrix<Vec6>();
template Vec9 Random::matrix<Vec9>();
template Mat3 Random::matrix<Mat3>();
template ninedof::Mat6 Random::matrix<ninedof::Mat6>();

Vec3 Random::unit() {
  return matrix<Vec3>().normalized();
}
Mat3 Random::rotation() {
  return Eigen::Quaterniond(matrix<Eigen::Vector4d>().normalized()).toRotationMatrix();
}
Mat3 Random::rotation(double most) {
  return Eigen::AngleAxisd(uniform(0.0, most), unit()).toRotationMatrix();
}

Triple random_triple(Random& random, double size) {
  Triple t;
  for (std::size_t i = 0; i < 3; ++i) {
    const double angle = 2.0 * pi / 3.0 * static_cast<double>(i) + random.uniform(-0.6, 0.6);
    const double radius = size * random.uniform(0.6, 1.4);
    t[i] = {radius * std::cos(angle), radius * std::sin(angle), size * random.uniform(-0.3, 0.3)};
  }
  return t;
}

Robot random_robot(Random& random) {
  const double base = random.uniform(1.0, 3.0), platform = random.uniform(0.5, 1.5);
  const Geometry geometry(random_triple(random, base), random_triple(random, base), random_triple(random, platform),
                          random_triple(random, platform));
  const double height = random.uniform(2.0, 4.0);
  Configuration c;
  c.position = {random.uniform(-0.5, 0.5), random.uniform(-0.5, 0.5), height};
  c.internal_point = {random.uniform(-0.5, 0.5), random.uniform(-0.5, 0.5), height * random.uniform(0.35, 0.65)};
  c.rotation = random.rotation(0.5);
  return {geometry, c};
}

Robot any_robot(Random& random, bool hexagonal) {
  Robot r = random_robot(random);
  if (hexagonal)
    r.geometry = Geometry::hexagonal(random.uniform(0.1, 3.0), random.uniform(0.1, 3.0), random.uniform(0.1, 2.0),
                                     random.uniform(0.1, 2.0));
  r.configuration.rotation = random.rotation();
  return r;
}

Orbit random_orbit(Random& random) {
  return {random.uniform(0.3, 4.0), random.uniform(-pi, pi), random.uniform(-1.0, 1.0)};
}

Robot random_symmetric_robot(Random& random) {
  const Orbit a = random_orbit(random), b = random_orbit(random), c = random_orbit(random), d = random_orbit(random);
  return {Geometry::symmetric(a, b, c, d),
          ninedof::neutral(random.uniform(-6.0, 6.0), random.uniform(-6.0, 6.0), random.uniform(-pi, pi))};
}

Triple scaled(Triple t, double factor) {
  for (Vec3& joint : t) joint *= factor;
  return t;
}

Robot scaled(const Robot& r, double factor) {
  const Geometry& g = r.geometry;
  const Configuration& c = r.configuration;
  return {{scaled(g.base_external(), factor), scaled(g.base_internal(), factor), scaled(g.platform_external(), factor),
           scaled(g.platform_internal(), factor)},
          {c.position * factor, c.rotation, c.internal_point * factor}};
}

double relative_error(double a, double b) {
  if (a == b) return 0.0;
  const double error = std::abs(a - b) / std::abs(b);
  return std::isfinite(error) ? error : infinity;
}

double matrix_error(const Eigen::Ref<const Eigen::MatrixXd>& a, const Eigen::Ref<const Eigen::MatrixXd>& b) {
  if (!a.allFinite() || !b.allFinite()) return infinity;
  return (a - b).cwiseAbs().maxCoeff() / b.cwiseAbs().maxCoeff();
}

bool all_nan(const Eigen::Ref<const Eigen::MatrixXd>& m) {
  return m.array().isNaN().all();
}

std::string text(const Eigen::Ref<const Eigen::MatrixXd>& m) {
  std::ostringstream out;
  out << m;
  return out.str();
}

std::string message_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const ninedof::InvalidArgument& error) {
    return error.what();
  }
  return "nothing thrown";
}

bool refuses(const std::string& start, const std::function<void()>& action) {
  return message_of(action).starts_with(start + ": got ");
}

}  // namespace support
