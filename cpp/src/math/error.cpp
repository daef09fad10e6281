#include "ninedof/math/error.hpp"

#include <array>
#include <charconv>
#include <cmath>

namespace ninedof {

InvalidArgument::InvalidArgument(const std::string& argument, const std::string& got, const std::string& expected)
    : std::invalid_argument(argument + ": got " + got + ", expected " + expected) {}

std::string format_number(double value) {
  std::array<char, 32> text{};
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value).ptr;
  return {text.data(), end};
}

std::string format_interval(double low, double high) {
  return std::string("[").append(format_number(low)).append(", ").append(format_number(high)).append("]");
}

void require_finite(const char* argument, double value) {
  if (!std::isfinite(value)) throw InvalidArgument(argument, format_number(value), "a finite number");
}

void require_positive(const char* argument, double value) {
  if (!std::isfinite(value) || value <= 0.0)
    throw InvalidArgument(argument, format_number(value), "a finite number > 0");
}

}  // namespace ninedof
