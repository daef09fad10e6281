#include <Eigen/LU>

#include "ninedof/position/certified_modes.hpp"
#include "ninedof/position/forward_position.hpp"
#include "ninedof/position/tracking.hpp"
#include "ninedof/robot/legs.hpp"
#include "support/baseline.hpp"
#include "support/baseline_motion.hpp"
#include "support/over_poses.hpp"

namespace bench {
namespace {

using ninedof::AssemblyModes;
using ninedof::Configuration;
using ninedof::Geometry;
using ninedof::RotationMethod;
using ninedof::Vec3;
using ninedof::Vec9;

/// A robot, planar or not, with a random pose of the platform, and its leg lengths.
struct Lengths {
  Geometry geometry;
  Configuration configuration;
  Vec9 lengths;
};

using Data = std::shared_ptr<const std::vector<Lengths>>;

Data random_lengths(bool hexagonal) {
  Random random(hexagonal ? 4 : 5);
  std::vector<Lengths> out;
  while (out.size() < blocks * block_size) {
    const Geometry g = random_geometry(random, hexagonal);
    const Configuration c = any_configuration(random);
    out.push_back({g, c, ninedof::leg_lengths(g, c)});
  }
  return std::make_shared<const std::vector<Lengths>>(std::move(out));
}

bool has(const AssemblyModes& modes, const Configuration& c) {
  return std::any_of(modes.begin(), modes.end(), [&](const ninedof::AssemblyMode& m) {
    return (m.configuration.position - c.position).norm() + (m.configuration.rotation - c.rotation).norm() < 1e-6;
  });
}

Figure all_modes(bool hexagonal, double target) {
  const Data data = random_lengths(hexagonal);
  const auto ours = [](const Lengths& x) { return ninedof::forward_position(x.geometry, x.lengths).count; };
  const auto null_space = [](const Lengths& x) {
    return ninedof::forward_position(x.geometry, x.lengths, RotationMethod::null_space).count;
  };
  for (const Lengths& x : *data) {
    const AssemblyModes a = ninedof::forward_position(x.geometry, x.lengths),
                        b = ninedof::forward_position(x.geometry, x.lengths, RotationMethod::null_space);
    require(has(a, x.configuration) && has(b, x.configuration), "all modes: the generating one is missing");
    require(!a.certain || !b.certain || a.count == b.count, "all modes: the two methods count differently");
  }
  Figure f{hexagonal ? "all assembly modes, hexagonal" : "all assembly modes, non-planar",
           "the null-space method alone",
           blocks,
           block_size,
           each_in_block(data, ours),
           each_in_block(data, null_space),
           {hexagonal ? "8 us" : "16 us", [target](const Times& t) { return t.ours_median <= target; }}};
  f.most_rounds = 5;
  return f;
}

/// With the proof that there is no other.
Figure certified_modes(bool hexagonal) {
  const Data data = random_lengths(hexagonal);
  for (std::size_t k = 0; k < block_size; ++k) {
    const Lengths& x = (*data)[k];
    const ninedof::CertifiedModes a = ninedof::certified_modes(x.geometry, x.lengths);
    const AssemblyModes b = ninedof::forward_position(x.geometry, x.lengths);
    require(!a.complete() || !b.certain || a.proved == b.count, "certified modes: another number without the proof");
  }
  const auto ours = [](const Lengths& x) { return ninedof::certified_modes(x.geometry, x.lengths).proved; };
  const auto quick = [](const Lengths& x) { return ninedof::forward_position(x.geometry, x.lengths).count; };
  return {hexagonal ? "all assembly modes with proof, hexagonal" : "all assembly modes with proof, non-planar",
          "the modes without proof",
          2,
          block_size,
          each_in_block(data, ours),
          each_in_block(data, quick),
          {"1 ms", [](const Times& t) { return t.ours_median <= 1e6; }},
          true,
          5};
}

/// The usual method: Newton's method on all nine coordinates.
Configuration plain_newton(const Geometry& g, const Vec9& lengths, Configuration c) {
  for (int k = 0; k < 20; ++k) {
    const Vec9 error = lengths - plain::leg_lengths(g, c);
    if (error.cwiseAbs().maxCoeff() < 1e-13) break;
    c = ninedof::plus(c, plain::NineFactors(plain::Legs(g, c)).solve(error));
  }
  return c;
}

/// A robot and a short step: some millimetres on a machine of two metres.
struct ShortStep {
  ninedof::Tracker tracker;
  Geometry geometry;
  Configuration from;
  Vec9 lengths;
};

Figure tracking() {
  Random random(6);
  std::vector<ShortStep> steps;
  while (steps.size() < blocks * block_size) {
    const Geometry g = random_geometry(random, steps.size() % 2 == 0);
    const Configuration from = near_home(random);
    Vec9 move;
    move << random.point(0.002), random.point(0.002), random.point(0.002);
    const Configuration to = ninedof::plus(from, move);
    const Vec9 lengths = ninedof::leg_lengths(g, to);
    // Close to a singularity the step is divided, which is not typical of a controller: such cases are skipped.
    const ninedof::Tracked t = ninedof::track(g, lengths, from);
    if (t.status != ninedof::TrackStatus::tracked || t.steps > 1) continue;
    require_close("tracking", (t.configuration.position - to.position).norm(), 0.0, 1e-6);
    require_close("plain Newton", (plain_newton(g, lengths, from).position - to.position).norm(), 0.0, 1e-6);
    steps.push_back({ninedof::Tracker(g), g, from, lengths});
  }
  const auto data = std::make_shared<const std::vector<ShortStep>>(std::move(steps));
  return {
      "tracking, a step with its certificate",
      "plain Eigen: Newton with 9x9 LU, no certificate",
      blocks,
      block_size,
      each_in_block(data, [](const ShortStep& s) { return s.tracker(s.lengths, s.from).certificate; }),
      each_in_block(data, [](const ShortStep& s) { return plain_newton(s.geometry, s.lengths, s.from).position.z(); }),
      {"800 ns", [](const Times& t) { return t.ours_median <= 800.0; }}};
}

}  // namespace

Figures position() {
  return {{all_modes(true, 8e3), all_modes(false, 16e3), certified_modes(true), certified_modes(false), tracking()},
          {}};
}

}  // namespace bench
