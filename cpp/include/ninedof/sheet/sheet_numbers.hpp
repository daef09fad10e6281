#pragma once
/// The numbers of a pose that a workshop and an engineer need: lengths, speeds and forces of the legs, angles at their
/// joints, distances, determinants, accuracy and stiffness.

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "ninedof/conditioning/locked_legs.hpp"
#include "ninedof/dynamics/payload.hpp"
#include "ninedof/kinematics/leg_motion.hpp"
#include "ninedof/limits/numbers.hpp"
#include "ninedof/statics/accuracy.hpp"
#include "ninedof/statics/statics.hpp"

namespace ninedof {

/// A machine, and what its sheet is asked for.
struct SheetQuestion {
  Geometry geometry;
  Configuration neutral;
  std::vector<Limit> limits = {};  ///< those at poses whose numbers are asked for
  std::array<bool, 21> exempt{};  ///< pairs of legs that may meet
  std::optional<PlatformMotion> motion = {};
  std::vector<Load> loads = {};  ///< the weight is added to each
  std::optional<Weight> weight = {};
  std::optional<Masses> masses = {};  ///< their weights are added too
  Vec3 gravity = Vec3::Zero();        ///< of `masses`
  std::optional<PayloadLimits> payload = {};
  std::optional<Tolerances> errors = {};
  std::optional<Vec9> leg_stiffness = {};
  std::optional<double> characteristic_length = {};  ///< none: no condition number
  std::vector<LegSet> locked = {};                   ///< legs whose failure is looked at
};

/// Which end of a number is the worst over poses.
enum class WorstEnd { least, greatest, both };

/// Numbers that are computed together.
struct SheetGroup {
  std::string name;
  int size;
  WorstEnd worst;
};

class SheetNumbers {
 public:
  explicit SheetNumbers(const SheetQuestion& question);

  /// Each limit; "speed" and "acceleration" (9) of the motion; "twist_speed" and "twist_acceleration" (9) of its given
  /// one; "force" (9 a load); "power" (9, the most of |force| x speed); "payload" (18 a load, payload_shares); "error"
  /// (position, rotation, internal point); "stiffness" (LeastStiffness); "condition_number"; with legs locked "free"
  /// (9), the sizes of the columns of J', and "locked" (1) for each set, that of the motions left. Those that were not
  /// asked for are left out.
  const std::vector<SheetGroup>& groups() const { return groups_; }
  /// `out` has room for the numbers of the group. Pairs of legs that may meet have an infinite distance.
  void evaluate(std::size_t group, const Configuration& c, double* out) const;

 private:
  /// Each with all weights; one where none was given.
  std::vector<Load> loads_at(const Configuration& c) const;

  SheetQuestion question_;
  std::vector<LimitNumbers> limits_;
  std::vector<SheetGroup> groups_;
  std::size_t first_locked_ = 0;
};

}  // namespace ninedof
