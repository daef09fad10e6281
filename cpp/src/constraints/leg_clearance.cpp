/// leg_clearance: distance of the axes of every two legs that share no joint, at every pose looked at. The internal legs all
/// end in O, so that one of every two is external. Legs share a joint if theirs coincide in every design the study allows;
/// in one design alone, that is a collision.

#include <algorithm>

#include "constraints/constraint.hpp"

namespace ninedof {
namespace {

/// Where two segments come nearest: `s` and `t` of the way along each, and the vector from the second to the first.
struct Nearest {
  double s, t;
  Vec3 apart;
};

/// The square of the distance is convex in (s, t): its least is inside the unit square or on one of four sides.
Nearest nearest(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const Vec3 u = b - a, v = d - c, w = a - c;
  const double uu = u.dot(u), uv = u.dot(v), vv = v.dot(v), uw = u.dot(w), vw = v.dot(w);
  const auto clamp = [](double x) { return std::clamp(x, 0.0, 1.0); };
  const double determinant = uu * vv - uv * uv;
  double s = determinant > 1e-14 * uu * vv ? clamp((uv * vw - vv * uw) / determinant) : 0.0;
  double t = vv > 0.0 ? (uv * s + vw) / vv : 0.0;
  if (t < 0.0 || t > 1.0) {
    t = clamp(t);
    s = uu > 0.0 ? clamp((uv * t - uw) / uu) : 0.0;
  }
  return {s, t, w + s * u - t * v};
}

class LegClearance : public Constraint {
 public:
  LegClearance(const Limit& limit, int poses) : Constraint(limit), poses_(std::max(poses, 1)) {}

  /// Where two segments come nearest changes from design to design.
  bool analytic() const override { return false; }

  void learn(const std::vector<View>& designs) override {
    for (int item = 0; item < pairs; ++item) {
      const auto [a, b] = legs(item);
      share_joint_[static_cast<std::size_t>(item)] =
          std::ranges::all_of(designs, [&](const View& v) { return joints_coincide(v, a, b); });
    }
  }

 private:
  static constexpr int pairs = 21;  // three of external legs, eighteen of an external and an internal one
  Form form() const override { return Form::linear; }
  int items(Side) const override { return pairs * poses_; }
  static std::pair<int, int> legs(int item) {
    const int k = item % pairs;
    if (k < 3) return {k, (k + 1) % 3};
    return {(k - 3) / 6, 3 + (k - 3) % 6};
  }
  static bool joints_coincide(const View& v, int a, int b) {
    const auto same = [&](int i, int j) {
      const Vec3 &x = v.blueprint.joint[static_cast<std::size_t>(i)],
                 &y = v.blueprint.joint[static_cast<std::size_t>(j)];
      return (x - y).squaredNorm() <= 1e-24 * (x.squaredNorm() + y.squaredNorm());
    };
    // Leg a is external, from the base to the platform; an upper leg starts on the platform, all others on the base.
    const LegEnds one = leg_ends(a), two = leg_ends(b);
    return same(two.from < point_u ? one.from : one.to, two.from) || (b < 3 && same(one.to, two.to));
  }
  Nearest look(const View& v, int item) const {
    const auto [a, b] = legs(item);
    const Points& at = v.pose(v.first + item / pairs).at;
    const auto end = [&](int k) -> const Vec3& { return at[static_cast<std::size_t>(k)]; };
    return nearest(end(leg_ends(a).from), end(leg_ends(a).to), end(leg_ends(b).from), end(leg_ends(b).to));
  }
  double value(const View& v, Side, int item) const override {
    if (share_joint_[static_cast<std::size_t>(item % pairs)]) return exempt;
    return look(v, item).apart.norm() / unit(v);
  }
  void add_value_gradient(const View& v, Side, int item, double scale, Row out) const override {
    if (share_joint_[static_cast<std::size_t>(item % pairs)]) return;
    const auto [a, b] = legs(item);
    const Nearest n = look(v, item);
    const double distance = n.apart.norm(), u = unit(v);
    if (!(distance > 0.0)) return;
    const Vec3 g = scale / (distance * u) * n.apart;
    const int pose = v.first + item / pairs;
    v.add_point(pose, leg_ends(a).from, (1.0 - n.s) * g, out);
    v.add_point(pose, leg_ends(a).to, n.s * g, out);
    v.add_point(pose, leg_ends(b).from, -(1.0 - n.t) * g, out);
    v.add_point(pose, leg_ends(b).to, -n.t * g, out);
    add_unit_gradient(v, -scale * distance / (u * u), out);
  }

  static constexpr double exempt = 1e6;
  int poses_;
  std::array<bool, pairs> share_joint_{};
};

}  // namespace

std::unique_ptr<Constraint> make_leg_clearance(const Limit& limit, int poses, Purpose) {
  return std::make_unique<LegClearance>(limit, poses);
}

}  // namespace ninedof
