/// Lengths of a pose, and lengths of nothing: what direct position analysis accepts has these lengths, and a regular
/// pose is among its modes.

#include <algorithm>

#include "ninedof/conditioning/conditioning.hpp"
#include "ninedof/position/certified_modes.hpp"
#include "ninedof/position/forward_position.hpp"
#include "ninedof/position/tracking.hpp"
#include "ninedof/robot/legs.hpp"
#include "support/bytes.hpp"

using namespace fuzz;

namespace {

double largest_coordinate(const Geometry& g) {
  double most = 0.0;
  for (const Triple* t : {&g.base_external(), &g.base_internal(), &g.platform_external(), &g.platform_internal()})
    for (const Vec3& joint : *t) most = std::max(most, joint.cwiseAbs().maxCoeff());
  return most;
}

/// The equations hold squares: of a short leg they see little.
double misfit(const Geometry& g, const Configuration& c, const Vec9& wanted, double unit) {
  const Vec9 got = leg_lengths(g, c) / unit, lengths = wanted / unit;
  return (got - lengths).cwiseProduct(got + lengths).cwiseAbs().maxCoeff();
}

AssemblyModes modes_of(const Geometry& g, const Vec9& lengths, RotationMethod method, double unit) {
  const AssemblyModes out = forward_position(g, lengths, method);
  EXPECT(out.count >= 0 && out.count <= 32);
  const bool listed = out.status == PositionStatus::found || out.status == PositionStatus::tangent;
  EXPECT(listed == (out.count > 0));
  EXPECT((out.status == PositionStatus::infeasible) == (out.obstacle != PositionObstacle::none));
  for (const AssemblyMode& mode : out) {
    validate(mode.configuration);
    EXPECT(mode.separation >= 0.0 && mode.separation <= 1.7321);
    // Where two modes meet, half the digits, and fewer of a thin plate: O is put into its plane.
    EXPECT(misfit(g, mode.configuration, lengths, unit) <= (out.status == PositionStatus::found ? 1e-9 : 1e-4));
  }
  return out;
}

double distance(const Configuration& a, const Configuration& b, double unit) {
  return std::max({(a.rotation - b.rotation).norm(), (a.position - b.position).norm() / unit,
                   (a.internal_point - b.internal_point).norm() / unit});
}

bool among(const AssemblyModes& modes, const Configuration& c, double unit) {
  return std::any_of(modes.begin(), modes.end(),
                     [&](const AssemblyMode& m) { return distance(m.configuration, c, unit) < 1e-5; });
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Bytes in(data, size);
  const std::uint8_t choice = in.byte();
  const std::optional<Robot> r = robot(in, -300, 300);
  if (!r) return 0;
  Vec9 lengths = leg_lengths(r->geometry, r->pose);
  const bool changed = (choice & 1U) != 0U;
  if (changed)
    for (double& length : lengths) length *= std::abs(1.0 + in.near_coarse() / 16.0);
  if (!(lengths.maxCoeff() > 0.0)) return 0;
  const double unit = std::max(lengths.maxCoeff(), largest_coordinate(r->geometry));
  const auto method = static_cast<RotationMethod>(choice / 2U % 3U);
  const AssemblyModes modes = modes_of(r->geometry, lengths, method, unit);
  if (choice / 8U % 8U == 0U) {  // takes long where it ends undecided
    // A proof never contradicts a number that is sure.
    const CertifiedModes proof = certified_modes(r->geometry, lengths);
    if (proof.complete()) EXPECT(proof.proved == proof.modes.count && (!modes.certain || modes.count == proof.proved));
  }
  if (changed) return 0;

  const bool regular = condition_number(r->geometry, r->pose, unit) < 1e4;
  if (regular && modes.status != PositionStatus::self_motion && (modes.certain || method == RotationMethod::automatic))
    EXPECT(among(modes, r->pose, unit));
  // Certain that there is none, where there is one.
  if (modes.count == 0 && modes.status == PositionStatus::infeasible) EXPECT(!modes.certain);

  // Where rounding of the lengths moves the pose further than that, the mode tracked may be as far away; of a leg of
  // almost no length the tracker cannot tell where it goes.
  const Tracked tracked = track(r->geometry, lengths, r->pose);
  if (regular && lengths.minCoeff() > 1e-2 * unit) {
    EXPECT(tracked.status == TrackStatus::tracked);
    EXPECT(distance(tracked.configuration, r->pose, unit) < 1e-5);
  }
  return 0;
}
