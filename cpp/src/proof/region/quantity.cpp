#include "proof/region/quantity.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "ninedof/singularity/singularity.hpp"
#include "robot/joint_cones.hpp"
#include "robot/leg_pairs.hpp"

namespace ninedof::over_region {
namespace {

/// A function that is one form, times a sign.
class Smooth : public Quantity {
 public:
  explicit Smooth(bool greatest) : sign_(greatest ? 1.0 : -1.0) {}
  double bound(const Domain& domain, const Box& box, Slopes& slopes) const override {
    const Form f = sign_ * form(domain.pose(box), slopes);
    slopes.slope = f.a;
    return domain.greatest(f, box);
  }
  double attained(const FormPose& point) const override {
    Slopes none;
    return lower(sign_ * form(point, none));
  }
  Interval number(const Interval& value) const override { return plain(sign_ > 0.0 ? value : -value); }

 private:
  virtual Form form(const FormPose& pose, Slopes& slopes) const = 0;
  virtual Interval plain(const Interval& value) const { return value; }
  double sign_;
};

Vector leg(const Geometry& g, const FormPose& pose, int k) {
  const Ends e = ends_of(g, pose, k);
  return e.to - e.from;
}

Vec3 centre(const Vector& v) {
  return {v.x.c, v.y.c, v.z.c};
}

Vector unit(const Vector& v) {
  return inverse_root(dot(v, v)) * v;
}

class LegSquared : public Smooth {
 public:
  LegSquared(const Geometry& g, int k, bool greatest) : Smooth(greatest), g_(g), k_(k) {}

 private:
  Form form(const FormPose& pose, Slopes& slopes) const override {
    const Vector v = leg(g_, pose, k_);
    slopes.add(v);
    return dot(v, v);
  }
  Interval plain(const Interval& squared) const override { return sqrt(squared); }

  Geometry g_;
  int k_;
};

/// The cosine of the angle, of which the least belongs to the greatest angle.
class ConeCosine : public Smooth {
 public:
  ConeCosine(const PosedRobot& m, int k, bool platform, const Vec3& axis, bool greatest)
      : Smooth(!greatest), g_(m.geometry), k_(leg_at(platform, k)), platform_(platform), sense_(sense_at(platform, k)) {
    if (axis.isZero(0.0)) {
      const FormPose neutral{fixed(m.neutral.position), fixed(m.neutral.internal_point),
                             rotation_columns(m.neutral.rotation)};
      const Vector along = sense_ * leg(g_, neutral, k_);
      axis_ =
          unit(platform ? Vector{dot(neutral.q[0], along), dot(neutral.q[1], along), dot(neutral.q[2], along)} : along);
    } else {
      axis_ = unit(fixed(axis));
    }
  }

 private:
  Form form(const FormPose& pose, Slopes& slopes) const override {
    const Vector v = leg(g_, pose, k_), along = unit(v);
    slopes.add(v);
    const Vector axis = platform_ ? axis_.x * pose.q[0] + axis_.y * pose.q[1] + axis_.z * pose.q[2] : axis_;
    slopes.add(axis, centre(v).norm());
    return sense_ * dot(along, axis);
  }
  /// Of a cosine; acos of the C library is within two units in the last place.
  Interval plain(const Interval& cosine) const override {
    const double most = std::clamp(cosine.hi, -1.0, 1.0), least = std::clamp(cosine.lo, -1.0, 1.0);
    return {std::max(std::acos(most) * (1.0 - 0x1p-50), 0.0), std::acos(least) * (1.0 + 0x1p-50)};
  }

  Geometry g_;
  int k_;
  bool platform_;
  double sense_;
  Vector axis_;
};

/// Rows of unit length at most, as in unit_rows.hpp.
class Determinant : public Smooth {
 public:
  Determinant(const PosedRobot& m, int which, bool greatest) : Smooth(greatest), g_(m.geometry), which_(which) {
    const PerMechanism at = singularity_margins(m.geometry, m.neutral);
    const double neutral = which == 0 ? at.n : which == 1 ? at.b : at.c;
    side_ = neutral < 0.0 ? -1.0 : 1.0;
  }

 private:
  Vector row(const FormPose& pose, int k, Slopes& slopes) const {
    const auto towards = [&](const Vector& v) {
      slopes.add(v);
      return unit(v);
    };
    if (which_ > 0) return towards(leg(g_, pose, k + (which_ == 1 ? 6 : 3)));
    const Ends e = ends_of(g_, pose, k);
    return cross(towards(e.from - pose.s), towards(e.to - pose.s));
  }
  Form form(const FormPose& pose, Slopes& slopes) const override {
    const Vector first = row(pose, 0, slopes), second = row(pose, 1, slopes), third = row(pose, 2, slopes);
    return side_ * dot(first, cross(second, third));
  }

  Geometry g_;
  int which_;
  double side_;
};

/// Less the distance of two segments. For any unit vector n, it is at least n . (a point of one - a point of the other),
/// which is least at two of their ends.
class Clearance : public Quantity {
 public:
  Clearance(const Geometry& g, int pair) : g_(g), legs_(leg_pair(pair)) {}
  double bound(const Domain& domain, const Box& box, Slopes& slopes) const override {
    const FormPose pose = domain.pose(box);
    const auto [one, two, apart] = nearest_at(pose);
    const double distance = apart.norm();
    if (!(distance > 0.0)) return 0.0;
    const Vec3 n = apart / (distance * (1.0 + 0x1p-48));  // of length at most 1
    const Vector along = fixed(n);
    double out = -infinity;
    for (const Vector* x : {&one.from, &one.to})
      for (const Vector* y : {&two.from, &two.to}) {
        const Vector between = *y - *x;
        const Form f = dot(along, between);
        const double most = domain.greatest(f, box);
        if (!(most > out)) continue;
        // The ends that decide. Others count for little: a direction that moves only them need not be divided.
        slopes.slope = f.a;
        slopes.moves.fill(0.0);
        slopes.add(between);
        out = most;
      }
    for (const Ends* e : {&one, &two}) slopes.add(e->to - e->from, 1e-3);
    return std::min(out, 0.0);
  }
  double attained(const FormPose& point) const override {
    const auto [one, two, apart] = nearest_at(point);
    const Nearest near = nearest(centre(one.from), centre(one.to), centre(two.from), centre(two.to));
    const Vector x = one.from + Form(near.s) * (one.to - one.from), y = two.from + Form(near.t) * (two.to - two.from);
    const double squared = upper(dot(x - y, x - y));
    return -ninedof::detail::above(std::sqrt(squared));
  }
  Interval number(const Interval& value) const override { return -value; }

 private:
  struct Seen {
    Ends one, two;
    Vec3 apart;
  };
  Seen nearest_at(const FormPose& pose) const {
    const Ends one = ends_of(g_, pose, legs_.first), two = ends_of(g_, pose, legs_.second);
    return {one, two, nearest(centre(one.from), centre(one.to), centre(two.from), centre(two.to)).apart};
  }

  Geometry g_;
  std::pair<int, int> legs_;
};

}  // namespace

Ends ends_of(const Geometry& g, const FormPose& pose, int k) {
  const auto i = static_cast<std::size_t>(k % 3);
  if (k < 3) return {fixed(g.base_external()[i]), pose.p + turned(pose, g.platform_external()[i])};
  if (k < 6) return {pose.p + turned(pose, g.platform_internal()[i]), pose.s};
  return {fixed(g.base_internal()[i]), pose.s};
}

std::unique_ptr<Quantity> make_quantity(const PosedRobot& m, const PoseQuantity& q) {
  using Kind = PoseQuantity::Kind;
  switch (q.kind) {
    case Kind::leg_length: return std::make_unique<LegSquared>(m.geometry, q.item, q.greatest);
    case Kind::base_cone:
    case Kind::platform_cone:
      return std::make_unique<ConeCosine>(m, q.item, q.kind == Kind::platform_cone, q.axis, q.greatest);
    case Kind::clearance: return std::make_unique<Clearance>(m.geometry, q.item);
    case Kind::determinant: break;
  }
  return std::make_unique<Determinant>(m, q.item, q.greatest);
}

}  // namespace ninedof::over_region
