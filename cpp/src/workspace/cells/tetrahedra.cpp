#include "workspace/cells/tetrahedra.hpp"

#include <Eigen/Geometry>
#include <cmath>

namespace ninedof {
namespace {

/// Corners along the six paths of edges from corner 0 to corner 7.
constexpr int tetrahedra[6][4] = {{0, 1, 3, 7}, {0, 1, 5, 7}, {0, 2, 3, 7}, {0, 2, 6, 7}, {0, 4, 5, 7}, {0, 4, 6, 7}};

Vec3 corner_at(int n) {
  return {static_cast<double>(n & 1), static_cast<double>((n >> 1) & 1), static_cast<double>(n >> 2)};
}

/// The corners of a tetrahedron, allowed ones first.
struct Sorted {
  std::array<int, 4> corner{};
  int allowed = 0;
};

Sorted sorted(const int (&t)[4], unsigned inside) {
  Sorted out;
  int last = 4;
  for (const int n : t) out.corner[at_index(((inside >> n) & 1U) != 0 ? out.allowed++ : --last)] = n;
  return out;
}

}  // namespace

CutCell::CutCell(const Corners& corners, int groups) : corners_(corners), groups_(groups) {
  for (unsigned n = 0; n < 8; ++n)
    if (corners[n]->allowed(groups)) inside_ |= 1U << n;
}

const Crossing& CutCell::crossing(int from, int to) {
  Crossing& c = edge_[at_index(8 * from + to)];
  if (c.limit >= 0) return c;
  const PointMargins &a = *corners_[at_index(from)], &b = *corners_[at_index(to)];
  c.t = 1.0;
  for (int g = 0; g < groups_; ++g) {
    const auto n = at_index(g);
    if (b.margin[n] >= 0.0) continue;
    const double t = std::isfinite(a.margin[n]) ? a.margin[n] / (a.margin[n] - b.margin[n]) : 1.0;
    if (c.limit < 0 || t < c.t) c = {t, b.limit[n]};
  }
  return c;
}

Vec3 CutCell::crossing_point(int from, int to) {
  return corner_at(from) + crossing(from, to).t * (corner_at(to) - corner_at(from));
}

double CutCell::fraction() {
  if (inside_ == 0) return 0.0;
  if (inside_ == 255) return 1.0;
  double sum = 0.0;
  for (const auto& t : tetrahedra) {
    const Sorted s = sorted(t, inside_);
    const auto at = [&](std::size_t in, std::size_t out) { return crossing(s.corner[in], s.corner[out]).t; };
    if (s.allowed == 1) sum += at(0, 1) * at(0, 2) * at(0, 3);
    if (s.allowed == 3) sum += 1.0 - (1.0 - at(0, 3)) * (1.0 - at(1, 3)) * (1.0 - at(2, 3));
    if (s.allowed == 4) sum += 1.0;
    if (s.allowed != 2) continue;
    // The wedge between the triangles (a, ac, ad) and (b, bc, bd), as three tetrahedra.
    const double ac = at(0, 2), ad = at(0, 3), bc = at(1, 2), bd = at(1, 3);
    sum += ac * ad * (1.0 - bd) + ac * (1.0 - bc) * bd + bc * bd;
  }
  return sum / 6.0;
}

void CutCell::boundary(const Vec3& size, std::vector<Piece>& out) {
  for (const auto& t : tetrahedra) {
    const Sorted s = sorted(t, inside_);
    if (s.allowed == 0 || s.allowed == 4) continue;
    std::array<std::pair<int, int>, 4> ring;  // corners of the polygon, in order
    std::size_t count = 3;
    const auto& c = s.corner;
    if (s.allowed == 1) ring = {{{c[0], c[1]}, {c[0], c[2]}, {c[0], c[3]}, {}}};
    if (s.allowed == 3) ring = {{{c[0], c[3]}, {c[1], c[3]}, {c[2], c[3]}, {}}};
    if (s.allowed == 2) {
      ring = {{{c[0], c[2]}, {c[0], c[3]}, {c[1], c[3]}, {c[1], c[2]}}};
      count = 4;
    }
    std::array<Vec3, 4> at;
    for (std::size_t n = 0; n < count; ++n) at[n] = crossing_point(ring[n].first, ring[n].second).cwiseProduct(size);
    double area = 0.5 * (at[1] - at[0]).cross(at[2] - at[0]).norm();
    if (count == 4) area += 0.5 * (at[2] - at[0]).cross(at[3] - at[0]).norm();
    for (std::size_t n = 0; n < count; ++n)
      out.push_back({area / static_cast<double>(count), crossing(ring[n].first, ring[n].second).limit});
  }
}

void CutCell::crossings(std::vector<Vec3>& out) {
  for (const int other : {1, 2, 4})
    if (allowed(0) != allowed(other)) out.push_back(allowed(0) ? crossing_point(0, other) : crossing_point(other, 0));
}

}  // namespace ninedof
