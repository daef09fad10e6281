/// region_extremes.hpp: the least of functions whose least is known, on curved boundaries and in valleys; threads;
/// stops.

#include "ninedof/domains/region_extremes.hpp"

#include <doctest/doctest.h>

#include "support/support.hpp"

using namespace ninedof;
using namespace support;

namespace {

/// A linear function, a bowl about a point inside, a narrow valley across the coordinates below a cone, and no number at
/// all.
class Known : public PoseNumbers {
 public:
  Known(const Vec6& slope, const Vec6& middle) : slope_(slope), middle_(middle) {}
  std::vector<int> groups() const override { return {1, 3}; }
  void go(const Vec6& at) override { at_ = at; }
  void evaluate(int group, double* out) override {
    if (group == 0) {
      *out = slope_.dot(at_);
      return;
    }
    const Vec6 away = at_ - middle_;
    out[0] = away.squaredNorm() - 2.0;
    const double across = away[0] + away[1];
    out[1] = std::min(10.0 * across * across + away.squaredNorm(), 1.0 + 0.1 * at_.norm());
    out[2] = not_a_number;
  }

 private:
  Vec6 slope_, middle_, at_ = Vec6::Zero();
};

/// The least of a linear function over the region, by the supporting points of its factors.
double least_of(const Region& region, const Vec6& slope) {
  double out = -region.tilt * slope.segment<2>(3).norm() - region.yaw * std::abs(slope[5]);
  if (region.shape == Region::Shape::box) out -= slope.head<3>().cwiseAbs().dot(region.size);
  if (region.shape == Region::Shape::ball) out -= region.size[0] * slope.head<3>().norm();
  if (region.shape == Region::Shape::cylinder)
    out -= region.size[0] * slope.head<2>().norm() + region.size[2] * std::abs(slope[2]);
  return out;
}

}  // namespace

TEST_SUITE("region_extremes") {
  TEST_CASE("the least of a region, the same on any number of threads") {
    Random random(5);
    for (int k = 0; k < cases(24); ++k) {
      Region region;
      region.shape = std::array{Region::Shape::box, Region::Shape::ball, Region::Shape::cylinder}[at_index(k % 3)];
      region.size = Vec3(1.5, region.shape == Region::Shape::box ? 0.7 : 0.0, 0.9);
      region.tilt = 0.3;
      region.yaw = k % 2 == 0 ? 0.4 : 0.0;
      Vec6 slope = random.matrix<Vec6>(), middle = 0.2 * random.matrix<Vec6>();
      middle = region.nearest(middle);
      const auto make = [&] { return std::make_unique<Known>(slope, middle); };
      const RegionExtremes found = region_extremes(region, make, {4000, 1, 2});
      CHECK(found.least(0).value == doctest::Approx(least_of(region, slope)).epsilon(1e-9));
      CHECK((region.nearest(found.least(0).at) - found.least(0).at).norm() < 1e-14);
      CHECK(found.least(1).value == doctest::Approx(-2.0).epsilon(1e-11));
      CHECK(found.least(2).value < 1e-9);
      CHECK(found.ends[3].empty());
      CHECK(found.poses > 4000);
      const RegionExtremes again = region_extremes(region, make, {4000, 1, 1});
      CHECK(again.poses == found.poses);
      CHECK(again.least(2).value == found.least(2).value);
    }
  }

  TEST_CASE("a number that is minus infinity at a pose is the least") {
    class Singular : public Known {
      using Known::Known;
      void go(const Vec6& at) override {
        Known::go(at);
        bad_ = at[0] > 0.9;
      }
      void evaluate(int group, double* out) override {
        Known::evaluate(group, out);
        if (bad_) *out = -infinity;
      }
      bool bad_ = false;
    };
    Region region;
    region.size = Vec3(1, 1, 1);
    const auto make = [] { return std::make_unique<Singular>(Vec6::Ones(), Vec6::Zero()); };
    const RegionExtremes found = region_extremes(region, make, {1000, 0, 2});
    CHECK(found.least(0).value == -infinity);
    CHECK(found.least(0).at[0] > 0.9);
    CHECK(found.least(2).value == doctest::Approx(0.0));
  }

  TEST_CASE("no descent where none is worth while, a stop, and bad settings") {
    class Sampled : public Known {
      using Known::Known;
      std::vector<double> worthwhile(const std::vector<double>& sampled) const override {
        CHECK(sampled.size() == 4);
        return std::vector<double>(sampled.size(), -infinity);
      }
    };
    Region region;
    region.size = Vec3(1, 1, 1);
    const auto make = [] { return std::make_unique<Sampled>(Vec6::Ones(), Vec6::Zero()); };
    const RegionExtremes found = region_extremes(region, make, {100, 0, 1});
    CHECK(found.poses == 100);
    CHECK(found.least(0).value > -3.0);
    std::stop_source stop;
    stop.request_stop();
    CHECK_THROWS_AS(region_extremes(region, make, {100, 0, 1}, {stop.get_token(), {}}), Stopped);
    CHECK_THROWS_AS(region_extremes(region, make, {0, 0, 1}), InvalidArgument);
  }
}
