/// The largest box around a design that is proved to be inside. Declared in ninedof/proof/admissible.hpp.

#include <algorithm>
#include <cmath>
#include <optional>

#include "math/linear/least_squares.hpp"
#include "math/numbers.hpp"
#include "ninedof/math/error.hpp"
#include "proof/admissible/examine.hpp"

namespace ninedof {
namespace admissible {
namespace {

using Vector = Eigen::VectorXd;

/// room - slope . x >= 0, where x has how far the box goes down, then up, from the design.
struct Bound {
  Vector slope;
  double room;
};

/// The bounds of a box within another; lengths are in half widths of the outer one.
std::vector<Bound> bounds_of(const Knowledge& known, std::size_t n, const std::vector<double>& at) {
  const auto count = static_cast<Eigen::Index>(n);
  std::vector<Bound> out;
  for (const Plane& cut : known.cuts) {
    Bound one{Vector::Zero(2 * count), cut.c - 0x1p-40 * (std::abs(cut.c) + slopes_of(cut))};
    for (Eigen::Index k = 0; k < count; ++k) {
      const double slope = cut.a[static_cast<std::size_t>(k)];
      one.room += slope * at[static_cast<std::size_t>(k)];
      (slope > 0.0 ? one.slope[k] : one.slope[count + k]) = std::abs(slope);
    }
    out.push_back(one);
  }
  for (Eigen::Index k = 0; k < count; ++k) {
    const double t = at[static_cast<std::size_t>(k)];
    out.push_back({Vector::Unit(2 * count, k), 1.0 + t});
    out.push_back({Vector::Unit(2 * count, count + k), 1.0 - t});
  }
  return out;
}

/// The most that x may be along a direction.
double reach_along(const std::vector<Bound>& bounds, const Vector& along) {
  double most = infinity;
  for (const Bound& one : bounds)
    if (const double slope = one.slope.dot(along); slope > 0.0) most = std::min(most, one.room / slope);
  return most;
}

/// The x of greatest product, by Newton's method on a logarithmic barrier: the problem is concave. Sides that start at
/// 0 stay there.
Vector widest(const std::vector<Bound>& bounds, const Vector& start) {
  Vector x = start;
  for (double weight = 1.0; weight > 1e-7; weight *= 0.3)
    for (int step = 0; step < 20; ++step) {
      Vector gradient = Vector::Zero(x.size());
      Eigen::MatrixXd bend = Eigen::MatrixXd::Identity(x.size(), x.size());
      for (Eigen::Index k = 0; k < x.size(); ++k)
        if (x[k] > 0.0) {
          gradient[k] = 1.0 / x[k];
          bend(k, k) = gradient[k] * gradient[k];
        }
      for (const Bound& one : bounds) {
        const Vector slope = (x.array() > 0.0).select(one.slope, 0.0);
        const double inverse = 1.0 / (one.room - slope.dot(x));
        if (slope.isZero(0.0)) continue;
        gradient -= weight * inverse * slope;
        bend += weight * inverse * inverse * slope * slope.transpose();
      }
      const Vector along = solve_definite(bend, gradient);
      double most = 1.0;
      for (const Bound& one : bounds)
        if (const double slope = one.slope.dot(along); slope > 0.0)
          most = std::min(most, 0.9 * (one.room - one.slope.dot(x)) / slope);
      for (Eigen::Index k = 0; k < x.size(); ++k)
        if (along[k] < 0.0) most = std::min(most, -0.9 * x[k] / along[k]);
      x += most * along;
      if (along.cwiseAbs().maxCoeff() < 1e-9) break;
    }
  return x;
}

class RoomSearch {
 public:
  RoomSearch(const DesignQuestion& question, const std::vector<double>& design, const std::vector<double>& proportions,
             long most_boxes, const Control& control)
      : question_(question),
        examiner_(question),
        design_(design),
        proportions_(proportions),
        most_boxes_(most_boxes),
        until_(most_boxes),
        control_(control) {}

  DesignRoom run() {
    double part = 0.25, growth = 0.15;
    DesignBox outer = around(part);
    while (growth > 0.005 && wide(outer) && !spent()) {
      const Examined found = examined(outer);
      if (!found.finished) break;
      if (breaks(found.known, outer)) break;
      const std::optional<Vector> x = inner(found.known, outer);
      const double before = size_;
      if (x) take(inside(outer, *x));
      if (!out_.found) {
        part *= 0.3;
        outer = around(part);
        continue;
      }
      if (size_ < before * (1.0 + growth)) growth *= 0.5;
      outer = grown({out_.low, out_.high}, growth);
    }
    if (out_.found) push_sides();
    until_ = 2 * most_boxes_;
    for (std::size_t side = 0; side < 2 * count() && out_.found; ++side) look_beyond(side);
    return out_;
  }

 private:
  std::size_t count() const { return design_.size(); }
  Examined examined(const DesignBox& box) {
    Examined found = examiner_.examine({box, {}, {}, {}}, control_.stop);
    out_.boxes += found.boxes;
    if (control_.progress) control_.progress(out_.boxes, 2 * most_boxes_, std::numeric_limits<double>::quiet_NaN());
    return found;
  }
  bool spent() const { return out_.boxes >= until_ || control_.stop.stop_requested(); }
  /// A design on a limit has no box around it: the search ends where boxes have no width.
  bool wide(const DesignBox& box) const {
    for (std::size_t k = 0; k < count(); ++k)
      if (!(box.high[k] - box.low[k] > 1e-9 * range(k))) return false;
    return true;
  }
  double range(std::size_t k) const { return question_.high[k] - question_.low[k]; }
  DesignBox around(double part) const {
    DesignBox out;
    for (std::size_t k = 0; k < count(); ++k) {
      const double half = proportions_.empty() ? part * range(k) : part * scale() * proportions_[k];
      out.low[k] = std::max(question_.low[k], design_[k] - half);
      out.high[k] = std::min(question_.high[k], design_[k] + half);
    }
    return out;
  }
  /// The proportions reach the range.
  double scale() const {
    double most = 0.0;
    for (std::size_t k = 0; k < count(); ++k) most = std::max(most, range(k) / proportions_[k]);
    return most;
  }
  /// A little more than the box on each side, so that the planes say how far it may go on.
  DesignBox grown(const DesignBox& box, double growth) const {
    DesignBox out;
    for (std::size_t k = 0; k < count(); ++k) {
      const double more = growth * (box.high[k] - box.low[k]);
      out.low[k] = std::max(question_.low[k], box.low[k] - more);
      out.high[k] = std::min(question_.high[k], box.high[k] + more);
    }
    return out;
  }
  void take(const DesignBox& box) {
    if (const double size = size_of(box); size > size_) {
      size_ = size;
      out_.found = true;
      out_.low = box.low;
      out_.high = box.high;
    }
  }
  double in_outer(const DesignBox& outer, std::size_t k) const {
    return (2.0 * design_[k] - outer.low[k] - outer.high[k]) / (outer.high[k] - outer.low[k]);
  }
  bool breaks(const Knowledge& known, const DesignBox& outer) {
    for (const Loss& loss : known.losses) {
      double value = loss.most.c + 0x1p-40 * (std::abs(loss.most.c) + slopes_of(loss.most));
      for (std::size_t k = 0; k < count(); ++k) value += loss.most.a[k] * in_outer(outer, k);
      if (value < 0.0) out_.demand = loss.demand;
    }
    return out_.demand >= 0;
  }
  std::optional<Vector> inner(const Knowledge& known, const DesignBox& outer) const {
    if (!known.complete) return std::nullopt;
    std::vector<double> at(count());
    for (std::size_t k = 0; k < count(); ++k) at[k] = in_outer(outer, k);
    const std::vector<Bound> bounds = bounds_of(known, count(), at);
    const auto n = static_cast<Eigen::Index>(count());
    Vector along = Vector::Ones(2 * n);
    if (!proportions_.empty())
      for (Eigen::Index k = 0; k < n; ++k) {
        const auto i = static_cast<std::size_t>(k);
        along[k] = along[n + k] = proportions_[i] / (outer.high[i] - outer.low[i]);
      }
    // A design at an end of the range has room to one side alone.
    for (Eigen::Index k = 0; k < n; ++k) {
      const double t = at[static_cast<std::size_t>(k)];
      if (t <= -1.0) along[k] = 0.0;
      if (t >= 1.0) along[n + k] = 0.0;
    }
    const double most = reach_along(bounds, along);
    if (!(most > 0.0)) return std::nullopt;
    return Vector((1.0 - 1e-9) * (proportions_.empty() ? widest(bounds, 0.3 * most * along) : Vector(most * along)));
  }
  /// Whether all of a box is inside: looked at whole, then in halves, `halvings` times.
  bool proved(const DesignBox& box, int halvings) {
    std::size_t widest = 0;
    for (std::size_t k = 0; k < count(); ++k) {
      if (!(box.low[k] < box.high[k])) return true;  // nothing was added
      if ((box.high[k] - box.low[k]) / range(k) > (box.high[widest] - box.low[widest]) / range(widest)) widest = k;
    }
    if (spent()) return false;
    const Examined found = examined(box);
    if (!found.finished) return false;
    if (!found.known.losses.empty()) return false;
    if (found.known.complete && found.known.cuts.empty()) return true;
    if (halvings == 0) return false;
    DesignBox below = box, above = box;
    below.high[widest] = above.low[widest] = 0.5 * (box.low[widest] + box.high[widest]);
    return proved(below, halvings - 1) && proved(above, halvings - 1);
  }
  DesignBox pushed(std::size_t side, double by) const {
    DesignBox out{out_.low, out_.high};
    const std::size_t k = side / 2;
    if (side % 2 == 0) out.low[k] = std::max(question_.low[k], out.low[k] - by);
    else out.high[k] = std::min(question_.high[k], out.high[k] + by);
    return out;
  }
  /// What is between a box and the same with one side farther out.
  static DesignBox slab(const DesignBox& from, const DesignBox& to, std::size_t side) {
    DesignBox out = to;
    const std::size_t k = side / 2;
    if (side % 2 == 0) out.high[k] = from.low[k];
    else out.low[k] = from.high[k];
    return out;
  }
  /// Planes of a whole box lose where limits are curved: sides go on by slabs, each proved alone; in given proportions
  /// all sides at once. All keep step: a side on a limit leaves the slabs of others nothing that could be proved.
  void push_sides() {
    for (double step = 0.25; step > 2e-3 && !spent();) {
      bool grew = false;
      for (std::size_t n = 0; n < (proportions_.empty() ? 2 * count() : 1); ++n) {
        const DesignBox from{out_.low, out_.high};
        DesignBox to = from;
        if (proportions_.empty()) {
          to = pushed(n, step * (from.high[n / 2] - from.low[n / 2]));
        } else {
          for (std::size_t k = 0; k < count(); ++k) {
            to.low[k] = from.low[k] - step * (design_[k] - from.low[k]);
            to.high[k] = from.high[k] + step * (from.high[k] - design_[k]);
          }
        }
        bool all = to.low != from.low || to.high != from.high;
        for (std::size_t side = 0; side < 2 * count() && all; ++side) {
          const std::size_t k = side / 2;
          const bool moved = side % 2 == 0 ? to.low[k] < from.low[k] : to.high[k] > from.high[k];
          all = to.low[k] >= question_.low[k] && to.high[k] <= question_.high[k] &&
                (!moved || proved(slab(from, to, side), 5));
        }
        if (!all) continue;
        grew = true;
        out_.low = to.low;
        out_.high = to.high;
      }
      if (!grew) step *= 0.5;
    }
  }
  /// Whether a design of a box beyond a side breaks a demand: the one that is broken nearest to the side is kept.
  bool broken_in(const DesignBox& beyond, std::size_t side) {
    const std::size_t k = side / 2;
    double nearest = infinity;
    if (spent()) return false;
    const Examined found = examined(beyond);
    for (const Loss& loss : found.known.losses) {
      const double slope = side % 2 == 0 ? -loss.most.a[k] : loss.most.a[k];  // outward
      const double far = least_of(loss.most) + std::abs(slope) + slope, near = far - 2.0 * slope;
      const double share = near < 0.0 ? 0.0 : far < 0.0 ? near / (near - far) : infinity;
      if (share >= nearest) continue;
      nearest = share;
      out_.beyond[k][side % 2] = {loss.demand, examiner_.met_at(loss.at, beyond)};
    }
    return nearest < infinity;
  }
  /// In slabs beyond a side, the thin one first, and at corners of a slab.
  void look_beyond(std::size_t side) {
    const DesignBox from{out_.low, out_.high};
    const std::size_t k = side / 2;
    const auto slab_of = [&](double part) {
      return slab(from, pushed(side, part * (from.high[k] - from.low[k])), side);
    };
    if (!(slab_of(0.01).low[k] < slab_of(0.01).high[k])) return;  // an end of the range
    for (const double part : {0.01, 0.1})
      if (broken_in(slab_of(part), side)) return;
    const DesignBox beyond = slab_of(0.1);
    for (std::size_t corner = 0; corner < std::size_t{1} << count(); ++corner) {
      if ((corner >> k) % 2 != side % 2) continue;
      DesignBox point = beyond;
      for (std::size_t i = 0; i < count(); ++i)
        point.low[i] = point.high[i] = (corner >> i) % 2 == 0 ? beyond.low[i] : beyond.high[i];
      if (broken_in(point, side)) return;
    }
  }
  DesignBox inside(const DesignBox& outer, const Vector& x) const {
    DesignBox out;
    for (std::size_t k = 0; k < count(); ++k) {
      const auto i = static_cast<Eigen::Index>(k);
      const double half = 0.5 * (outer.high[k] - outer.low[k]);
      out.low[k] = std::max(outer.low[k], design_[k] - half * x[i]);
      out.high[k] = std::min(outer.high[k], design_[k] + half * x[static_cast<Eigen::Index>(count()) + i]);
    }
    return out;
  }
  double size_of(const DesignBox& box) const {
    double out = 1.0;
    for (std::size_t k = 0; k < count(); ++k) out *= (box.high[k] - box.low[k]) / range(k);
    return out;
  }

  const DesignQuestion& question_;
  Examiner examiner_;
  const std::vector<double>& design_;
  const std::vector<double>& proportions_;
  long most_boxes_, until_;
  const Control& control_;
  double size_ = 0.0;
  DesignRoom out_;
};

}  // namespace
}  // namespace admissible

DesignRoom room_around(const DesignQuestion& question, const std::vector<double>& design,
                       const std::vector<double>& proportions, long most_boxes, const Control& control) {
  question.validate();
  for (const auto& [name, values] : {std::pair{"design", &design}, std::pair{"proportions", &proportions}})
    if (values->size() != question.varied.size() && (values == &design || !values->empty()))
      throw InvalidArgument(name, std::to_string(values->size()) + " values", "one for each variable that varies");
  for (std::size_t k = 0; k < design.size(); ++k)
    if (!(question.low[k] <= design[k] && design[k] <= question.high[k]))
      throw InvalidArgument("design", format_number(design[k]), format_interval(question.low[k], question.high[k]));
  for (const double one : proportions)
    if (!(one > 0.0 && std::isfinite(one))) throw InvalidArgument("proportions", format_number(one), "numbers above 0");
  return admissible::RoomSearch(question, design, proportions, most_boxes, control).run();
}

}  // namespace ninedof
