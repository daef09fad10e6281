#include <algorithm>

#include "ninedof/optimize.hpp"

namespace ninedof {

void Problem::validate() const {
  const auto& info = design_family(family).variables();
  require_positive("characteristic_length", characteristic_length);
  if (variables.size() != info.size())
    throw InvalidArgument("variables", std::to_string(variables.size()) + " bounds",
                          std::to_string(info.size()) + ", one for each variable of " + family);
  for (std::size_t k = 0; k < info.size(); ++k) {
    const Bounds& b = variables[k];
    const std::string text = format_interval(b.low, b.high);
    if (!(b.low <= b.high)) throw InvalidArgument(info[k].name, text, "low <= high, both numbers");
    if (b.low == b.high) require_finite(info[k].name.c_str(), b.low);
    if (!info[k].is_angle && b.low < 0.0) throw InvalidArgument(info[k].name, text, "a length, low >= 0");
  }
  margins(limits);
  // A design of ordinary size within the bounds must be a robot: says so where both sides of a plate are held at zero.
  std::vector<double> ordinary;
  for (std::size_t k = 0; k < info.size(); ++k)
    ordinary.push_back(std::clamp(info[k].is_angle ? 0.0 : characteristic_length, variables[k].low, variables[k].high));
  design_family(family).geometry(ordinary);
}

void Settings::validate() const {
  if (starts < 1) throw InvalidArgument("starts", std::to_string(starts), "at least 1");
  if (max_evaluations < 1) throw InvalidArgument("max_evaluations", std::to_string(max_evaluations), "at least 1");
}

}  // namespace ninedof
