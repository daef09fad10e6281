/// singularity_free: det B, det C and det N of singularity.hpp keep their sign of the neutral configuration and at
/// least a given size. They are tested there and, unless the limit holds there alone, at every pose and at a few
/// places on the straight way to it. Declared in problem/constraints/table.hpp.

#include "problem/constraints/constraint.hpp"
#include "singularity/unit_rows.hpp"

namespace ninedof {
namespace {

class SingularityFree : public Constraint {
 public:
  SingularityFree(const Limit& limit, int poses) : Constraint(limit), places_(1 + poses * limit.steps) {}

 private:
  Form form() const override { return Form::plain; }
  int items(Side) const override { return 3 * places_; }

  enum Which { det_b, det_c, det_n };

  /// From O to joint `point`; zero without direction.
  static Vec3 from_o(const PoseState& p, int point) { return p.at[at_index(point)] - p.at[point_s]; }
  static Vec3 direction(const Vec3& v) {
    const double length = v.norm();
    return length > 0.0 ? Vec3(v / length) : Vec3(Vec3::Zero());
  }

  static Triple rows(const PoseState& p, Which which) {
    UnitVectors v;
    for (std::size_t i = 0; i < 3; ++i) {
      const int k = static_cast<int>(i);
      if (which == det_n) {
        v.d[i] = direction(from_o(p, point_r + k));
        v.w[i] = direction(from_o(p, point_u + k));
      }
      v.e_tilde[i] = p.legs.direction[i + 3];
      v.e_hat[i] = p.legs.direction[i + 6];
    }
    const UnitRows all = unit_rows(v);
    return which == det_n ? all.n : which == det_b ? all.b : all.c;
  }

  static double neutral_sign(const DesignState& v, Which which) {
    return determinant(rows(v.pose(0), which)) < 0.0 ? -1.0 : 1.0;
  }

  double value(const DesignState& v, Side, int item) const override {
    const auto which = static_cast<Which>(item % 3);
    return neutral_sign(v, which) * determinant(rows(v.pose(item / 3), which));
  }

  void add_value_gradient(const DesignState& v, Side, int item, double scale, Row out) const override {
    const auto which = static_cast<Which>(item % 3);
    const int pose = item / 3;
    const Triple r = rows(v.pose(pose), which);
    const double sign = scale * neutral_sign(v, which);
    for (std::size_t i = 0; i < 3; ++i) {
      const int k = static_cast<int>(i);
      const Vec3 g = sign * r[(i + 1) % 3].cross(r[(i + 2) % 3]);
      if (which == det_n) {
        const Vec3 d = from_o(v.pose(pose), point_r + k), w = from_o(v.pose(pose), point_u + k);
        add_direction(v, pose, point_s, point_r + k, direction(w).cross(g), out);
        add_direction(v, pose, point_s, point_u + k, g.cross(direction(d)), out);
      } else {
        const LegEnds ends = leg_ends(k + (which == det_b ? 6 : 3));
        add_direction(v, pose, ends.from, ends.to, g, out);
      }
    }
  }

  /// Adds the derivatives of g . direction(to - from).
  static void add_direction(const DesignState& v, int pose, int from, int to, const Vec3& g, Row out) {
    const Points& at = v.pose(pose).at;
    const Vec3 along = at[at_index(to)] - at[at_index(from)];
    const double length = along.norm();
    if (!(length > 0.0)) return;
    const Vec3 e = along / length, across = (g - g.dot(e) * e) / length;  // a unit vector can only turn
    v.add_point(pose, to, across, out);
    v.add_point(pose, from, -across, out);
  }

  int places_;
};

}  // namespace

std::unique_ptr<Constraint> make_singularity_free(const Limit& limit, int poses, Purpose) {
  return std::make_unique<SingularityFree>(limit, poses);
}

}  // namespace ninedof
