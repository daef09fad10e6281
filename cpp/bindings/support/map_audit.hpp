#pragma once
/// The audit of a map of internal points as Python's MapAudit takes it.

#include <pybind11/pybind11.h>

#include "ninedof/redundancy/redundancy_map.hpp"

namespace ninedof::python {

inline pybind11::dict audit_dict(const MapAudit& a) {
  pybind11::dict out;
  out["poses"] = a.poses;
  out["missed"] = a.missed;
  out["largest"] = a.largest;
  return out;
}

}  // namespace ninedof::python
