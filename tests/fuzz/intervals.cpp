/// Interval operations against the same operations in wider numbers: an enclosure that leaves out a result proves what
/// is false.

#include <algorithm>

#include "ninedof/math/interval.hpp"
#include "support/bytes.hpp"

using namespace fuzz;

namespace {

using Wide = long double;
static_assert(sizeof(Wide) > sizeof(double), "on this machine a wider number is needed");

bool holds(const Interval& x, Wide value) {
  return std::isnan(value) || (static_cast<Wide>(x.lo) <= value && value <= static_cast<Wide>(x.hi));
}

bool sound(const Interval& x) {
  return x.lo <= x.hi;
}

Interval interval(Bytes& in) {
  const double a = in.any(), b = in.byte() % 4 == 0 ? a : in.any();
  return Interval::between(std::min(a, b), std::max(a, b));
}

void one(const Interval& x) {
  for (const Interval& result : {-x, square(x), abs(x), sqrt(x), exp(x), log(x), sin(x), cos(x)}) EXPECT(sound(result));
  EXPECT(contains(x, middle(x)));
  for (const double value : {x.lo, x.hi, middle(x)}) {
    const Wide w = value;
    EXPECT(holds(-x, -w));
    EXPECT(holds(square(x), w * w));
    EXPECT(holds(abs(x), std::abs(w)));
    EXPECT(holds(exp(x), std::exp(w)));
    EXPECT(holds(sin(x), std::sin(w)));
    EXPECT(holds(cos(x), std::cos(w)));
    if (value >= 0.0) EXPECT(holds(sqrt(x), std::sqrt(w)));
    if (value > 0.0) EXPECT(holds(log(x), std::log(w)));
  }
}

void two(const Interval& x, const Interval& y) {
  for (const Interval& result : {x + y, x - y, x * y, x / y, hull(x, y), min(x, y), max(x, y)}) EXPECT(sound(result));
  for (const double a : {x.lo, x.hi, middle(x)})
    for (const double b : {y.lo, y.hi, middle(y)}) {
      const Wide v = a, w = b;
      EXPECT(holds(x + y, v + w));
      EXPECT(holds(x - y, v - w));
      EXPECT(holds(x * y, v * w));
      if (b != 0.0) EXPECT(holds(x / y, v / w));
      EXPECT(holds(min(x, y), std::min(v, w)));
      EXPECT(holds(max(x, y), std::max(v, w)));
      EXPECT(holds(hull(x, y), v) && holds(hull(x, y), w));
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Bytes in(data, size);
  const Interval x = interval(in), y = interval(in);
  one(x);
  one(y);
  two(x, y);
  two(x * y, x + y);
  one(x * y);  // its ends may be infinite
  return 0;
}
