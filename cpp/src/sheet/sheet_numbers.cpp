#include "ninedof/sheet/sheet_numbers.hpp"

#include <algorithm>

#include "limits/table.hpp"
#include "math/numbers.hpp"
#include "ninedof/conditioning/conditioning.hpp"
#include "ninedof/kinematics/velocity.hpp"
#include "ninedof/robot/legs.hpp"

namespace ninedof {
namespace {

/// An angle is worst where it is greatest; a distance, and a determinant on the side of home, where it is least.
WorstEnd worst_end(const std::string& limit) {
  switch (limit_row(limit).info.sides) {
    case LimitSides::only_high: return WorstEnd::greatest;
    case LimitSides::only_low: return WorstEnd::least;
    case LimitSides::both: break;
  }
  return WorstEnd::both;
}

}  // namespace

SheetNumbers::SheetNumbers(const SheetQuestion& question) : question_(question) {
  for (const Limit& limit : question_.limits) {
    limits_.emplace_back(limit.name, question_.geometry, question_.neutral,
                         question_.characteristic_length.value_or(1.0), limit.options(), question_.exempt);
    groups_.push_back({limit.name, limits_.back().items(), worst_end(limit.name)});
  }
  using enum WorstEnd;
  if (question_.motion) {
    groups_.push_back({"speed", 9, greatest});
    groups_.push_back({"acceleration", 9, greatest});
  }
  if (question_.motion && question_.motion->given) {
    groups_.push_back({"twist_speed", 9, both});
    groups_.push_back({"twist_acceleration", 9, both});
  }
  if (!question_.loads.empty()) groups_.push_back({"force", static_cast<int>(9 * question_.loads.size()), both});
  if (question_.motion && !question_.loads.empty()) groups_.push_back({"power", 9, greatest});
  if (question_.payload)
    groups_.push_back({"payload", static_cast<int>(18 * std::max<std::size_t>(question_.loads.size(), 1)), greatest});
  if (question_.errors) groups_.push_back({"error", 3, greatest});
  if (question_.leg_stiffness) groups_.push_back({"stiffness", 2, least});
  if (question_.characteristic_length) groups_.push_back({"condition_number", 1, greatest});
  if (question_.characteristic_length && !question_.locked.empty()) groups_.push_back({"free", 9, both});
  first_locked_ = groups_.size();
  if (question_.characteristic_length) groups_.insert(groups_.end(), question_.locked.size(), {"locked", 1, greatest});
}

std::vector<Load> SheetNumbers::loads_at(const Configuration& c) const {
  Load own = question_.weight ? question_.weight->at(c.rotation) : Load{};
  if (question_.masses) own = own + inertial_load(question_.geometry, {c}, *question_.masses, question_.gravity);
  std::vector<Load> out = question_.loads.empty() ? std::vector<Load>(1) : question_.loads;
  for (Load& load : out) load = load + own;
  return out;
}

void SheetNumbers::evaluate(std::size_t group, const Configuration& c, double* out) const {
  const SheetQuestion& q = question_;
  const Geometry& g = q.geometry;
  const std::string& name = groups_[group].name;
  const auto nine = [&out](const Vec9& numbers) { Eigen::Map<Vec9>{out} = numbers; };
  if (group < limits_.size()) {
    limits_[group].at(c, out);
  } else if (name == "speed") {
    nine(largest_leg_rates(g, c, *q.motion));
  } else if (name == "acceleration") {
    nine(largest_leg_accelerations(g, c, *q.motion));
  } else if (name == "twist_speed") {
    nine(leg_rates(g, c, q.motion->internal, q.motion->given->twist));
  } else if (name == "twist_acceleration") {
    nine(leg_accelerations(g, c, q.motion->internal, *q.motion->given));
  } else if (name == "force") {
    for (const Load& load : loads_at(c)) {
      nine(leg_forces(g, c, load).forces);
      out += 9;
    }
  } else if (name == "power") {
    Vec9 most = Vec9::Zero();
    for (const Load& load : loads_at(c)) most = most.cwiseMax(leg_forces(g, c, load).forces.cwiseAbs());
    nine(most.cwiseProduct(largest_leg_rates(g, c, *q.motion)));
  } else if (name == "payload") {
    for (const Load& load : loads_at(c)) {
      Eigen::Map<Vec18>{out} = payload_shares(g, c, *q.payload, load);
      out += 18;
    }
  } else if (name == "error") {
    const ErrorBounds bounds = error_bounds(g, c, *q.errors);
    std::ranges::copy(std::array{bounds.position, bounds.rotation, bounds.internal_point}, out);
  } else if (name == "stiffness") {
    const LeastStiffness least = least_stiffness(g, c, *q.leg_stiffness);
    out[0] = least.shift;
    out[1] = least.turn;
  } else if (name == "free") {
    const Vec9 sizes = jacobian(g, c, *q.characteristic_length).colwise().norm();
    nine(sizes.hasNaN() ? Vec9::Constant(infinity) : sizes);
  } else if (name == "locked") {
    const PosedPoints here = posed_points(g, c);
    *out = LockedLegs(here.at, here.legs, *q.characteristic_length).condition_number(q.locked[group - first_locked_]);
  } else {
    *out = condition_number(g, c, *q.characteristic_length);
  }
}

}  // namespace ninedof
