#include "ninedof/optimize/result.hpp"

namespace ninedof {

const char* to_string(Status status) {
  switch (status) {
    case Status::optimal: return "optimal";
    case Status::unbounded: return "unbounded";
    case Status::infeasible: return "infeasible";
    case Status::stopped: return "stopped";
  }
  return "stopped";
}

}  // namespace ninedof
