#include "position/certified/rotation_search.hpp"

#include <cmath>
#include <optional>

namespace ninedof {
namespace {

constexpr long most_boxes = 30000;  // of a search: forty times the usual number; a family of solutions has no end
constexpr double least_width = 0x1p-24;  // of a box: where two solutions meet, rounding hides more than half the digits
constexpr double widest_proof = 0.5;  // half-width of a cube in which a solution is alone
constexpr int polish_steps = 4;
constexpr double enough = 0.6;  // of the width: a box that shrinks to less is looked at again before it is cut

using detail::above, detail::below;
using Centre = std::array<double, 4>;

Eigen::Index at(std::size_t k) {
  return static_cast<Eigen::Index>(k);
}

/// Bounds of preconditioned equations: |value|, the error of the slopes, and how much the slopes change.
struct KrawczykBounds {
  std::array<double, 3> value, error, change;
};

KrawczykBounds krawczyk_bounds(const Quadratics& f) {
  KrawczykBounds out{};
  for (std::size_t i = 0; i < 3; ++i) {
    out.value[i] = magnitude(f[i].value);
    for (const Interval& x : f[i].slope) out.error[i] = above(out.error[i] + magnitude(x));
    for (const Interval& x : f[i].bend) out.change[i] = above(out.change[i] + 2.0 * magnitude(x));
  }
  return out;
}

double most(const std::array<double, 3>& x) {
  return std::max({x[0], x[1], x[2]});
}

/// Krawczyk's operator maps |t_k| <= r into its interior: there is one solution in there, and one only.
bool proves(const KrawczykBounds& a, double r) {
  for (std::size_t i = 0; i < 3; ++i)
    if (!(above(a.value[i] + above(above(a.error[i] + above(a.change[i] * r)) * r)) < r)) return false;
  return true;
}

/// Holds all points of a chart with |t_k| <= r; as many as it can, but no others, if `within`.
ChartBox cube(const Centre& centre, std::size_t chart, double r, bool within = false) {
  ChartBox out{chart, {}};
  for (std::size_t i = 0; i < 4; ++i) {
    const double low = centre[i] - r, high = centre[i] + r;
    out.z[i] = i == chart ? Interval(1.0)
               : within   ? Interval(above(low), below(high))
                          : Interval(below(low), above(high));
  }
  return out;
}

/// The solution that Newton's method finds from a point, if it is proved to exist.
std::optional<ProvedRotation> prove_from(const RotationQuadrics& quadrics, Centre centre, std::size_t chart) {
  const auto free = free_in(chart);
  for (int step = 0; step <= polish_steps; ++step) {
    const auto f = solved_for_linear(quadrics.around(centre, chart));
    if (!f) return {};
    if (step == polish_steps) {
      // The condition is value + error r + change r^2 < r: the largest and the least r, and a little less and more.
      const KrawczykBounds a = krawczyk_bounds(*f);
      const double value = most(a.value), change = most(a.change), linear = 1.0 - most(a.error);
      const double root = linear + std::sqrt(linear * linear - 4.0 * change * value);
      const double far = std::min(0.99 * 0.5 * root / change, widest_proof), near = 1.01 * 2.0 * value / root + 1e-300;
      if (!proves(a, far) || !proves(a, near)) return {};
      return ProvedRotation{cube(centre, chart, far, true), cube(centre, chart, near), 0};
    }
    for (std::size_t i = 0; i < 3; ++i) {
      double& x = centre[free[i]];
      x -= middle((*f)[i].value);
      if (!(std::abs(x) <= 2.0)) return {};
    }
  }
  return {};
}

bool distinct(const QuaternionBounds& a, const QuaternionBounds& b) {
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (!contains(a[i] * b[j] - a[j] * b[i], 0.0)) return true;
  return false;
}

class Search {
 public:
  Search(const RotationQuadrics& quadrics, const std::vector<Eigen::Vector4d>& guesses)
      : quadrics_(quadrics), guesses_(guesses.size()) {
    for (std::size_t k = 0; k < guesses_; ++k) {
      Eigen::Index chart;
      guesses[k].cwiseAbs().maxCoeff(&chart);
      const Eigen::Vector4d z = guesses[k] / guesses[k][chart];
      try_from({z[0], z[1], z[2], z[3]}, at_index(chart), k);
    }
  }

  ProvedRotations run() {
    // Some component of a quaternion is the largest.
    for (std::size_t chart = 0; chart < 4; ++chart) ahead_.push_back(cube(Centre{}, chart, 1.0));
    while (!ahead_.empty() && out_.boxes < most_boxes) {
      const ChartBox box = ahead_.back();
      ahead_.pop_back();
      ++out_.boxes;
      examine(box);
    }
    out_.undecided.insert(out_.undecided.end(), ahead_.begin(), ahead_.end());
    return std::move(out_);
  }

 private:
  /// Looks for a solution near a point; it counts only if it is proved to be another one.
  void try_from(const Centre& centre, std::size_t chart, std::size_t guess) {
    auto found = prove_from(quadrics_, centre, chart);
    if (!found) return;
    found->guess = guess;
    for (const ProvedRotation& other : out_.proved)
      if (!distinct(found->enclosure.z, other.enclosure.z)) return;
    out_.proved.push_back(*found);
  }

  bool settled(const ChartBox& box) const {
    return std::any_of(out_.proved.begin(), out_.proved.end(),
                       [&](const ProvedRotation& p) { return inside(box, p.alone); });
  }

  void examine(ChartBox box) {
    const auto free = free_in(box.chart);
    Centre centre{};
    Vec3 reach;
    centre[box.chart] = 1.0;
    for (std::size_t i = 0; i < 3; ++i) {
      const Interval& x = box.z[free[i]];
      const double m = centre[free[i]] = middle(x);
      reach[at(i)] = std::max(above(x.hi - m), above(m - x.lo));
    }
    const double before = reach.maxCoeff();
    const Quadratics f = quadrics_.around(centre, box.chart);
    for (const Quadratic& equation : f)
      if (!contains(range(equation, reach), 0.0)) return;
    if (const auto solved = solved_for_linear(f)) {
      if (!contract(box, *solved, centre, reach) || settled(box)) return;
      if (promising(*solved, reach)) {
        Centre from = centre;
        for (std::size_t i = 0; i < 3; ++i) from[free[i]] -= middle((*solved)[i].value);
        if (!settled(cube(from, box.chart, 0.0))) try_from(from, box.chart, guesses_);
        if (settled(box)) return;
      }
    }
    split(box, 2.0 * before);
  }

  /// Leaves what the equations, solved for the linear terms, leave of a box; false if that is nothing.
  static bool contract(ChartBox& box, const Quadratics& solved, const Centre& centre, const Vec3& reach) {
    const auto free = free_in(box.chart);
    for (std::size_t i = 0; i < 3; ++i) {
      Interval& x = box.z[free[i]];
      const Interval y = Interval(centre[free[i]]) - range(solved[i], reach);
      if (y.hi < x.lo || y.lo > x.hi) return false;
      x = {std::max(x.lo, y.lo), std::min(x.hi, y.hi)};
    }
    return true;
  }

  /// Whether a solution near the box is likely to be proved from its middle.
  static bool promising(const Quadratics& solved, const Vec3& reach) {
    const KrawczykBounds a = krawczyk_bounds(solved);
    for (std::size_t i = 0; i < 3; ++i)
      if (!(a.value[i] <= 2.0 * reach[at(i)])) return false;
    return 4.0 * most(a.change) * most(a.value) < 1.0;
  }

  void split(ChartBox box, double before) {
    const auto free = free_in(box.chart);
    const std::size_t widest =
        *std::max_element(free.begin(), free.end(), [&](auto i, auto j) { return width(box.z[i]) < width(box.z[j]); });
    const double now = width(box.z[widest]);
    if (now < least_width) {
      out_.undecided.push_back(box);
      return;
    }
    if (now > enough * before) {
      ChartBox half = box;
      half.z[widest].hi = box.z[widest].lo = middle(box.z[widest]);
      ahead_.push_back(half);
    }
    ahead_.push_back(box);
  }

  const RotationQuadrics& quadrics_;
  std::size_t guesses_;
  ProvedRotations out_;
  std::vector<ChartBox> ahead_;
};

}  // namespace

bool inside(const ChartBox& box, const ChartBox& outer) {
  const bool negative = box.z[outer.chart].hi < 0.0;  // a quaternion and its negative are one rotation
  const auto z = [&](std::size_t i) { return negative ? -box.z[i] : box.z[i]; };
  const Interval one = z(outer.chart);
  if (!(one.lo > 0.0)) return false;
  for (const std::size_t i : free_in(outer.chart))
    if (!((z(i) - Interval(outer.z[i].lo) * one).lo >= 0.0 && (Interval(outer.z[i].hi) * one - z(i)).lo >= 0.0))
      return false;
  return true;
}

ProvedRotations proved_rotations(const RotationQuadrics& quadrics, const std::vector<Eigen::Vector4d>& guesses) {
  return Search(quadrics, guesses).run();
}

}  // namespace ninedof
