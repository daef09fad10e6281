#include "ninedof/position/assembly_modes.hpp"

namespace ninedof {

const char* to_string(PositionStatus status) {
  switch (status) {
    case PositionStatus::found: return "found";
    case PositionStatus::tangent: return "tangent";
    case PositionStatus::infeasible: return "infeasible";
    case PositionStatus::self_motion: return "self_motion";
  }
  return "";
}

const char* to_string(PositionObstacle obstacle) {
  switch (obstacle) {
    case PositionObstacle::none: return "none";
    case PositionObstacle::lower_legs: return "lower_legs";
    case PositionObstacle::upper_legs: return "upper_legs";
    case PositionObstacle::external_leg_1: return "external_leg_1";
    case PositionObstacle::external_leg_2: return "external_leg_2";
    case PositionObstacle::external_leg_3: return "external_leg_3";
    case PositionObstacle::external_legs: return "external_legs";
  }
  return "";
}

}  // namespace ninedof
