#include "math/form.hpp"

namespace ninedof::forms {

Series series(double u, int first) {
  constexpr int terms = 24;
  double factorial = 1.0;
  for (int n = 2; n <= first; ++n) factorial *= n;
  Series out{0.0, 0.0};
  std::array<double, terms> coefficient;
  for (int k = 0; k < terms; ++k) {
    coefficient[static_cast<std::size_t>(k)] = (k % 2 == 0 ? 1.0 : -1.0) / factorial;
    factorial *= (2.0 * k + first + 1.0) * (2.0 * k + first + 2.0);
  }
  for (std::size_t k = terms; k-- > 0;) {
    out.slope = out.slope * u + out.value;
    out.value = out.value * u + coefficient[k];
  }
  return out;
}

}  // namespace ninedof::forms
