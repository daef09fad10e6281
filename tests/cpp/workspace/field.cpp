/// Fields and sections of maps whose cells are made by hand: a ball in an octree, and quantities linear in space.

#include "ninedof/workspace/field.hpp"

#include "support/support.hpp"
#include "workspace/criteria/limits.hpp"

using namespace support;
using namespace ninedof;

namespace {

const Vec3 slope(0.11, -0.07, 0.05);  // of the logarithm of the condition number

double kappa_at(const Vec3& x) {
  return std::exp(1.5 + slope.dot(x));
}

constexpr double ball_radius = 2.1;

/// The share of a cell in the ball about the origin, by points.
double share_in_ball(const Vec3& centre, double side) {
  constexpr int many = 8;
  int inside = 0;
  for (int n = 0; n < many * many * many; ++n) {
    const Vec3 at = Vec3(n % many, n / many % many, n / (many * many)) + Vec3::Constant(0.5);
    inside += (centre + side * (at / many - Vec3::Constant(0.5))).norm() < ball_radius ? 1 : 0;
  }
  return inside / static_cast<double>(many * many * many);
}

/// A cell, or its eighths down to level 2 where the surface of the ball passes through it.
void add_cell(WorkspaceMap& map, const Vec3& centre, std::uint8_t level) {
  const double side = (map.high.x() - map.low.x()) / map.resolution / (1 << level);
  const double share = share_in_ball(centre, side);
  if (share > 0.0 && share < 1.0 && level < 2) {
    for (int n = 0; n < 8; ++n)
      add_cell(map, centre + 0.25 * side * (2.0 * Vec3(n & 1, (n >> 1) & 1, n >> 2) - Vec3::Ones()),
               static_cast<std::uint8_t>(level + 1));
    return;
  }
  WorkspaceCells& cells = map.cells;
  cells.centre.push_back(centre);
  cells.level.push_back(level);
  cells.state.push_back(share == 0.0 ? CellState::outside : share == 1.0 ? CellState::inside : CellState::boundary);
  cells.limit.push_back(cells.state.back() == CellState::boundary ? (centre.z() > 0.0 ? 3 : 5) : -1);
  cells.fraction.push_back(share);
  cells.condition_number.push_back(kappa_at(centre));
  cells.piece.push_back(share > 0.0 ? 0 : -1);
}

WorkspaceMap ball(const Vec3& low = Vec3::Constant(-4.0), const Vec3& high = Vec3::Constant(4.0)) {
  WorkspaceMap map;
  map.low = low;
  map.high = high;
  map.resolution = 8;
  const Vec3 side = (high - low) / 8.0;
  for (int n = 0; n < 512; ++n)
    add_cell(map, low + side.cwiseProduct(Vec3(n % 8, n / 8 % 8, n / 64) + Vec3::Constant(0.5)), 0);
  return map;
}

double volume_of_cells(const WorkspaceMap& map) {
  double sum = 0.0;
  for (std::size_t n = 0; n < map.cells.size(); ++n)
    sum += map.cells.fraction[n] * std::ldexp(1.0, -3 * map.cells.level[n]);
  return sum;
}

template <class Visit>
void visit(const Raster& raster, const Visit& seen) {
  std::size_t n = 0;
  for (std::size_t i = 0; i < raster.count[0]; ++i)
    for (std::size_t j = 0; j < raster.count[1]; ++j)
      for (std::size_t k = 0; k < raster.count[2]; ++k, ++n) {
        const Vec3 at(static_cast<double>(i), static_cast<double>(j), static_cast<double>(k));
        seen(raster.first + raster.step.cwiseProduct(at), raster.values[n]);
      }
}

/// The cell that holds a point.
std::size_t cell_of(const WorkspaceMap& map, const Vec3& x) {
  std::size_t found = map.cells.size();
  for (std::size_t n = 0; n < map.cells.size(); ++n)
    if ((map.cells.centre[n] - x).cwiseAbs().maxCoeff() < std::ldexp(0.5, -map.cells.level[n])) found = n;
  return found;
}

}  // namespace

TEST_SUITE("field") {
  TEST_CASE("a logarithm linear in space is kept over cells of all levels, and what is inside stays") {
    const WorkspaceMap map = ball();
    const WorkspaceField field = field_of(map);
    CHECK(field.fraction.step.isApprox(Vec3::Constant(0.25)));
    CHECK(field.condition_number.count == field.fraction.count);
    int checked = 0;
    const Vec3 last = field.condition_number.first +
                      field.condition_number.step.cwiseProduct(Vec3(static_cast<double>(field.fraction.count[0] - 1),
                                                                    static_cast<double>(field.fraction.count[1] - 1),
                                                                    static_cast<double>(field.fraction.count[2] - 1)));
    visit(field.condition_number, [&](const Vec3& x, double kappa) {
      if ((x - field.condition_number.first).minCoeff() < 2.0 || (last - x).minCoeff() < 2.0) return;
      CHECK(kappa == doctest::Approx(kappa_at(x)).epsilon(1e-12));
      ++checked;
    });
    CHECK(checked > 1000);
    visit(field.fraction, [&](const Vec3& x, double fraction) {
      if (x.norm() < ball_radius - 0.9) CHECK(fraction == 1.0);
      if (x.norm() > ball_radius + 0.9) CHECK(fraction == 0.0);
    });
  }

  TEST_CASE("field and body of a ball have its volume, and the body is closed") {
    const WorkspaceMap map = ball();
    const WorkspaceField field = field_of(map);
    double sum = 0.0;
    for (const double value : field.fraction.values) sum += value;
    CHECK(sum * field.fraction.step.prod() == doctest::Approx(volume_of_cells(map)).epsilon(1e-12));
    const QuadSurface body = surface_of(field);
    CHECK(std::ssize(body.points) - std::ssize(body.faces) == 2);  // Euler's number: two edges for each face
    CHECK(enclosed_volume(body) == doctest::Approx(4.0 / 3.0 * pi * std::pow(ball_radius, 3)).epsilon(0.02));
    for (const Vec3& point : body.points) CHECK(std::abs(point.norm() - ball_radius) < 0.1);
  }

  TEST_CASE("fewer points make a coarser field of the same volume") {
    const WorkspaceMap map = ball();
    const WorkspaceField field = field_of(map, 5000);
    CHECK(field.fraction.step.isApprox(Vec3::Constant(0.5)));
    double sum = 0.0;
    for (const double value : field.fraction.values) sum += value;
    CHECK(sum * field.fraction.step.prod() == doctest::Approx(volume_of_cells(map)).epsilon(1e-12));
  }

  TEST_CASE("the body of a workspace that reaches the faces of its box is closed there, though it is thin") {
    const WorkspaceMap map = ball(Vec3(-4.0, -4.0, -9.95), Vec3(4.0, 4.0, -1.95));  // a cap 0.15 high
    REQUIRE(volume_of_cells(map) > 0.0);
    const QuadSurface body = surface_of(field_of(map));
    CHECK(std::ssize(body.points) - std::ssize(body.faces) == 2);
    CHECK(enclosed_volume(body) > 0.0);
  }

  TEST_CASE("cells of a damaged file, beside the lattice or beyond the box, are left out") {
    WorkspaceMap map = ball();
    const WorkspaceField field = field_of(map);
    for (const double shift : {0.4, 3.7}) {
      WorkspaceMap other = map;
      other.cells.centre.push_back(Vec3(4.0, 4.0, 4.0) - Vec3::Constant(0.5 - shift));
      other.cells.level.push_back(0);
      other.cells.state.push_back(CellState::inside);
      other.cells.limit.push_back(-1);
      other.cells.fraction.push_back(1.0);
      other.cells.condition_number.push_back(1.0);
      CHECK(field_of(other).fraction.values == field.fraction.values);
    }
  }

  TEST_CASE("a pixel of a section has the values of the cell that holds its centre") {
    const WorkspaceMap map = ball();
    for (const int fixed : {0, 1, 2})
      for (const double at : {-1.9, 0.3}) {
        const WorkspaceSection section = section_of(map, fixed, at, 32);
        REQUIRE(section.fraction.size() == 32 * 32);
        for (std::size_t n = 0; n < section.fraction.size(); ++n) {
          Vec3 x = Vec3::Constant(at);
          x[fixed == 0 ? 1 : 0] = section.horizontal[n % 32];
          x[fixed == 2 ? 1 : 2] = section.vertical[n / 32];
          const std::size_t cell = cell_of(map, x);
          REQUIRE(cell < map.cells.size());
          CHECK(section.fraction[n] == map.cells.fraction[cell]);
          CHECK(section.state[n] == map.cells.state[cell]);
          CHECK(section.limit[n] == map.cells.limit[cell]);
          const bool held = map.cells.fraction[cell] > 0.0;
          CHECK(std::isnan(section.condition_number[n]) == !held);
          if (held) CHECK(section.condition_number[n] == map.cells.condition_number[cell]);
        }
      }
    // A plane between two layers belongs to one of them, and the last one to the last layer.
    CHECK(section_of(map, 2, 0.0, 32).fraction == section_of(map, 2, 0.01, 32).fraction);
    CHECK(section_of(map, 2, 4.0, 32).fraction == section_of(map, 2, 3.99, 32).fraction);
  }

  TEST_CASE("a smooth section is the field in its planes, and linear between them") {
    const WorkspaceMap map = ball();
    const WorkspaceField field = field_of(map);
    for (const int fixed : {0, 1, 2}) {
      const double step = field.fraction.step[fixed], here = field.fraction.first[fixed] + 12.0 * step;
      const WorkspaceSection near = section_of(map, field, fixed, here),
                             far = section_of(map, field, fixed, here + step);
      const WorkspaceSection middle = section_of(map, field, fixed, here + 0.3 * step);
      std::size_t n = 0;
      visit(field.fraction, [&](const Vec3& x, double fraction) {
        if (std::abs(x[fixed] - here) > 1e-9) return;
        // The raster runs through the plane with its last coordinate fastest, the section with the first one.
        const std::size_t at = (n % near.vertical.size()) * near.horizontal.size() + n / near.vertical.size();
        CHECK(near.horizontal[at % near.horizontal.size()] == doctest::Approx(x[fixed == 0 ? 1 : 0]));
        CHECK(near.vertical[at / near.horizontal.size()] == doctest::Approx(x[fixed == 2 ? 1 : 2]));
        CHECK(near.fraction[at] == doctest::Approx(fraction).epsilon(1e-12));
        CHECK(middle.fraction[at] == doctest::Approx(0.7 * near.fraction[at] + 0.3 * far.fraction[at]).epsilon(1e-9));
        const CellState state = fraction == 0.0  ? CellState::outside
                                : fraction < 1.0 ? CellState::boundary
                                                 : CellState::inside;
        CHECK(near.state[at] == state);
        CHECK(std::isnan(near.condition_number[at]) == (state == CellState::outside));
        CHECK((near.limit[at] >= 0) == (state == CellState::boundary));
        ++n;
      });
      CHECK(n == near.fraction.size());
    }
  }

  TEST_CASE("a point of the boundary has the limit of the nearest boundary cell") {
    const WorkspaceMap map = ball();
    const WorkspaceSection section = section_of(map, field_of(map), 0, 0.1);
    int checked = 0;
    for (std::size_t n = 0; n < section.limit.size(); ++n) {
      const double z = section.vertical[n / section.horizontal.size()];
      if (section.limit[n] < 0 || std::abs(z) < 0.6) continue;
      CHECK(section.limit[n] == (z > 0.0 ? 3 : 5));
      ++checked;
    }
    CHECK(checked > 40);
    WorkspaceMap full = map;
    std::ranges::fill(full.cells.fraction, 1.0);
    std::ranges::fill(full.cells.state, CellState::inside);
    const WorkspaceSection edge = section_of(full, field_of(full), 0, 0.1);
    CHECK(std::ranges::count(edge.limit, static_cast<std::int16_t>(limit::box())) > 40);
    CHECK(section_of(full, field_of(full), 0, 400.0).fraction == std::vector<double>(edge.fraction.size(), 0.0));
  }

  TEST_CASE("invalid arguments are named, and a stop ends the work") {
    WorkspaceMap map = ball();
    CHECK(message_of([&] { section_of(map, 3, 0.0, 10); }).starts_with("fixed: got 3"));
    CHECK(message_of([&] { section_of(map, 0, 0.0, 0); }).starts_with("pixels: got 0"));
    std::stop_source source;
    source.request_stop();
    CHECK_THROWS_AS(field_of(map, 1'000'000, source.get_token()), Stopped);
    CHECK_THROWS_AS(section_of(map, 0, 0.0, 10, source.get_token()), Stopped);
    map.resolution = 0;
    CHECK(message_of([&] { field_of(map); }).starts_with("map: got no cells"));
  }
}
