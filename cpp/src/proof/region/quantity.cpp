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
    const PoseForm f = sign_ * form(domain.pose(box), slopes);
    slopes.slope = f.a;
    return domain.greatest(f, box);
  }
  double attained(const FormPose& point) const override {
    Slopes none;
    return lower(sign_ * form(point, none));
  }
  Interval number(const Interval& value) const override { return plain(sign_ > 0.0 ? value : -value); }

 private:
  virtual PoseForm form(const FormPose& pose, Slopes& slopes) const = 0;
  virtual Interval plain(const Interval& value) const { return value; }
  double sign_;
};

FormVector leg(const Geometry& g, const FormPose& pose, int k) {
  const FormEnds e = ends_of(g, pose, k);
  return e.to - e.from;
}

Vec3 middle_of_vector(const FormVector& v) {
  return {v.x.c, v.y.c, v.z.c};
}

FormVector unit(const FormVector& v) {
  return inverse_root(dot(v, v)) * v;
}

class LegSquared : public Smooth {
 public:
  LegSquared(const Geometry& g, int k, bool greatest) : Smooth(greatest), g_(g), k_(k) {}

 private:
  PoseForm form(const FormPose& pose, Slopes& slopes) const override {
    const FormVector v = leg(g_, pose, k_);
    slopes.moves.add(v);
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
      const FormPose neutral{constant<PoseForm>(m.neutral.position), constant<PoseForm>(m.neutral.internal_point),
                             rotation_columns(m.neutral.rotation)};
      const FormVector along = sense_ * leg(g_, neutral, k_);
      axis_ = unit(platform ? FormVector{dot(neutral.q[0], along), dot(neutral.q[1], along), dot(neutral.q[2], along)}
                            : along);
    } else {
      axis_ = unit(constant<PoseForm>(axis));
    }
  }

 private:
  PoseForm form(const FormPose& pose, Slopes& slopes) const override {
    const FormVector v = leg(g_, pose, k_), along = unit(v);
    slopes.moves.add(v);
    const FormVector axis = platform_ ? axis_.x * pose.q[0] + axis_.y * pose.q[1] + axis_.z * pose.q[2] : axis_;
    slopes.moves.add(axis, middle_of_vector(v).norm());
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
  FormVector axis_;
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
  FormVector row(const FormPose& pose, int k, Slopes& slopes) const {
    const auto towards = [&](const FormVector& v) {
      slopes.moves.add(v);
      return unit(v);
    };
    if (which_ > 0) return towards(leg(g_, pose, k + (which_ == 1 ? 6 : 3)));
    const FormEnds e = ends_of(g_, pose, k);
    return cross(towards(e.from - pose.s), towards(e.to - pose.s));
  }
  PoseForm form(const FormPose& pose, Slopes& slopes) const override {
    const FormVector first = row(pose, 0, slopes), second = row(pose, 1, slopes), third = row(pose, 2, slopes);
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
    const FormVector along = constant<PoseForm>(n);
    double out = -infinity;
    for (const FormVector* x : {&one.from, &one.to})
      for (const FormVector* y : {&two.from, &two.to}) {
        const FormVector between = *y - *x;
        const PoseForm f = dot(along, between);
        const double most = domain.greatest(f, box);
        if (!(most > out)) continue;
        // The ends that decide. Others count for little: a direction that moves only them need not be divided.
        slopes.slope = f.a;
        slopes.moves = {};
        slopes.moves.add(between);
        out = most;
      }
    for (const FormEnds* e : {&one, &two}) slopes.moves.add(e->to - e->from, 1e-3);
    return std::min(out, 0.0);
  }
  double attained(const FormPose& point) const override {
    const auto [one, two, apart] = nearest_at(point);
    const Nearest near = nearest(middle_of_vector(one.from), middle_of_vector(one.to), middle_of_vector(two.from),
                                 middle_of_vector(two.to));
    const FormVector x = one.from + PoseForm(near.s) * (one.to - one.from),
                     y = two.from + PoseForm(near.t) * (two.to - two.from);
    const double squared = upper(dot(x - y, x - y));
    return -ninedof::detail::above(std::sqrt(squared));
  }
  Interval number(const Interval& value) const override { return -value; }

 private:
  struct Seen {
    FormEnds one, two;
    Vec3 apart;
  };
  Seen nearest_at(const FormPose& pose) const {
    const FormEnds one = ends_of(g_, pose, legs_.first), two = ends_of(g_, pose, legs_.second);
    return {one, two,
            nearest(middle_of_vector(one.from), middle_of_vector(one.to), middle_of_vector(two.from),
                    middle_of_vector(two.to))
                .apart};
  }

  Geometry g_;
  std::pair<int, int> legs_;
};

}  // namespace

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
