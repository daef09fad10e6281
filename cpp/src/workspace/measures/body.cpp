#include "workspace/measures/body.hpp"

#include <algorithm>
#include <cmath>

#include "math/numbers.hpp"
#include "math/sort_by.hpp"

namespace ninedof {
namespace {

constexpr int rays = 500;
constexpr int starts = 16;       // rays from which the least margin is sought
constexpr int tried = 12;        // directions in which each of them is moved at once
constexpr int halvings = 30;     // of a ray
constexpr double last = 1e-5;    // least move of a ray, radians
constexpr double spare = 1e-4;   // of the scale: what may be left between the rays

/// Evenly spread directions (Fibonacci lattice).
Vec3 direction(int n) {
  constexpr double golden = 2.399963229728653;
  const double z = 1.0 - (2.0 * n + 1.0) / rays, r = std::sqrt(1.0 - z * z);
  return {r * std::cos(golden * n), r * std::sin(golden * n), z};
}

struct Ray {
  Vec3 way;
  double margin;
};

class Sampler {
 public:
  Sampler(const Body& body, const LimitsAtPoints& margins, const Control& control)
      : body_(body), margins_(margins), control_(control) {
    for (int n = 0; n < rays; ++n) ways_.push_back(direction(n));
  }

  double scale() {
    double out = 1.0 + spare;
    for (const double depth : {0.3, 0.5, 0.7, 0.8, 0.9, 0.97, 1.0 + spare}) {
      const double free = crossed(at(ways_, depth), depth);
      if (free < depth) {
        out = free;
        break;
      }
    }
    for (;;) {
      const double less = crossed(lowest(out), out);
      if (less >= out) return out / (1.0 + spare);
      out = less;
    }
  }

 private:
  std::vector<Ray> at(const std::vector<Vec3>& ways, double scale) const {
    std::vector<Vec3> x;
    for (const Vec3& way : ways) x.push_back(body_.at(way, scale));
    std::vector<PointMargins> known(x.size());
    for (std::size_t from = 0; from < x.size(); from += at_index(margins_.block())) {
      const std::size_t count = std::min(at_index(margins_.block()), x.size() - from);
      margins_.evaluate(&x[from], static_cast<long>(count), &known[from], control_.stop);
    }
    std::vector<Ray> out;
    for (std::size_t n = 0; n < x.size(); ++n)
      out.push_back({ways[n], margins_.least(known[n], margins_.bounds().covers_bodies())});
    return out;
  }

  /// The least scale at which one of the rays that are forbidden at `scale` leaves the allowed part.
  double crossed(const std::vector<Ray>& found, double scale) const {
    std::vector<Vec3> ways;
    for (const Ray& ray : found)
      if (!(ray.margin >= 0.0)) ways.push_back(ray.way);
    double low = 0.0, high = scale;
    for (int k = 0; k < halvings && !ways.empty(); ++k) {
      const double middle = 0.5 * (low + high);
      const std::vector<Ray> there = at(ways, middle);
      std::vector<Vec3> forbidden;
      for (const Ray& ray : there)
        if (!(ray.margin >= 0.0)) forbidden.push_back(ray.way);
      if (forbidden.empty()) {
        low = middle;
      } else {
        high = middle;
        ways = std::move(forbidden);
      }
    }
    return ways.empty() ? scale : low;
  }

  /// Rays of locally least margin on the surface.
  std::vector<Ray> lowest(double scale) const {
    std::vector<Ray> all = at(ways_, scale), out;
    sort_by(all, &Ray::margin);
    for (const Ray& ray : all) {
      const auto near = [&](const Ray& other) { return other.way.dot(ray.way) > 0.95; };
      if (out.size() < starts && std::ranges::none_of(out, near)) out.push_back(ray);
    }
    int turn = 0;
    std::vector<double> step(out.size(), 0.1);
    for (double most = 0.1; most > last; most = *std::ranges::max_element(step)) {
      std::vector<Vec3> ways;
      for (std::size_t n = 0; n < out.size(); ++n)
        for (int k = 0; k < tried; ++k)
          ways.push_back((out[n].way + step[n] * ways_[at_index((turn * 37 + k * 83) % rays)]).normalized());
      ++turn;
      const std::vector<Ray> there = at(ways, scale);
      for (std::size_t n = 0; n < out.size(); ++n) {
        const auto from = there.begin() + static_cast<std::ptrdiff_t>(n * tried);
        const Ray best = *std::min_element(from, from + tried, [](auto& a, auto& b) { return a.margin < b.margin; });
        if (best.margin < out[n].margin) out[n] = best;
        else step[n] *= 0.5;
      }
    }
    return out;
  }

  const Body& body_;
  const LimitsAtPoints& margins_;
  const Control& control_;
  std::vector<Vec3> ways_;
};

}  // namespace

double allowed_scale(const Body& body, const LimitsAtPoints& margins, const Control& control) {
  Body now = body;
  double proved = 1.0;
  if (margins.bounds().covers_bodies()) {
    if (!body.box) {
      proved = std::min(1.0, margins.bounds().clear(body.centre) / body.half.x());
    } else if (!margins.bounds().over(body.centre, body.half).inside) {
      double low = 0.0, high = 1.0;
      for (int k = 0; k < halvings; ++k) {
        const double middle = 0.5 * (low + high);
        (margins.bounds().over(body.centre, middle * body.half).inside ? low : high) = middle;
      }
      proved = low;
    }
  }
  if (!(proved > 0.0)) return 0.0;
  if (margins.bounds().covers_bodies() && margins.all_bounded()) return proved;
  now.half *= proved;
  return proved * Sampler(now, margins, control).scale();
}

}  // namespace ninedof
