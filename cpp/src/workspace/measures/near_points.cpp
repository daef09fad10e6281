#include "workspace/measures/near_points.hpp"

#include <algorithm>
#include <cmath>

#include "math/numbers.hpp"

namespace ninedof {

NearPoints::NearPoints(const Vec3& low, const Vec3& high, const std::vector<Vec3>& points)
    : low_(low), size_((high - low) / bins), begin_(bins * bins * bins + 1, 0), points_(points.size()) {
  std::vector<std::size_t> of(points.size());
  for (std::size_t n = 0; n < points.size(); ++n) {
    int at[3];
    place(points[n], at);
    of[n] = bin(at);
    ++begin_[of[n] + 1];
  }
  for (std::size_t b = 1; b < begin_.size(); ++b) begin_[b] += begin_[b - 1];
  std::vector<std::size_t> next(begin_.begin(), begin_.end() - 1);
  for (std::size_t n = 0; n < points.size(); ++n) points_[next[of[n]]++] = points[n];
}

void NearPoints::place(const Vec3& x, int (&at)[3]) const {
  for (int k = 0; k < 3; ++k) at[k] = static_cast<int>(std::clamp((x[k] - low_[k]) / size_[k], 0.0, bins - 1.0));
}

double NearPoints::distance(const Vec3& x) const {
  double best = infinity;
  if (points_.empty()) return best;
  int home[3];
  place(x, home);
  const double thinnest = size_.minCoeff();
  // Shells of bins about that of x: the next one is at least ring * thinnest away.
  for (int ring = 0; ring < bins; ++ring) {
    const double ahead = (ring - 1) * thinnest;
    if (ahead > 0.0 && ahead * ahead > best) break;
    int from[3], to[3];
    for (int k = 0; k < 3; ++k) {
      from[k] = std::max(home[k] - ring, 0);
      to[k] = std::min(home[k] + ring, bins - 1);
    }
    int at[3];
    for (at[2] = from[2]; at[2] <= to[2]; ++at[2])
      for (at[1] = from[1]; at[1] <= to[1]; ++at[1]) {
        const bool edge = std::abs(at[2] - home[2]) == ring || std::abs(at[1] - home[1]) == ring;
        const int stride = edge || ring == 0 ? 1 : 2 * ring;
        for (at[0] = edge ? from[0] : home[0] - ring; at[0] <= to[0]; at[0] += stride) {
          if (at[0] < 0) continue;
          const std::size_t b = bin(at);
          for (std::size_t n = begin_[b]; n < begin_[b + 1]; ++n) best = std::min(best, (points_[n] - x).squaredNorm());
        }
      }
  }
  return std::sqrt(best);
}

}  // namespace ninedof
