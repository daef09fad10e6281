/// Interval operations over arrays, for tests: users have no intervals, only bounds.

#include "ninedof/math/interval.hpp"

#include <map>

#include "support/arrays.hpp"
#include "support/module.hpp"

namespace ninedof::python {
namespace {

using Operation = Interval (*)(const Interval&, const Interval&);

const std::map<std::string, Operation>& operations() {
  using I = const Interval&;
  static const std::map<std::string, Operation> table = {
      {"add", [](I a, I b) { return a + b; }},      {"subtract", [](I a, I b) { return a - b; }},
      {"multiply", [](I a, I b) { return a * b; }}, {"divide", [](I a, I b) { return a / b; }},
      {"min", [](I a, I b) { return min(a, b); }},  {"max", [](I a, I b) { return max(a, b); }},
      {"negative", [](I a, I) { return -a; }},      {"abs", [](I a, I) { return abs(a); }},
      {"square", [](I a, I) { return square(a); }}, {"sqrt", [](I a, I) { return sqrt(a); }},
      {"exp", [](I a, I) { return exp(a); }},       {"log", [](I a, I) { return log(a); }},
      {"sin", [](I a, I) { return sin(a); }},       {"cos", [](I a, I) { return cos(a); }},
      {"atan", [](I a, I) { return atan(a); }},     {"acos", [](I a, I) { return acos(a); }},
  };
  return table;
}

}  // namespace

void bind_interval(py::module_& m) {
  // Rows lo hi of the result, from rows a.lo a.hi b.lo b.hi.
  m.def("interval_operations", [](const std::string& name, const Array& operands) {
    const auto found = operations().find(name);
    if (found == operations().end()) throw InvalidArgument("name", name, "the name of an interval operation");
    const long count = static_cast<long>(operands.size() / 4);
    const double* x = rows("operands", operands, count, 4);
    return for_each_row(count, 2, 1, py::none(), [&](long i, double* out) {
      const double* at = x + 4 * i;
      const Interval result = found->second(Interval::between(at[0], at[1]), Interval::between(at[2], at[3]));
      out[0] = result.lo;
      out[1] = result.hi;
    });
  });
}

}  // namespace ninedof::python
