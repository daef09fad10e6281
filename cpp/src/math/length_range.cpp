#include "ninedof/math/length_range.hpp"

#include <cmath>

#include "ninedof/math/error.hpp"

namespace ninedof {

void require_length(const char* argument, double length) {
  require_positive(argument, length);
  if (length < least_length || length > most_length)
    throw InvalidArgument(argument, format_number(length),
                          "a length within " + format_interval(least_length, most_length));
}

void require_coordinate(const char* argument, double coordinate) {
  require_finite(argument, coordinate);
  if (std::abs(coordinate) > most_length)
    throw InvalidArgument(argument, format_number(coordinate), "a length of at most " + format_number(most_length));
}

void require_coordinates(const char* argument, const Vec3& point) {
  for (const double x : point) require_coordinate(argument, x);
}

}  // namespace ninedof
