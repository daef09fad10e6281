/// region_study.hpp: a study over a region, against poses drawn here, limits by hand and the general path of the
/// condition number; the same bits on any number of threads; stops and time limits; means; O placed.

#include "ninedof/optimize/region_study.hpp"

#include <doctest/doctest.h>

#include <chrono>
#include <thread>

#include "ninedof/conditioning/conditioning.hpp"
#include "optimize/region/exchange.hpp"
#include "support/hand.hpp"
#include "support/studies.hpp"

using namespace ninedof;
using namespace studies;

namespace {

constexpr double passed = 1e-7;  // what is promised
constexpr long dense = 100'000;

Region box(const Vec3& size, double tilt) {
  Region out;
  out.size = size;
  out.tilt = tilt;
  return out;
}

/// Symmetric plates with every kind of limit: cones about z, strokes, clearance, determinants.
Problem machine() {
  Problem p;
  p.family = "symmetric";
  const DesignFamily& family = design_family(p.family);
  for (const auto& v : family.variables()) p.variables.push_back({v.low, v.high});
  const auto bound = [&](const char* name, double low, double high) {
    p.variables[at_index(family.index(name))] = {low, high};
  };
  bound("base_external_radius", 100.0, 500.0);
  bound("base_internal_radius", 100.0, 500.0);
  bound("platform_external_radius", 180.0, 220.0);
  bound("platform_internal_radius", 50.0, 220.0);
  bound("zp", 300.0, 700.0);
  bound("zs", 50.0, 650.0);
  p.limits = {{.name = "stroke_ratio", .high = 1.6},
              {.name = "base_cone", .high = pi / 4.0, .axis = Vec3(0.0, 0.0, 1.0)},
              {.name = "platform_cone", .high = pi / 4.0, .axis = Vec3(0.0, 0.0, -1.0)},
              {.name = "leg_clearance", .low = 20.0},
              {.name = "singularity_free", .low = 1e-3}};
  p.characteristic_length.value = 150.0;
  return p;
}
Region machine_region() {
  return box(Vec3(50.0, 50.0, 50.0), 10.0 * pi / 180.0);
}

/// A small one: hexagons with joints in pairs.
Problem small() {
  Problem p = paper_study();
  p.limits.push_back({.name = "stroke_ratio", .high = 1.4});
  return p;
}
Region small_region() {
  return box(Vec3(0.3, 0.3, 0.2), 0.1);
}

RegionStudySettings few(int starts = cases(4, 2), int threads = 2) {
  RegionStudySettings out;
  out.starts = starts;
  out.threads = threads;
  return out;
}

/// The small study, solved once for all.
const RegionResult& solved() {
  static const RegionResult result = optimize_region(small(), small_region(), few());
  return result;
}

/// Even in the box and in the disc of tilts.
Pose drawn(const Region& region, Random& random) {
  Pose out;
  for (Eigen::Index k = 0; k < 3; ++k) out.position[k] = random.uniform(-1.0, 1.0) * region.size[k];
  const double direction = random.uniform(0.0, 2.0 * pi), tilt = region.tilt * std::sqrt(random.uniform(0.0, 1.0));
  out.rotation = tilt * Vec3(std::cos(direction), std::sin(direction), 0.0);
  out.internal = out.position;  // shifted
  return out;
}

Problem at_poses(Problem p, const Region& region, int count, Random& random) {
  for (int n = 0; n < count; ++n) p.objective.poses.push_back(drawn(region, random));
  return p;
}

double condition_at(const Problem& p, const hand::Design& d, std::size_t k) {
  return ninedof::condition_number(d.geometry, d.at[k], p.characteristic_length.value);
}

bool same_bits(const RegionResult& a, const RegionResult& b) {
  return studies::same_bits(a.result, b.result) && a.region.rounds == b.region.rounds &&
         a.region.looked_at == b.region.looked_at && a.region.objective == b.region.objective &&
         a.region.margin == b.region.margin && a.region.gain == b.region.gain &&
         a.region.poses.size() == b.region.poses.size();
}

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

/// A study with O placed at every pose, and the least objective with O shifted: solved once.
struct PlacedStudy {
  Problem p;
  Region region;
  double shifted;
  RegionResult result;
};

const PlacedStudy& placed_study() {
  static const PlacedStudy placed = [] {
    const Problem p = paper_study();
    Region region = box(Vec3(0.3, 0.0, 0.0), 0.0);
    const double shifted = optimize_region(p, region, few(2)).result.candidates.front().objective;
    region.shifted = false;
    region.placed = true;
    return PlacedStudy{p, region, shifted, optimize_region(p, region, few(2))};
  }();
  return placed;
}

}  // namespace

TEST_SUITE("region_study") {
  TEST_CASE("the optimum of a machine keeps every limit at poses drawn elsewhere") {
    if (sanitized) return;  // minutes; the small study below goes the same way
    const Problem p = machine();
    const RegionResult found = optimize_region(p, machine_region(), few(64));
    CHECK(found.result.status == Status::optimal);
    REQUIRE(found.result.candidates.size() == 1);
    const Candidate& best = found.result.candidates.front();
    CHECK(std::abs(best.objective - 4.187187) < 1e-6);
    CHECK(found.region.gain <= passed);
    CHECK(found.region.margin >= -passed);
    CHECK(found.region.looked_at >= dense);
    CHECK(found.region.objective <= best.objective * (1.0 + passed));
    CHECK(best.stationary());
    CHECK(found.region.rounds <= 10);  // 12 where no pose follows the design

    Random random(29);
    const Problem drawn_poses = at_poses(p, machine_region(), 100'000, random);
    for (const Limit& limit : p.limits) {
      INFO(limit.name);
      CHECK(hand::margin(drawn_poses, limit, best.variables) >= -passed);
    }
    const hand::Design d = hand::design(drawn_poses, best.variables);
    double worst = 0.0;
    for (std::size_t k = 1; k < d.at.size(); ++k) worst = std::max(worst, condition_at(p, d, k));
    CHECK(worst <= best.objective * (1.0 + passed));
    CHECK(worst >= best.objective * (1.0 - 1e-2));  // the poses reach the corners
  }

  TEST_CASE("poses that follow do not lead from one design to another and back") {
    if (sanitized) return;  // seconds
    Problem p = machine();
    p.limits.push_back({.name = "leg_ratio", .high = 2.2100212124792233});
    const Eigen::VectorXd start{{232.968, 249.139, -pi, 204.545, -0.635152, 220.0, -0.261799, 700.0, 367.968}};
    const RegionStudySettings settings = few();
    const Region region = machine_region();
    const Control control;
    const Settled end = Exchange(p, region, settings, control).follow({{}, cover(region)}, start, nullptr);
    CHECK(end.settled);
    CHECK(end.rounds <= 12);  // 40 and no end where all poses follow in every round
    CHECK(std::abs(end.best.objective - 11.84342) < 1e-5);
  }

  TEST_CASE("no design near an optimum is better at the poses that rule") {
    const Problem p = small();
    const RegionResult& found = solved();
    REQUIRE(found.result.status == Status::optimal);
    const Candidate& best = found.result.candidates.front();
    Problem there = p;
    there.objective.poses = found.region.poses;
    const auto objective = [&](const Eigen::VectorXd& x) {
      const hand::Design d = hand::design(there, x);
      double worst = 0.0;
      for (std::size_t k = 1; k < d.at.size(); ++k) worst = std::max(worst, condition_at(p, d, k));
      return worst;
    };
    CHECK(relative_error(objective(best.variables), best.objective) < 1e-9);
    Random random(7);
    int allowed_designs = 0;
    for (int n = 0; n < cases(2000); ++n) {
      Eigen::VectorXd x = best.variables;
      const double reach = random.log_uniform(1e-6, 1e-1);
      bool inside = true;
      for (Eigen::Index k = 0; k < x.size(); ++k) {
        x[k] *= 1.0 + reach * random.normal();
        const Bounds& b = p.variables[at_index(k)];
        inside = inside && x[k] >= b.low && x[k] <= b.high;
      }
      inside = inside && x[5] < x[4];
      for (const Limit& limit : p.limits) inside = inside && hand::margin(there, limit, x) >= 0.0;
      if (!inside) continue;
      ++allowed_designs;
      CHECK(objective(x) >= best.objective * (1.0 - passed - found.region.gain));
    }
    CHECK(allowed_designs > 0);
  }

  TEST_CASE("limits that compare poses count a listed pose outside of the region too") {
    const Region region = box(Vec3(0.3, 0.2, 0.0), 0.05);
    Problem free = paper_study();
    free.objective.poses.emplace_back();  // above it: legs are longest there and shortest in the region
    free.objective.poses.back().position = free.objective.poses.back().internal = Vec3(0.0, 0.0, 0.9);
    const Eigen::VectorXd without = optimize_region(free, region, few(2)).result.candidates.front().variables;
    Random random(41);
    const Problem drawn_poses = at_poses(free, region, 2000, random);
    for (const char* name : {"stroke", "stroke_ratio", "leg_ratio"}) {
      CAPTURE(name);
      const double value = 1.0 - hand::margin(drawn_poses, {.name = name, .high = 1.0}, without);
      const Limit limit{.name = name, .high = std::string(name) == "stroke" ? 0.95 * value : 0.05 + 0.95 * value};
      Problem p = free;
      p.limits.push_back(limit);
      const RegionResult found = optimize_region(p, region, few(2));
      CAPTURE(found.result.reason);
      REQUIRE(found.result.status == Status::optimal);
      CHECK(hand::margin(drawn_poses, limit, found.result.candidates.front().variables) >= -passed);
    }
  }

  TEST_CASE("threads do not change a bit") {
    for (const int threads : {1, 3}) {
      if (sanitized && threads == 3) continue;
      CHECK(same_bits(solved(), optimize_region(small(), small_region(), few(cases(4, 2), threads))));
    }
  }

  TEST_CASE("a stop before the start leaves no design") {
    std::stop_source source;
    source.request_stop();
    const RegionResult found = optimize_region(small(), small_region(), few(), {source.get_token(), {}});
    CHECK(found.result.status == Status::stopped);
    CHECK(found.result.interrupted);
    CHECK(found.result.reason == "ended before there was a design");
  }

  TEST_CASE("a stop returns the best design so far and its gain") {
    for (const char* where : {"round 1, ", "round 2, "}) {
      std::stop_source source;
      RegionStudySettings settings = few();
      settings.phase = [&](const std::string& words) {
        if (words.starts_with(where)) source.request_stop();
      };
      const RegionResult found = optimize_region(small(), small_region(), settings, {source.get_token(), {}});
      INFO(where);
      CHECK(found.result.status == Status::stopped);
      CHECK(found.result.interrupted);
      REQUIRE(found.result.candidates.size() == 1);
      CHECK(found.result.candidates.front().objective <= solved().result.candidates.front().objective);
      const bool looked = found.region.looked_at > 0;
      CHECK(looked == (where == std::string("round 2, ")));  // nobody waits for a search after Ctrl-C
      CHECK(std::isfinite(found.region.gain) == looked);
      if (looked) CHECK(found.region.gain > passed);
    }
  }

  TEST_CASE("the end of the time returns the best design so far, searched densely") {
    const double seconds = sanitized ? 10.0 : 1.0;
    for (const char* where : {"round 1, ", "round 2, "}) {
      if (sanitized && where == std::string("round 2, ")) continue;
      RegionStudySettings settings = few();
      settings.time_limit = seconds;
      settings.phase = [&](const std::string& words) {
        if (words.starts_with(where)) std::this_thread::sleep_for(std::chrono::duration<double>(seconds));
      };
      const RegionResult found = optimize_region(small(), small_region(), settings);
      INFO(where);
      CHECK(found.result.status == Status::stopped);
      CHECK_FALSE(found.result.interrupted);
      REQUIRE(found.result.candidates.size() == 1);
      CHECK(found.region.looked_at >= dense);
      CHECK(std::isfinite(found.region.gain));
      CHECK(has(found.result.reason, "left to gain"));
      const double here = found.result.candidates.front().objective;
      CHECK(here <= solved().result.candidates.front().objective);
      CHECK(found.region.objective >= here);
    }
    RegionStudySettings at_once = few();
    at_once.time_limit = 1e-9;
    const RegionResult found = optimize_region(small(), small_region(), at_once);
    CHECK(found.result.status == Status::stopped);
    CHECK_FALSE(found.result.interrupted);
  }

  TEST_CASE("the mean is that of poses drawn elsewhere") {
    Problem p = small();
    p.objective.aggregate = Aggregate::mean_inverse;
    const RegionResult found = optimize_region(p, small_region(), few(cases(2)));
    CHECK(found.result.status == Status::optimal);
    REQUIRE(found.region.mean.has_value());
    const Candidate& best = found.result.candidates.front();
    CHECK(best.reached > 0);
    CHECK(relative_error(best.objective, found.region.mean->value) < 1e-12);
    Random random(5);
    const int count = cases(40'000);
    const hand::Design d = hand::design(at_poses(p, small_region(), count, random), best.variables);
    double sum = 0.0, squares = 0.0;
    for (std::size_t k = 1; k < d.at.size(); ++k) {
      const double inverse = 1.0 / condition_at(p, d, k);
      sum += inverse;
      squares += inverse * inverse;
    }
    const double mean = sum / count, error = std::sqrt((squares / count - mean * mean) / count);  // of the inverse
    CHECK(std::abs(1.0 / found.region.mean->value - mean) <
          5.0 * (error + found.region.mean->standard_error * mean * mean));
    for (const Limit& limit : p.limits)
      CHECK(hand::margin(at_poses(p, small_region(), cases(10'000), random), limit, best.variables) >= -passed);
  }

  TEST_CASE("a mean that is stopped while its nodes are doubled keeps its design") {
    Problem p = fixed_study({0.0, 5.8124, 2.9062, 0.0, 3.9828, 2.4435, 0.0});
    p.variables[5] = {1.0, 3.0};
    p.limits.clear();
    p.objective.aggregate = Aggregate::mean_inverse;
    const Region wide = box(Vec3(1.5, 1.5, 1.0), 0.5);
    int most = 0;
    const auto poses_in = [](const std::string& words) { return std::stoi(words.substr(words.find(" at ") + 4)); };
    RegionStudySettings settings = few(2);
    std::stop_source source;
    settings.phase = [&](const std::string& words) {
      if (most > 0 && poses_in(words) >= most + 60) source.request_stop();
      if (words.starts_with("all starts")) most = poses_in(words);
    };
    const RegionResult found = optimize_region(p, wide, settings, {source.get_token(), {}});
    REQUIRE(!found.result.candidates.empty());
    REQUIRE(source.stop_requested());
    CHECK(found.result.interrupted);
    CHECK(found.region.looked_at > 0);
    CHECK(found.region.mean.has_value());
  }

  TEST_CASE("O placed at every pose is at least as good as O shifted") {
    if (sanitized) return;  // check.cpp has one with O placed
    const auto& [p, region, shifted, found] = placed_study();
    CHECK(found.result.status == Status::optimal);
    REQUIRE(found.result.candidates.size() == 1);
    const Candidate& best = found.result.candidates.front();
    CHECK(best.objective <= shifted * (1.0 + passed));
    // At poses drawn here some O, found by trying, keeps the index.
    Random random(11);
    const DesignFamily& family = hexagonal();
    const Eigen::VectorXd own = best.variables.head(static_cast<Eigen::Index>(family.variables().size()));
    const Geometry g = family.geometry(span(own));
    for (int n = 0; n < 40; ++n) {
      const Configuration home = family.configuration(span(own));
      Configuration at = home;
      at.position.x() += random.uniform(-0.3, 0.3);
      double least = infinity;
      for (int start = 0; start < 6 && !(least <= best.objective); ++start) {
        Configuration c = at;
        c.internal_point += random.uniform(0.0, 1.0) * (at.position - home.position) + 0.2 * start * random.unit();
        double here = ninedof::condition_number(g, c);
        for (double step = 0.3; step > 1e-8; step *= 0.85)
          for (int way = 0; way < 40; ++way) {  // a kink leaves few ways down
            Configuration trial = c;
            trial.internal_point += step * random.unit();
            const double there = ninedof::condition_number(g, trial);
            if (there >= here) continue;
            here = there;
            c = trial;
          }
        least = std::min(least, here);
      }
      CHECK(least <= best.objective * (1.0 + 1e-6));
    }
  }

  TEST_CASE("an end while O is being placed returns the best design with O placed so far") {
    if (sanitized) return;
    const auto& [p, region, shifted, whole] = placed_study();
    for (const bool by_time : {false, true}) {
      std::stop_source source;
      RegionStudySettings settings = few(2);
      if (by_time) settings.time_limit = 3.0;
      settings.phase = [&](const std::string& words) {
        if (!words.starts_with("O placed, round 2")) return;
        if (by_time) std::this_thread::sleep_for(std::chrono::seconds(3));
        else source.request_stop();
      };
      const RegionResult found = optimize_region(p, region, settings, {source.get_token(), {}});
      CAPTURE(by_time);
      CHECK(found.result.status == Status::stopped);
      CHECK(found.result.interrupted == !by_time);
      CHECK(has(found.result.reason, "of placing O"));
      REQUIRE(found.result.candidates.size() == 1);
      CHECK((found.region.looked_at >= dense) == by_time);
      CHECK(std::isfinite(found.region.gain));
      CHECK(found.region.margin >= -passed);
      CHECK(found.region.objective < shifted * (1.0 - 1e-3));
      CHECK(found.region.objective >= whole.region.objective * (1.0 - passed));
    }
  }

  TEST_CASE("what no design can keep is infeasible") {
    Problem p = paper_study();
    p.limits.push_back({.name = "leg_ratio", .high = 1.01});
    const RegionResult found = optimize_region(p, box(Vec3(2.0, 2.0, 2.0), 0.2), few(2));
    CHECK(found.result.status == Status::infeasible);
    CHECK(found.result.candidates.empty());
    CHECK(contains(found.result.causes, "leg_ratio"));
  }

  TEST_CASE("settings and regions that do not fit are refused") {
    RegionStudySettings settings = few();
    settings.time_limit = 0.0;
    CHECK(refuses("time_limit", [&] { (void)optimize_region(small(), small_region(), settings); }));
    settings = few(0);
    CHECK(refuses("starts", [&] { (void)optimize_region(small(), small_region(), settings); }));
    Region wrong = small_region();
    wrong.size.x() = -1.0;
    CHECK(message_of([&] { (void)optimize_region(small(), wrong, few()); }) != "nothing thrown");
  }
}
