/// Declared in ninedof/workspace/certified.hpp.

#include <algorithm>
#include <numeric>

#include "ninedof/workspace/certified.hpp"

namespace ninedof {
namespace {

using Numbers = std::vector<std::size_t>;

bool holds(const Vec3& low, const Vec3& high, const Vec3& x) {
  return (low.array() <= x.array()).all() && (x.array() <= high.array()).all();
}

/// Calls visit(point, box) for the boxes that hold each of many points: of those that share a face, all.
template <class Visit>
class Holders {
 public:
  Holders(const std::vector<Vec3>& low, const std::vector<Vec3>& high, const std::vector<Vec3>& points,
          const Visit& visit, const std::stop_token& stop)
      : low_(low), high_(high), points_(points), visit_(visit), stop_(stop) {
    Numbers boxes(low.size()), at(points.size());
    std::iota(boxes.begin(), boxes.end(), std::size_t{0});
    std::iota(at.begin(), at.end(), std::size_t{0});
    find(boxes, at);
  }

 private:
  static constexpr std::size_t few = 24;  // boxes that are compared with every point

  /// Divides the boxes at a plane, and the points with them.
  void find(const Numbers& boxes, const Numbers& at) {
    if (boxes.empty() || at.empty()) return;
    if (stop_.stop_requested()) throw Stopped{};
    const auto [axis, plane] = division(boxes);
    Numbers below, above, left, right;
    for (const std::size_t n : boxes) {
      if (low_[n][axis] < plane) below.push_back(n);
      if (high_[n][axis] > plane) above.push_back(n);
    }
    if (boxes.size() <= few || std::max(below.size(), above.size()) == boxes.size()) {
      for (const std::size_t k : at)
        for (const std::size_t n : boxes)
          if (holds(low_[n], high_[n], points_[k])) visit_(k, n);
      return;
    }
    // A point on the plane goes to both sides: boxes on either side may hold it.
    for (const std::size_t k : at) {
      if (points_[k][axis] <= plane) left.push_back(k);
      if (points_[k][axis] >= plane) right.push_back(k);
    }
    find(below, left);
    find(above, right);
  }

  /// The median of the middles of boxes, along the axis on which they are spread most.
  std::pair<Eigen::Index, double> division(const Numbers& boxes) const {
    const auto middle = [&](std::size_t n) -> Vec3 { return 0.5 * (low_[n] + high_[n]); };
    Vec3 least = middle(boxes.front()), greatest = least;
    for (const std::size_t n : boxes) {
      least = least.cwiseMin(middle(n));
      greatest = greatest.cwiseMax(middle(n));
    }
    Eigen::Index axis = 0;
    (greatest - least).maxCoeff(&axis);
    std::vector<double> places;
    for (const std::size_t n : boxes) places.push_back(middle(n)[axis]);
    const auto half = places.begin() + std::ssize(places) / 2;
    std::nth_element(places.begin(), half, places.end());
    return {axis, *half};
  }

  const std::vector<Vec3>&low_, &high_, &points_;
  const Visit& visit_;
  const std::stop_token& stop_;
};

/// What the planes of an open box prove of a point in it.
std::int8_t state_in(const CertifiedWorkspace& found, std::size_t box, const Vec3& x) {
  const Vec3 &low = found.open_low[box], &high = found.open_high[box], half = 0.5 * (high - low);
  const Vec3 t = (x - 0.5 * (low + high)).cwiseQuotient(half);
  const Vec3 size = low.cwiseAbs() + high.cwiseAbs() + x.cwiseAbs();
  const Vec3 error = 0x1p-48 * (size.cwiseQuotient(half) + Vec3::Constant(2.0));
  const auto first = found.first_cut[box], last = found.first_cut[box + 1];
  bool allowed = first < last, forbidden = false;
  for (auto k = first; k < last; ++k) {
    const BoxCut& cut = found.cuts[at_index(k)];
    const double value = cut.slope.dot(t), room = cut.slope.cwiseAbs().dot(error);
    allowed = allowed && value - room >= cut.allowed;
    forbidden = forbidden || value + room <= cut.forbidden;
  }
  return static_cast<std::int8_t>(allowed ? 1 : forbidden ? -1 : 0);
}

}  // namespace

std::vector<std::int8_t> proved_states(const CertifiedWorkspace& found, const std::vector<Vec3>& points,
                                       const std::stop_token& stop) {
  std::vector<std::int8_t> out;
  for (const Vec3& x : points) {
    const bool outer = found.beyond == CertifiedWorkspace::Beyond::nothing || holds(found.box_low, found.box_high, x);
    out.push_back(static_cast<std::int8_t>(outer ? -1 : 0));
  }
  // On a face that open boxes share, the planes of one may prove what those of the other leave open.
  std::vector<bool> in_open(points.size(), false);
  const auto open = [&](std::size_t k, std::size_t n) {
    if (!in_open[k] || out[k] == 0) out[k] = state_in(found, n, points[k]);
    in_open[k] = true;
  };
  Holders(found.open_low, found.open_high, points, open, stop);
  const auto inner = [&](std::size_t k, std::size_t) { out[k] = 1; };
  Holders(found.inner_low, found.inner_high, points, inner, stop);
  return out;
}

}  // namespace ninedof
