#pragma once
/// Bad input throws InvalidArgument. An answer that mathematics may refuse comes back as a status of the result.

#include <stdexcept>
#include <string>

namespace ninedof {

/// Thrown for invalid input. The message names the argument, the value received and the value expected.
class InvalidArgument : public std::invalid_argument {
 public:
  InvalidArgument(const std::string& argument, const std::string& got, const std::string& expected);
};

/// The shortest decimal that reads back as the same double.
std::string format_number(double value);

/// "[low, high]" in such decimals.
std::string format_interval(double low, double high);

/// Throws InvalidArgument unless `value` is finite and greater than zero.
void require_positive(const char* argument, double value);

/// Throws InvalidArgument unless `value` is finite.
void require_finite(const char* argument, double value);

}  // namespace ninedof
