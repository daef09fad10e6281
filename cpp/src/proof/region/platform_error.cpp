/// The error of the platform over all poses. Declared in ninedof/proof/machine.hpp.
///
/// Where the legs have lengths that are off by at most eta, the platform is off by x = H^-1 (eta - rest(x)): the
/// lengths of the drawing's machine are those of its pose, H x, and a rest of second order. An x that this takes into
/// the ball that it is from has a fixed point there (Brouwer): docs/theory/proof-machine.md.

#include <algorithm>
#include <array>
#include <cmath>

#include "limits/box_system.hpp"
#include "limits/duty_over_box.hpp"
#include "math/numbers.hpp"
#include "proof/region/worst.hpp"
#include "proof/region/worst_machine.hpp"
#include "robot/joint_cones.hpp"
#include "statics/corners.hpp"

namespace ninedof {
namespace over_region {
namespace {

constexpr double widest_gap = 0.5;

/// Of rotation, p and O.
using Errors = std::array<double, 3>;

/// The greatest part that the errors of a pose have in given ones.
class ErrorShare final : public IndexOverPoses {
 public:
  ErrorShare(const Domain& domain, const Errors& of)
      : IndexOverPoses(domain),
        of_(of),
        home_(domain.machine().geometry, domain.machine().neutral,
              LimitOptions(Vec3::Zero(), std::make_shared<Duty>())) {
    for (int leg = 0; leg < 9; ++leg) reading_[leg] = reading_error(domain.machine().tolerances, leg);
    for (const Vec3& u : domain.machine().geometry.platform_external()) length_ = std::max(length_, u.norm());
  }

  /// To first order, of the machine of the drawing.
  double at(const Geometry& g, const Box& point) const override {
    const Mat9 map = error_map(g, domain().configuration(point));
    if (!map.allFinite()) return infinity;
    double out = 0.0;
    for (std::size_t k = 0; k < of_.size(); ++k)
      if (of_[k] < infinity)
        out = std::max(
            out, farthest_corner(map.middleRows<3>(3 * static_cast<Eigen::Index>(k)) * reading_.asDiagonal()) / of_[k]);
    return out;
  }
  bool bounded(const Box& box, double bound, Moves& moves) const override {
    const FormPose pose = domain().pose(box);
    const AsBuilt drawn{domain().machine().geometry};
    const FormLook look(drawn, pose, home_);
    const KnownForms<FormLook> known(look);
    Errors most;
    for (std::size_t k = 0; k < most.size(); ++k) most[k] = bound * of_[k];
    Nine<Nine<PoseForm>> h;
    std::array<double, 9> off{};
    for (int leg = 0; leg < 9; ++leg) {
      h[at_index(leg)] = row_of(unit_force(known, leg), 1.0 / length_);
      const Ends<PoseForm> ends = look.ends(leg);
      const FormVector v = ends.to - ends.from;
      off[at_index(leg)] = reading_[leg] + rest(leg, most, lower(sqrt(dot(v, v))));
    }
    const BoxSystem system(h);
    moves.along = system.moves();
    for (int leg = 0; leg < 9; ++leg)
      moves.add(known.direction(leg), 1e-9);  // where a leg may vanish nothing else is known
    const Nine<Nine<PoseForm>> map = system.inverse();  // a turn is taken times `length_`
    most[0] *= length_ * (1.0 - 0x1p-50);
    for (std::size_t k = 0; k < most.size(); ++k)
      if (!within(map, off, 3 * k, most[k])) return false;
    return true;
  }

 private:
  /// At most what the length of a leg differs by from what is linear in (rotation vector, p, s), for errors up to
  /// these.
  double rest(int leg, const Errors& most, double length) const {
    const int joint = joint_at(true, leg);
    const double arm = joint == point_s ? 0.0 : joint_of(domain().machine().geometry, joint).norm();
    double away = (leg < 6 ? most[1] + arm * most[0] : 0.0) + (leg >= 3 ? most[2] : 0.0);
    away *= 1.0 + 0x1p-40;
    if (!(length > away)) return infinity;
    return (0.5 * arm * most[0] * most[0] + 0.5 * away * away / (length - away)) * (1.0 + 0x1p-40);
  }
  /// Whether three rows of the map take all errors of the legs to vectors of at most this length, everywhere in the
  /// box.
  bool within(const Nine<Nine<PoseForm>>& map, const std::array<double, 9>& off, std::size_t first, double most) const {
    std::array<Nine<PoseForm>, 3> rows;
    Columns9 middle;
    Vec3 open = Vec3::Zero();
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t leg = 0; leg < 9; ++leg) {
        const PoseForm& f = rows[i][leg] = off[leg] * map[first + i][leg];
        open[static_cast<Eigen::Index>(i)] += radius(f);
        middle(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(leg)) = f.c;
      }
    if (!(open.norm() < most)) return false;  // infinite and NaN too
    const double room = most - (1.0 + 0x1p-40) * open.norm() - 0x1p-40 * middle.lpNorm<1>();
    return at_all_corners(middle, [&](const Vec9& signs, const Vec3& sum) {
      if (sum.norm() <= room) return true;
      FormVector v;
      for (std::size_t leg = 0; leg < 9; ++leg) {
        const double sign = signs[static_cast<Eigen::Index>(leg)];
        v = v + FormVector{sign * rows[0][leg], sign * rows[1][leg], sign * rows[2][leg]};
      }
      return upper(dot(v, v)) <= most * most * (1.0 - 0x1p-50);
    });
  }

  Errors of_;
  FormHome home_;
  Vec9 reading_;
  double length_ = 0.0;
};

}  // namespace
}  // namespace over_region

ErrorOverPoses error_over_poses(const PosedRobot& machine, const ProofSettings& settings, const Control& control) {
  using namespace over_region;
  if (machine.region.empty() && machine.poses.empty()) {
    PosedRobot at_neutral = machine;
    at_neutral.poses.push_back(machine.neutral);
    return error_over_poses(at_neutral, settings, control);
  }
  const Domain domain(machine);
  Errors met;
  Met at;
  for (std::size_t k = 0; k < met.size(); ++k) {
    Errors of{infinity, infinity, infinity};
    of[k] = 1.0;
    const ErrorShare index(domain, of);
    at = searched(index, settings.threads, control.stop, true);
    const ErrorBounds e = error_bounds(machine.geometry, domain.configuration(at.at), machine.tolerances);
    met[k] = std::max({at.value, k == 0 ? e.rotation : k == 1 ? e.position : e.internal_point, forms::tiny});
  }
  const double most = std::ranges::max(met);
  if (!(most > forms::tiny)) return {0.0, 0.0, 0.0};
  double share = infinity;
  long boxes = 0;
  // What is not moved at all, as O by errors of external joints, still has a bound.
  double arm = 0.0;
  for (const Vec3& u : machine.geometry.platform_external()) arm = std::max(arm, u.norm());
  const double least = 1e-6 * std::max({arm * met[0], met[1], met[2]});
  const Errors of{std::max(met[0], least / arm), std::max(met[1], least), std::max(met[2], least)};
  const ErrorShare index(domain, of);
  ProofSettings how = settings;
  how.gap = std::clamp(settings.gap, 1e-3, widest_gap);
  how.condition = 0.0;
  Moves unused;
  // The rest of second order grows with the bound: one that does not hold at a pose never will, a wider one may.
  const auto hopeless = [&] { return !index.bounded(at.at, 1.0 + how.gap, unused); };
  while (hopeless() && how.gap < widest_gap) how.gap = std::min(1.5 * how.gap, widest_gap);
  if (std::isfinite(most) && !hopeless()) {
    const WorstOverPoses found = worst(index, {1.0, at.at}, how, all_boxes(domain), control);
    share = found.extreme.high;
    boxes = found.extreme.boxes;
  }
  const auto enclosed = [&](std::size_t k, double by) {
    return Interval(met[k], std::isfinite(by) ? detail::above(by * of[k]) : infinity);
  };
  return {enclosed(1, share), enclosed(0, share), enclosed(2, share), boxes};
}

}  // namespace ninedof
