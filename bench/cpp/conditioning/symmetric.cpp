#include "ninedof/conditioning/symmetric.hpp"

#include <algorithm>

#include "ninedof/families/hexagonal_family.hpp"
#include "support/baseline.hpp"
#include "support/over_poses.hpp"

namespace bench {
namespace {

using Dual = ninedof::Dual<7>;

const ninedof::HexagonalFamily symmetric_family;

/// The first joints of the family, those of the platform rotated to the base axes.
template <class T>
ninedof::AxisDesign<T> axis_design(const std::array<T, 7>& x) {
  using std::cos;
  using std::sin;
  const ninedof::Orbits<T> o = symmetric_family.orbits<T>(x);
  const T c = cos(o.theta_z), s = sin(o.theta_z);
  const auto turned = [&](const ninedof::Xyz<T>& u) {
    return ninedof::Xyz<T>{c * u.x - s * u.y, s * u.x + c * u.y, u.z};
  };
  return {o.base_external, o.base_internal, turned(o.platform_external), turned(o.platform_internal), o.zp, o.zs};
}

/// Variables of the hexagonal family -> condition number, for both number types.
template <class T>
T condition_number(const std::array<T, 7>& x) {
  const ninedof::AxisSpectrum<T> s = ninedof::axis_spectrum(axis_design(x), 1.0);
  const auto less = [](const T& a, const T& b) { return ninedof::value_of(a) < ninedof::value_of(b); };
  return std::max(s.axial_max, s.transverse_max, less) / std::min(s.axial_min, s.transverse_min, less);
}

Dual value_and_gradient(const Variables& at) {
  return condition_number(Dual::variables(at));
}

/// Central differences are invalid across a kink, where two singular values change their order, and inaccurate near a
/// singularity.
bool differences_hold(const Variables& x) {
  const auto s = ninedof::axis_spectrum(axis_design(x), 1.0);
  const auto close = [](double a, double b) { return std::abs(a - b) < 1e-4 * (a + b); };
  return condition_number(x) < 100.0 && !close(s.axial_max, s.transverse_max) && !close(s.axial_min, s.transverse_min);
}

}  // namespace

Figures symmetric() {
  const auto designs = std::make_shared<const std::vector<Variables>>(random_designs());
  auto poses = std::make_shared<std::vector<Pose>>();
  for (const Variables& x : *designs)
    poses->push_back({symmetric_family.geometry(x), symmetric_family.configuration(x)});

  const auto svd = [](const Pose& p) { return plain::condition_number(p.geometry, p.configuration, 1.0); };
  const auto differences = [](const Variables& x) {
    return plain::gradient([](const Variables& at) { return condition_number(at); }, x);
  };
  std::size_t compared = 0;
  for (std::size_t k = 0; k < designs->size(); ++k) {
    const Variables& x = (*designs)[k];
    const double kappa = condition_number(x);
    require_close("closed form", kappa, svd((*poses)[k]), 1e-13 * kappa * kappa);
    const Dual dual = value_and_gradient(x);
    require_close("closed form with derivatives", dual.value, kappa, 1e-14 * kappa);
    if (!differences_hold(x)) continue;
    const Variables expected = differences(x);
    for (std::size_t i = 0; i < 7; ++i)
      require_close("derivative", dual.gradient[i], expected[i], 1e-7 * kappa * kappa);
    ++compared;
  }
  require(compared > designs->size() / 2, "too few derivatives compared: " + std::to_string(compared));

  const auto value = each_in_block(designs, [](const Variables& x) { return condition_number(x); });
  const auto gradient = each_in_block(designs, [](const Variables& x) { return value_and_gradient(x); });
  return {{{"closed form on the axis",
            "plain Eigen: J', JacobiSVD",
            blocks,
            block_size,
            value,
            each_in_block(poses, svd),
            {"60 ns", [](const Times& t) { return t.ours_median <= 60.0; }}},
           {"closed form and 7 derivatives",
            "its value alone",
            blocks,
            block_size,
            gradient,
            value,
            {"6 times the cost", [](const Times& t) { return t.speedup >= 1.0 / 6.0; }},
            true},
           {"closed form and 7 derivatives", "central differences of it", blocks, block_size, gradient,
            each_in_block(designs, differences)}},
          {}};
}

}  // namespace bench
