/// singularity_free: the determinants of unit rows behind det B, det C and det M (theory of the direct kinematics: the three
/// ways to lose the platform or O) keep their neutral sign, and at least a given size, at every pose looked at and at a few
/// places on the way to it.
/// Declared in design/constraints/constraint.hpp.

#include <Eigen/Geometry>
#include <Eigen/LU>

#include "design/constraints/constraint.hpp"

namespace ninedof {
namespace {

using Triplet = std::array<Vec3, 3>;

double determinant(const Triplet& rows) {
  return rows[0].dot(rows[1].cross(rows[2]));
}

class SingularityFree : public Constraint {
 public:
  /// The neutral configuration, the poses and what lies between.
  SingularityFree(const Limit& limit, int poses) : Constraint(limit), places_(1 + poses * limit.steps) {}

 private:
  Form form() const override { return Form::plain; }
  int items(Side) const override { return 3 * places_; }

  enum Which { det_b, det_c, det_m };

  /// Unit rows, and for M their lengths before.
  static Triplet rows(const PoseState& p, Which which, Vec3& length) {
    Triplet out;
    for (std::size_t i = 0; i < 3; ++i) {
      if (which != det_m) {
        out[i] = p.legs.direction[i + (which == det_b ? 6 : 3)];
        continue;
      }
      const Vec3 turning = (p.at[point_u + i] - p.at[point_s]).cross(p.legs.direction[i]);
      length[static_cast<Eigen::Index>(i)] = turning.norm();
      out[i] = length[static_cast<Eigen::Index>(i)] > 0.0 ? Vec3(turning / turning.norm()) : Vec3(Vec3::Zero());
    }
    return out;
  }

  static double neutral_sign(const DesignState& v, Which which) {
    Vec3 length;
    return determinant(rows(v.pose(0), which, length)) < 0.0 ? -1.0 : 1.0;
  }

  double value(const DesignState& v, Side, int item) const override {
    const auto which = static_cast<Which>(item % 3);
    Vec3 length;
    return neutral_sign(v, which) * determinant(rows(v.pose(item / 3), which, length));
  }

  void add_value_gradient(const DesignState& v, Side, int item, double scale, Row out) const override {
    const auto which = static_cast<Which>(item % 3);
    const int pose = item / 3;
    const PoseState& p = v.pose(pose);
    Vec3 length;
    const Triplet r = rows(p, which, length);
    const double sign = scale * neutral_sign(v, which);
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3 g = sign * r[(i + 1) % 3].cross(r[(i + 2) % 3]);
      const Vec3 across = g - g.dot(r[i]) * r[i];  // a unit row only turns
      if (which == det_m) {
        add_turning_row(v, pose, static_cast<int>(i), across, length[static_cast<Eigen::Index>(i)], out);
        continue;
      }
      const int leg = static_cast<int>(i) + (which == det_b ? 6 : 3);
      if (!(p.legs.length[leg] > 0.0)) continue;
      v.add_point(pose, leg_ends(leg).to, across / p.legs.length[leg], out);
      v.add_point(pose, leg_ends(leg).from, -across / p.legs.length[leg], out);
    }
  }

  /// Row i of M before it is made a unit vector is w x e: w from O to the platform joint, e along the external leg.
  static void add_turning_row(const DesignState& v, int pose, int i, const Vec3& across, double length, Row out) {
    const PoseState& p = v.pose(pose);
    const auto k = static_cast<std::size_t>(i);
    if (!(length > 0.0) || !(p.legs.length[i] > 0.0)) return;
    const Vec3 g = across / length;
    const Vec3& e = p.legs.direction[k];
    const Vec3 w = p.at[point_u + k] - p.at[point_s];
    const Vec3 by_w = e.cross(g), by_e = g.cross(w);
    const Vec3 turn = (by_e - by_e.dot(e) * e) / p.legs.length[i];
    v.add_point(pose, point_u + i, by_w + turn, out);
    v.add_point(pose, point_s, -by_w, out);
    v.add_point(pose, point_r + i, -turn, out);
  }

  int places_;
};

}  // namespace

std::unique_ptr<Constraint> make_singularity_free(const Limit& limit, int poses, Purpose) {
  return std::make_unique<SingularityFree>(limit, poses);
}

}  // namespace ninedof
