/// region_extremes.hpp: the least of functions whose least is known, on curved boundaries and in valleys; threads;
/// stops.

#include "ninedof/domains/region_extremes.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>

#include "support/support.hpp"

using namespace ninedof;
using namespace support;

namespace {

/// A linear function, a bowl about a point inside, a narrow valley across the coordinates below a cone, and no number
/// at all.
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

 protected:
  Vec6 slope_, middle_, at_ = Vec6::Zero();
};

/// The same with slopes of the first three.
class Sloped : public Known {
  using Known::Known;
  bool smooth(int group, int number) const override { return group == 0 || number < 2; }
  double slopes(int group, int number, const Vec6& at, Vec6& by_at) override {
    std::array<double, 3> values{};
    go(at);
    evaluate(group, values.data());
    const Vec6 away = at - middle_, diagonal = Vec6::Unit(0) + Vec6::Unit(1);
    if (group == 0) by_at = slope_;
    else if (number == 0) by_at = 2.0 * away;
    else if (values[1] == 1.0 + 0.1 * at.norm()) by_at = 0.1 * at / std::max(at.norm(), 1e-300);
    else by_at = 20.0 * diagonal.dot(away) * diagonal + 2.0 * away;
    return values[at_index(number)];
  }
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

  TEST_CASE("by slopes: as low, fewer poses, every end once, the same on any number of threads") {
    Random random(6);
    for (int k = 0; k < cases(24); ++k) {
      Region region;
      region.shape = std::array{Region::Shape::box, Region::Shape::ball, Region::Shape::cylinder}[at_index(k % 3)];
      region.size = Vec3(1.5, region.shape == Region::Shape::box ? 0.7 : 0.0, 0.9);
      region.tilt = k % 4 == 0 ? 0.0 : 0.3;
      region.yaw = 0.4;
      const Vec6 slope = random.matrix<Vec6>(), middle = region.nearest(0.2 * random.matrix<Vec6>());
      const auto make = [&] { return std::make_unique<Sloped>(slope, middle); };
      const auto plain = [&] { return std::make_unique<Known>(slope, middle); };
      const RegionExtremes found = region_extremes(region, make, {4000, 1, 2});
      CHECK(found.least(0).value == doctest::Approx(least_of(region, slope)).epsilon(1e-12));
      CHECK(found.least(1).value == doctest::Approx(-2.0).epsilon(1e-14));
      CHECK(found.least(2).value < 1e-13);
      CHECK(found.ends[0].size() == 1);  // a region is convex
      CHECK(found.ends[1].size() == 1);
      for (const std::vector<MetNumber>& ends : found.ends)
        for (const MetNumber& end : ends) CHECK((region.nearest(end.at) - end.at).norm() < 1e-14);
      CHECK(found.poses < 4000 + (region_extremes(region, plain, {4000, 1, 2}).poses - 4000) / 3);
      for (const int threads : {1, 7}) {
        const RegionExtremes again = region_extremes(region, make, {4000, 1, threads});
        CHECK(again.poses == found.poses);
        for (std::size_t n = 0; n < 3; ++n)
          CHECK(std::ranges::equal(again.ends[n], found.ends[n], [](const MetNumber& a, const MetNumber& b) {
            return a.value == b.value && a.at == b.at;
          }));
      }
    }
  }

  TEST_CASE("descents from known poses near the least, as many from samples as are asked for") {
    Region region;
    region.size = Vec3(1, 1, 1);
    const Vec6 middle = Vec6::Zero();
    const auto make = [&] { return std::make_unique<Sloped>(Vec6::Zero(), middle); };
    RegionSettings settings{1, 0, 2};  // the middle alone
    CHECK(region_extremes(region, make, settings).poses < 100);
    settings.known = {0.9 * Vec6::Unit(0), Vec6::Unit(1)};
    settings.near = 0.82;
    const RegionExtremes found = region_extremes(region, make, settings);
    CHECK(found.ends[1].size() == 1);
    CHECK(found.ends[1].front().value == doctest::Approx(-2.0).epsilon(1e-14));
    const auto constant = region_extremes(region, make, {4000, 0, 2});
    CHECK(constant.ends[0].size() == 1);  // does not change between its ends
    const auto still = [&] { return std::make_unique<Known>(Vec6::Ones(), middle); };
    CHECK(region_extremes(region, still, {.samples = 4000, .threads = 2, .most_starts = 1}).ends[2].size() == 1);
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
