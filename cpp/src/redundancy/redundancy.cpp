#include "ninedof/redundancy/redundancy.hpp"

#include <cmath>

#include "ninedof/math/error.hpp"
#include "ninedof/math/length_range.hpp"
#include "redundancy/search/pose_search.hpp"

namespace ninedof {
namespace {

const char* leg_names[] = {"l1", "l2", "l3", "q1", "q2", "q3", "r1", "r2", "r3"};
const char* determinant_names[] = {"det B", "det C", "det N"};

void require_limits(bool fine, const LegLimits& l, int k, const char* expected) {
  if (!fine)
    throw InvalidArgument(std::string("limits of ") + leg_names[k], format_interval(l.low[k], l.high[k]), expected);
}

}  // namespace

const char* to_string(InternalPointStatus status) {
  switch (status) {
    case InternalPointStatus::found: return "found";
    case InternalPointStatus::local: return "local";
    case InternalPointStatus::stopped: return "stopped";
    case InternalPointStatus::infeasible: return "infeasible";
    case InternalPointStatus::unbounded: return "unbounded";
    case InternalPointStatus::singular: return "singular";
    case InternalPointStatus::missing: return "missing";
  }
  return "";
}

std::vector<std::string> ActiveBounds::names() const {
  std::vector<std::string> out;
  for (int leg = 0; leg < 9; ++leg) {
    if (has(low(leg))) out.push_back(std::string(leg_names[leg]) + " low");
    if (has(high(leg))) out.push_back(std::string(leg_names[leg]) + " high");
  }
  for (int k = 0; k < 3; ++k)
    if (has(clearance(k))) out.emplace_back(determinant_names[k]);
  return out;
}

void validate(const InternalPointProblem& problem) {
  const LegLimits& l = problem.limits;
  for (int k = 0; k < 9; ++k)
    require_limits(l.low[k] >= 0.0 && std::isfinite(l.low[k]) && l.high[k] > l.low[k], l, k,
                   "0 <= low < high, low finite");
  if (problem.criterion == Criterion::leg_centring)
    for (int k = 3; k < 9; ++k)
      require_limits(std::isfinite(l.high[k]), l, k, "a finite range, since leg_centring is about its middle");
  require_length("characteristic_length", problem.characteristic_length);
  require_positive("clearance", problem.clearance);
}

Vec3 default_internal_point(const Geometry& g, const Vec3& position, const Mat3& rotation) {
  Vec3 lower = Vec3::Zero(), upper = Vec3::Zero();
  for (std::size_t i = 0; i < 3; ++i) {
    lower += g.base_internal()[i] / 3.0;
    upper += g.platform_internal()[i] / 3.0;
  }
  return 0.5 * (lower + position + rotation * upper);
}

InternalPoint best_internal_point(const Geometry& g, const Vec3& position, const Mat3& rotation,
                                  const InternalPointProblem& problem, const std::optional<Vec3>& start) {
  validate(problem);
  return search_pose(g, position, rotation, problem, start).point;
}

}  // namespace ninedof
