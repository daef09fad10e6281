/// admissible.hpp: sets of designs, and the room around one. Oracle: margins and condition numbers of designs drawn
/// from the pieces, at poses drawn from the region.

#include "ninedof/proof/admissible.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>

#include "ninedof/conditioning/conditioning.hpp"
#include "ninedof/limits/numbers.hpp"
#include "ninedof/math/error.hpp"
#include "support/support.hpp"

using namespace ninedof;
using namespace support;

namespace {

DesignQuestion question() {
  DesignQuestion out;
  out.problem.family = "hexagonal";
  out.problem.variables = {{0.0, 0.0}, {2.0, 10.0}, {1.0, 5.0}, {0.0, 0.0}, {5.0, 5.0}, {3.0, 3.0}, {0.0, 0.0}};
  Limit longest;
  longest.name = "leg_length";
  longest.high = 6.6;
  Limit cone;
  cone.name = "base_cone";
  cone.high = 1.0;
  cone.axis = Vec3::UnitZ();
  out.problem.limits = {longest, cone};
  Region region;
  region.size = {0.3, 0.3, 0.2};
  region.tilt = 0.1;
  out.region = {region};
  out.at = {0.0, 6.0, 3.0, 0.0, 5.0, 3.0, 0.0};
  out.varied = {1, 2};
  out.low = {2.0, 1.0};
  out.high = {10.0, 5.0};
  return out;
}

/// The least margins of both limits at a pose.
double margin(double a2, double b1, const Vec6& at) {
  const Geometry g = Geometry::hexagonal(0.0, a2, b1, 0.0);
  const Configuration home = neutral(5.0, 3.0);
  Configuration c = home;
  c.position += at.head<3>();
  c.internal_point += at.head<3>();
  const Vec3 tilt(at[3], at[4], 0.0);
  if (tilt.norm() > 0.0) c.rotation = Eigen::AngleAxisd(tilt.norm(), tilt.normalized()).toRotationMatrix();
  std::array<double, 9> lengths;
  LimitNumbers("leg_length", g, home, 1.0).at(c, lengths.data());
  std::array<double, 6> angles;
  LimitNumbers("base_cone", g, home, 1.0, Vec3(0, 0, 1)).at(c, angles.data());
  return std::min(6.6 - *std::ranges::max_element(lengths), 1.0 - *std::ranges::max_element(angles));
}

Vec6 drawn(std::mt19937_64& random) {
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  Vec6 out;
  out << 0.3 * unit(random), 0.3 * unit(random), 0.2 * unit(random), 0.0, 0.0, 0.0;
  do {
    out[3] = 0.1 * unit(random);
    out[4] = 0.1 * unit(random);
  } while (std::hypot(out[3], out[4]) > 0.1);
  return out;
}

}  // namespace

TEST_SUITE("admissible") {
  TEST_CASE("what is proved of designs holds of those drawn at random") {
    DesignSettings settings;
    settings.resolution = 0.02;
    const DesignSet found = admissible_designs(question(), settings);
    CHECK(found.inside > 0.1);
    CHECK(found.outside > 0.1);
    CHECK(found.undecided < 0.02);
    CHECK(found.inside + found.outside + found.undecided == doctest::Approx(1.0));
    std::mt19937_64 random(3);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    for (const DesignPiece& piece : found.pieces) {
      const double a2 = piece.low[0] + unit(random) * (piece.high[0] - piece.low[0]),
                   b1 = piece.low[1] + unit(random) * (piece.high[1] - piece.low[1]);
      if (piece.state == Membership::inside)
        for (int n = 0; n < 20; ++n) REQUIRE(margin(a2, b1, drawn(random)) > 0.0);
      if (piece.state != Membership::outside ||
          found.demands[static_cast<std::size_t>(piece.demand)].limit == "no singularity")
        continue;
      Vec6 at = Vec6::Zero();
      at.head<3>() = piece.at.shift;
      at.segment<3>(3) = piece.at.tilt;
      REQUIRE(margin(a2, b1, at) < 1e-9);
    }
  }

  TEST_CASE("a leg whose force is not known saves the search of the other legs") {
    DesignQuestion asked = question();
    const auto duty = std::make_shared<Duty>();
    duty->loads.front().force = Vec3::UnitZ();
    Limit force;
    force.name = "force";
    force.high = 1.0;
    force.duty = duty;
    asked.problem.limits = {force};
    asked.low = {4.0, 2.0};
    asked.high = {8.0, 4.0};
    DesignSettings settings;
    settings.resolution = 0.1;
    const DesignSet found = admissible_designs(asked, settings);
    CHECK(found.undecided == 0.0);
    CHECK(found.boxes < 30'000);  // 53 000 where each leg is searched alike
  }

  TEST_CASE("a run goes on with the undecided pieces of another, and threads change nothing") {
    DesignSettings settings;
    settings.resolution = 0.2;
    const DesignSet coarse = admissible_designs(question(), settings);
    settings.resolution = 0.05;
    const DesignSet fine = admissible_designs(question(), settings, coarse.pieces);
    CHECK(fine.undecided < coarse.undecided);
    CHECK(fine.inside >= coarse.inside);
    settings.threads = 1;
    const DesignSet one = admissible_designs(question(), settings, coarse.pieces);
    CHECK(one.inside == fine.inside);
    CHECK(one.pieces.size() == fine.pieces.size());
  }

  TEST_CASE("the room around a design is inside, and is in the proportions that are asked for") {
    const std::vector<double> design{5.0, 3.0};
    for (const std::vector<double>& proportions : {std::vector<double>{}, std::vector<double>{2.0, 1.0}}) {
      const DesignRoom room = room_around(question(), design, proportions, 1'000'000);
      REQUIRE(room.found);
      CHECK(room.low[0] < 5.0);
      CHECK(room.high[0] > 5.0);
      if (!proportions.empty())
        CHECK((room.high[0] - room.low[0]) / (room.high[1] - room.low[1]) == doctest::Approx(2.0).epsilon(1e-6));
      std::mt19937_64 random(5);
      double least = 1.0;
      for (int n = 0; n < 2000; ++n) {
        const double a2 = (n & 1) != 0 ? room.high[0] : room.low[0], b1 = (n & 2) != 0 ? room.high[1] : room.low[1];
        least = std::min(least, margin(a2, b1, drawn(random)));
      }
      CHECK(least > 0.0);
      CHECK(least < 0.5);  // it ends near a limit
    }
    const DesignRoom first = room_around(question(), design, {}, 2000),
                     again = room_around(question(), design, {}, 2000);
    CHECK(first.boxes < room_around(question(), design, {}, 1'000'000).boxes);  // not by time, but by its boxes
    CHECK(first.low == again.low);
    CHECK(first.high == again.high);
    const DesignRoom none = room_around(question(), {9.5, 1.5}, {}, 1'000'000);
    CHECK_FALSE(none.found);
    CHECK(none.demand >= 0);
  }

  TEST_CASE("questions without an answer are refused") {
    DesignQuestion none = question();
    none.varied = {};
    CHECK_THROWS_AS(admissible_designs(none, {}), InvalidArgument);
    DesignQuestion twice = question();
    twice.varied = {1, 1};
    CHECK_THROWS_AS(admissible_designs(twice, {}), InvalidArgument);
    DesignQuestion placed = question();
    placed.region.front().placed = true;
    CHECK_THROWS_AS(admissible_designs(placed, {}), InvalidArgument);
    DesignQuestion free = question();
    free.problem.characteristic_length.choice = StudyLength::Choice::kind;
    free.condition = 4.0;
    CHECK_THROWS_AS(admissible_designs(free, {}), InvalidArgument);
  }
}
