#pragma once
/// One characteristic length for all configurations of a stack, or one for each.

#include "ninedof/math/length_range.hpp"
#include "support/configurations.hpp"

namespace ninedof::python {

class Lengths {
 public:
  Lengths(Array values, long count)
      : values_(std::move(values)), data_(values_.data()), step_(values_.size() == 1 ? 0 : 1) {
    if (values_.size() != 1 && values_.size() != count)
      throw InvalidArgument("characteristic_length", std::to_string(values_.size()) + " values",
                            "one, or one for each of the " + std::to_string(count) + " configurations");
    for (py::ssize_t i = 0; i < values_.size(); ++i) require_length("characteristic_length", data_[i]);
  }
  double operator[](long i) const { return data_[i * step_]; }
  batch::Lengths from(long first) const { return {data_ + first * step_, step_}; }

 private:
  Array values_;
  const double* data_;
  long step_;
};

}  // namespace ninedof::python
