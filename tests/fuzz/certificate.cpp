/// Certificates: whatever the bytes, the checker ends with a verdict; and what it calls proved no design refutes.
///
/// The head and the length of the tree are made to agree with the rest: a checksum is not what is tested here. One
/// input in four goes in as it is.

#include <sstream>
#include <string>

#include "ninedof/batch/batch.hpp"
#include "ninedof/conditioning/characteristic_length.hpp"
#include "ninedof/conditioning/symmetric.hpp"
#include "ninedof/proof/checker.hpp"
#include "proof/checker/certificate_file.hpp"
#include "proof/checker/spelling.hpp"
#include "support/bytes.hpp"

using namespace fuzz;
using checker::Certificate;
using checker::Range;

namespace {

/// The text of a certificate without its first two lines and without the length of the tree.
std::string completed(std::string body) {
  const std::string mark = "\ntree\n";
  if (const std::size_t at = body.find(mark); at != std::string::npos)
    body.insert(at + mark.size() - 1, std::to_string(body.size() - at - mark.size()).insert(0, 1, ' '));
  return checker::sealed("ninedof certificate 1", body);
}

double within(const Range& x, double share) {
  if (std::isinf(x.a) && std::isinf(x.b)) return 20.0 * share - 10.0;  // an angle that may be any
  return std::isinf(x.b) ? x.a + share / (1.0 - share) : std::clamp(x.a + share * (x.b - x.a), x.a, x.b);
}

/// Shares of the way through the bounds of the variables: ends, the middle, and a sequence that fills the box.
double share(int sample, std::size_t k) {
  if (sample == 0) return 0.5;
  const double step = std::sqrt(static_cast<double>(2 + 3 * k * k + k));
  return std::fmod(sample * (step - std::floor(step)), 0.999);
}

bool allowed(const Certificate& c, const char* name, double value) {
  return std::all_of(c.limits.begin(), c.limits.end(), [&](const checker::Bound& limit) {
    return limit.name != name || (value >= limit.range.a && value <= limit.range.b);
  });
}

/// A design of the certificate's study is not better than the target, but for rounding.
void judge(const Certificate& c, const Geometry& g, double zp, double zs, double turn, double free_length) {
  if (!(zs > 0.0 && zs < zp)) return;
  const Configuration home = neutral(zp, zs, turn);
  const double length =
      c.length_kind.empty() ? free_length : characteristic_length(g, home, length_kind(c.length_kind));
  if (!(length > 0.0)) return;
  const AxisSpectrum<double> s = axis_spectrum(axis_design(g, home), length);
  const double longest = std::max({s.l, s.q, s.r}), shortest = std::min({s.l, s.q, s.r});
  const auto radius = [](const Vec3& joint) { return joint.head<2>().norm(); };
  const double ratio = std::max(radius(g.base_external()[0]), radius(g.base_internal()[0])) /
                       std::max(radius(g.platform_external()[0]), radius(g.platform_internal()[0]));
  if (!allowed(c, "radius_ratio", ratio) || !allowed(c, "zs_fraction", zs / zp) ||
      !allowed(c, "leg_ratio", longest / shortest))
    return;
  const double kappa = std::max(s.axial_max, s.transverse_max) / std::min(s.axial_min, s.transverse_min);
  EXPECT(!(kappa < c.target * (1.0 - 1e-9)));
}

void look_for_better(const Certificate& c) {
  constexpr int samples = 64;
  for (int sample = 0; sample < samples; ++sample) {
    std::array<double, 9> x{};
    for (std::size_t k = 0; k < std::min(c.variables.size(), x.size()); ++k)
      x[k] = within(c.variables[k].range, share(sample, k));
    const double length = within(c.length, share(sample, x.size()));
    try {
      if (c.family == "hexagonal") judge(c, Geometry::hexagonal(x[0], x[1], x[2], x[3]), x[4], x[5], x[6], length);
      else
        judge(c, Geometry::symmetric({x[0], 0.0, 0.0}, {x[1], x[2], 0.0}, {x[3], x[4], 0.0}, {x[5], x[6], 0.0}), x[7],
              x[8], 0.0, length);
    } catch (const InvalidArgument&) {
    }
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string bytes(reinterpret_cast<const char*>(data), size);
  const std::string certificate = bytes.compare(0, 8, "ninedof ") == 0 ? bytes : completed(bytes);
  const checker::Verdict verdict = checker::check(certificate);
  EXPECT(!verdict.words.empty());
  if (verdict.proved && !certificate.starts_with("ninedof certificate of designs")) {
    std::istringstream text(certificate);
    checker::Stream file(text);
    look_for_better(checker::read(file));
  }
  return 0;
}
