/// force, rate, power: of every leg, the greatest modulus of its force under the loads and weights of a machine at rest,
/// its greatest rate over all directions of both speeds of the platform, and their product. Slopes are those of the
/// power in a motion that is held: see docs/theory/statics.md. Declared in limits/pose_row.hpp.

#include "limits/leg_duty.hpp"

#include <cmath>
#include <numeric>
#include <optional>

#include "limits/box_system.hpp"
#include "limits/pose_row.hpp"
#include "math/linear/least_squares.hpp"
#include "math/numbers.hpp"
#include "statics/balance.hpp"

namespace ninedof {
namespace {

/// As statics.cpp: where a pivot is smaller, slopes say nothing.
constexpr double surely_regular = 1e-9;

Vec3 vector(const Xyz<double>& v) {
  return {v.x, v.y, v.z};
}

constexpr std::array<int, point_count> every_point = [] {
  std::array<int, point_count> out{};
  std::iota(out.begin(), out.end(), 0);
  return out;
}();
/// Duals by every point of the pose.
struct DutyDuals : DualLook<point_count, false> {
  explicit DutyDuals(const PointLook& look) : DualLook(look, every_point), look_(look) {}
  const Duty& duty() const { return look_.duty(); }

 private:
  const PointLook& look_;
};
using PointDual = DutyDuals::Number;

/// A derivative by the points and by a turn of the platform beyond theirs.
struct Slope {
  PointDual points = 0.0;
  Vec3 turn = Vec3::Zero();
};

template <class Look>
auto centre_of_mass(const Look& look) {
  const Vec3& c = look.duty().masses.centre;
  const auto& q = look.q();
  return c.x() * q[0] + c.y() * q[1] + c.z() * q[2];
}

/// A machine at a pose in doubles.
class AtPose {
 public:
  explicit AtPose(const PointLook& look) : look_(look), duty_(look.duty()) {
    for (int k = point_u; k < point_p; ++k) length_ = std::max(length_, arm(k).norm());
    if (!(length_ > 0.0)) length_ = 1.0;
    for (int leg = 0; leg < 9; ++leg) {
      unit_[at_index(leg)] = unit_force(look, leg);
      const Wrench<double>& w = unit_[at_index(leg)];
      h_.row(leg) << vector(w.moment).transpose() / length_, vector(w.force).transpose(), vector(w.at_o).transpose();
    }
  }

  /// The greatest modulus; infinite where the load is not balanced. Keeps the load for `force_slope`.
  double force(int leg) {
    const Wrench<double> own = weights(look_, centre_of_mass(look_));
    double most = -1.0;
    for (const Load& load : duty_.loads) {
      const LegForces found = leg_forces(
          h_, length_,
          {load.moment + vector(own.moment), load.force + vector(own.force), load.force_at_o + vector(own.at_o)});
      const double size = std::abs(found.forces[leg]);
      if (!found.balanced() || std::isnan(size)) return infinity;
      if (size <= most) continue;
      most = size;
      forces_ = found.forces;
    }
    return most;
  }
  /// With the motion that moves this leg alone, at unit rate, and the leg forces f held, its force has the slopes of
  /// less the power of all forces, which is 0 here: d f_k = -d(motion.(load + H^T f)).
  Slope force_slope(int leg) const {
    Slope out;
    const std::optional<Vec9> scaled = solve_regular(h_, Vec9::Unit(leg), surely_regular);
    if (!scaled) return out;
    Vec9 motion = *scaled;
    motion.head<3>() /= length_;
    const DutyDuals duals(look_);
    const Vec3 c = vector(centre_of_mass(look_));
    Wrench<PointDual> all = weights(duals, constant<PointDual>(c));
    for (int k = 0; k < 9; ++k) all = all + forces_[k] * unit_force(duals, k);
    const double sign = forces_[leg] < 0.0 ? 1.0 : -1.0;
    out.points = sign * power_of(all, motion);
    const Vec3 omega = motion.head<3>();
    out.turn = sign * c.cross((duty_.masses.platform * duty_.gravity).cross(omega));
    return out;
  }

  /// Keeps its direction for `rate_slope`.
  double rate(int leg) {
    const PlatformMotion& m = duty_.motion;
    if (settles(leg)) {
      for (Eigen::Index k = 0; k < 6; ++k) k_.row(k) = h_.row(k + 3).tail<3>();
      for (Eigen::Index j = 0; j < 6; ++j) {
        const Vec6 y = scale(j) * h_.block<6, 1>(3, j);
        settled_.col(j) = least_norm(k_, Vec6(-y));
        const double left = y[leg - 3] + k_.row(leg - 3).dot(settled_.col(j));
        (j < 3 ? b_[j] : a_[j - 3]) = left;
      }
    } else {
      const RateOf<double> found = rate_by_rule(unit_[at_index(leg)], m.internal, PointLook::xyz(arm(point_s)));
      a_ = vector(found.a);
      b_ = vector(found.b);
    }
    return m.linear_speed * a_.norm() + m.angular_speed * b_.norm();
  }
  /// Of the rate for the twist that is worst here.
  Slope rate_slope(int leg) const {
    const DutyDuals duals(look_);
    const PlatformMotion& m = duty_.motion;
    Vec9 motion = Vec9::Zero();
    motion.head<3>() = m.angular_speed * b_.stableNormalized();
    motion.segment<3>(3) = m.linear_speed * a_.stableNormalized();
    Slope out;
    if (!settles(leg)) {
      const RateOf<PointDual> found =
          rate_by_rule(unit_force(duals, leg), m.internal, duals.at(point_s) - duals.at(point_p));
      out.points = along(Vec3(motion.head<3>()), found.b) + along(Vec3(motion.segment<3>(3)), found.a);
      return out;
    }
    // Rates r = K sdot + y of the internal legs, K^T r = 0: with x of least squares K x = e_k and rho = e_k - K x
    //     d r_k = rho.(dK sdot + dy) - x.dK^T r.
    const Vec6 twist = motion.head<6>();
    motion.tail<3>() = settled_ * twist;
    const Vec3 x = least_norm(k_, Vec6::Unit(leg - 3));
    const Vec6 rho = Vec6::Unit(leg - 3) - k_ * x;
    for (int k = 3; k < 9; ++k) {
      const Wrench<PointDual> w = unit_force(duals, k);
      const PointDual rate = power_of(w, motion);
      out.points = out.points + rho[k - 3] * rate - rate.value * along(x, w.at_o);
    }
    return out;
  }

 private:
  bool settles(int leg) const { return leg >= 3 && duty_.motion.internal == InternalMotion::least; }
  Vec3 arm(int point) const { return vector(look_.at(point) - look_.at(point_p)); }
  double scale(Eigen::Index column) const { return column < 3 ? length_ : 1.0; }

  const PointLook& look_;
  const Duty& duty_;
  double length_ = 0.0;  ///< of columns of turns in h
  std::array<Wrench<double>, 9> unit_;
  Mat9 h_;
  Vec9 forces_ = Vec9::Zero();
  Vec3 a_ = Vec3::Zero(), b_ = Vec3::Zero();
  Eigen::Matrix<double, 6, 3> k_;
  Eigen::Matrix<double, 3, 6> settled_;  ///< sdot for each unit twist
};

/// A machine over a box of poses.
class OverBox {
 public:
  explicit OverBox(const FormLook& look) : look_(look), duty_(look.duty()) {}

  PoseForm force(int leg) const {
    double length = 0.0;
    for (int k = point_u; k < point_p; ++k) length = std::max(length, centre(look_.at(k) - look_.at(point_p)).norm());
    const double per_length = length > 0.0 ? 1.0 / length : 1.0;
    const auto row = [per_length](const Wrench<PoseForm>& w) {
      const FormVector m = per_length * w.moment;
      return NineForms{m.x, m.y, m.z, w.force.x, w.force.y, w.force.z, w.at_o.x, w.at_o.y, w.at_o.z};
    };
    std::array<NineForms, 9> h;
    for (int k = 0; k < 9; ++k) h[at_index(k)] = row(unit_force(look_, k));
    const BoxSystem system(h);
    const Wrench<PoseForm> own = weights(look_, centre_of_mass(look_));
    std::optional<PoseForm> most;
    for (const Load& load : duty_.loads) {
      const Wrench<PoseForm> given{constant<PoseForm>(load.moment), constant<PoseForm>(load.force),
                                   constant<PoseForm>(load.force_at_o)};
      const PoseForm f = system.component(leg, row(-1.0 * (given + own))), size = greater(f, -f);
      most = most ? greater(*most, size) : size;
    }
    return *most;
  }

  PoseForm rate(int leg) const {
    const PlatformMotion& m = duty_.motion;
    const auto [a, b] = m.internal == InternalMotion::least && leg >= 3
                            ? settled(leg)
                            : rate_by_rule(unit_force(look_, leg), m.internal, look_.at(point_s) - look_.at(point_p));
    PoseForm out;
    if (m.linear_speed > 0.0) out = out + m.linear_speed * norm(a);
    if (m.angular_speed > 0.0) out = out + m.angular_speed * norm(b);
    return out;
  }

 private:
  /// The greater of two forms, at every pose: the one that is so in the middle and what the other may be above it.
  static PoseForm greater(const PoseForm& x, const PoseForm& y) {
    if (y.c > x.c) return greater(y, x);
    const double above = upper(y - x);
    return above > 0.0 ? x + PoseForm::of({0.0, above}) : x;
  }
  static PoseForm norm(const FormVector& v) {
    const PoseForm square = dot(v, v);
    if (lower(square) > 0.0) return square * inverse_root(square);
    return PoseForm::of({0.0, detail::above(std::sqrt(upper(square)))});
  }
  /// Rates r of internal legs and sdot that makes their squares least, for each unit twist: r - K sdot = y, K^T r = 0.
  RateOf<PoseForm> settled(int leg) const {
    std::array<Wrench<PoseForm>, 6> unit;
    std::array<NineForms, 9> h;
    for (std::size_t k = 0; k < 6; ++k) {
      unit[k] = unit_force(look_, static_cast<int>(k) + 3);
      const FormVector& row = unit[k].at_o;
      const std::array<const PoseForm*, 3> of_row{&row.x, &row.y, &row.z};
      h[k][k] = 1.0;
      for (std::size_t j = 0; j < 3; ++j) {
        h[k][j + 6] = *of_row[j];
        h[j + 6][k] = -*of_row[j];
      }
    }
    const BoxSystem system(h);
    const auto rates = [&](const FormVector Wrench<PoseForm>::* part) {
      const auto along_one = [&](PoseForm FormVector::* coordinate) {
        NineForms y;
        for (std::size_t k = 0; k < 6; ++k) y[k] = unit[k].*part.*coordinate;
        return system.component(leg - 3, y);
      };
      return FormVector{along_one(&FormVector::x), along_one(&FormVector::y), along_one(&FormVector::z)};
    };
    return {rates(&Wrench<PoseForm>::force), rates(&Wrench<PoseForm>::moment)};
  }

  const FormLook& look_;
  const Duty& duty_;
};

/// The force, the rate, or with both their product.
template <bool of_force, bool of_rate>
struct LegDuty {
  static constexpr int items = 9;
  static constexpr bool falls = false;
  static constexpr double width = 5e-3;

  static std::string part(int item) { return leg_name(item); }
  static double number(const PointLook& look, int item) {
    AtPose here(look);
    return (of_force ? here.force(item) : 1.0) * (of_rate ? here.rate(item) : 1.0);
  }
  static double slopes(const PointLook& look, int item, PointSlopes& out) {
    AtPose here(look);
    const double force = of_force ? here.force(item) : 1.0, rate = of_rate ? here.rate(item) : 1.0;
    out.points = out.home_points = 0;
    out.turns = false;
    out.length = 0.0;
    const double value = force * rate;
    if (!std::isfinite(value)) return value;
    Slope all;
    const auto add = [&all](double by, const Slope& one) {
      all.points = all.points + by * one.points;
      all.turn += by * one.turn;
    };
    if (of_force) add(rate, here.force_slope(item));
    if (of_rate) add(force, here.rate_slope(item));
    for (int point = 0; point < point_count; ++point) {
      const auto k = at_index(3 * point);
      const auto& g = all.points.gradient;
      out.at[at_index(out.points++)] = {point, {g[k], g[k + 1], g[k + 2]}};
    }
    out.turns = true;
    out.turn = all.turn;
    out.home_turn.setZero();
    return value;
  }
  static PoseForm u(const FormLook& look, int item) {
    const OverBox box(look);
    if constexpr (!of_rate) return box.force(item);
    else if constexpr (!of_force) return box.rate(item);
    else return box.force(item) * box.rate(item);
  }
  static Interval read(const Interval& number) { return number; }
  static Interval smooth(const Interval& number) { return number; }
  static void moves(const FormLook& look, int, Moves& out) {
    for (int leg = 0; leg < 9; ++leg) {
      const FormEnds ends = look.ends(leg);
      const FormVector v = ends.to - ends.from;
      out.add(v, 1.0 / std::max(centre(v).norm(), 1e-300));
    }
  }
};

}  // namespace

constinit const PoseRow force_row = pose_row_of<LegDuty<true, false>>();
constinit const PoseRow rate_row = pose_row_of<LegDuty<false, true>>();
constinit const PoseRow power_row = pose_row_of<LegDuty<true, true>>();

}  // namespace ninedof
