#pragma once
/// What all fuzz targets need: numbers and robots out of bytes, and a way to say that an invariant is broken.

#include <Eigen/Geometry>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <optional>

#include "ninedof/math/error.hpp"
#include "ninedof/robot/configuration.hpp"
#include "ninedof/robot/geometry.hpp"

namespace fuzz {

using namespace ninedof;

/// Ends the run: libFuzzer then keeps the input.
#define EXPECT(what)                                                  \
  do {                                                                \
    if (!(what)) {                                                    \
      std::fprintf(stderr, "%s:%d: %s\n", __FILE__, __LINE__, #what); \
      std::abort();                                                   \
    }                                                                 \
  } while (false)

/// Bytes taken from the front; zeros after the last.
class Bytes {
 public:
  Bytes(const std::uint8_t* data, std::size_t size) : at_(data), end_(data + size) {}

  std::uint8_t byte() { return at_ == end_ ? std::uint8_t{0} : *at_++; }

  std::uint64_t word(int bytes) {
    std::uint64_t out = 0;
    for (int k = 0; k < bytes; ++k) out = out << 8U | byte();
    return out;
  }

  /// A multiple of 1/256 within [-128, 128): coincidences, planes and symmetries are a few bytes away.
  double coarse() { return static_cast<double>(static_cast<std::int16_t>(word(2))) / 256.0; }

  /// Any double that is finite, or a coarse number with a few of the lowest bits changed.
  double any() {
    if (byte() < 128) {
      const double x = coarse();
      return std::bit_cast<double>(std::bit_cast<std::uint64_t>(x) ^ (byte() & 7U));
    }
    const double x = std::bit_cast<double>(word(8));
    return std::isfinite(x) ? x : 1.0;
  }

  /// A coarse number, and now and then one that is off it by as little as a double can say.
  double near_coarse() {
    const double x = coarse();
    const std::uint8_t off = byte();
    return off < 192 ? x : x * (1.0 + std::ldexp(1.0, -(off - 192)));
  }

  bool empty() const { return at_ == end_; }

 private:
  const std::uint8_t *at_, *end_;
};

struct Robot {
  Geometry geometry;
  Configuration pose;
};

inline Vec3 point(Bytes& in) {
  const double x = in.near_coarse(), y = in.near_coarse(), z = in.near_coarse();
  return {x, y, z};
}

inline Triple triple(Bytes& in, double scale) {
  Triple t;
  for (Vec3& joint : t) joint = scale * point(in);
  return t;
}

/// A robot of ordinary proportions in a unit that is not: all lengths are multiplied by one power of two from
/// `lowest` to `highest`. Empty where the geometry is refused, as it must be, with InvalidArgument.
inline std::optional<Robot> robot(Bytes& in, int lowest, int highest) {
  const int exponent = in.byte() < 128 ? 0 : lowest + static_cast<int>(in.byte()) * (highest - lowest) / 255;
  const double scale = std::ldexp(1.0, exponent);
  const Triple r = triple(in, scale), r_hat = triple(in, scale), u = triple(in, scale), u_tilde = triple(in, scale);
  Configuration c;
  c.position = scale * point(in);
  c.internal_point = scale * point(in);
  const double w = in.coarse(), x = in.coarse(), y = in.coarse(), z = in.coarse();
  const Eigen::Quaterniond q(w, x, y, z);
  if (q.squaredNorm() > 0.0) c.rotation = q.normalized().toRotationMatrix();
  try {
    return Robot{Geometry(r, r_hat, u, u_tilde), c};
  } catch (const InvalidArgument&) {
    return std::nullopt;
  }
}

}  // namespace fuzz
