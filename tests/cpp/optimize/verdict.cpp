/// optimize.hpp: results other than an optimum, progress, stopping, and invalid arguments.

#include <doctest/doctest.h>

#include <chrono>
#include <mutex>
#include <thread>

#include "ninedof/optimize/optimize.hpp"
#include "support/studies.hpp"

using namespace studies;
using ninedof::Control;
using ninedof::optimize;

namespace {

/// Infeasible, all `causes` among those named, and indeed no design drawn by chance is allowed.
void check_infeasible(const Problem& p, const std::vector<std::string>& causes) {
  const Result r = optimize(p, {.starts = 16});
  CAPTURE(r.reason);
  CHECK(r.status == Status::infeasible);
  CHECK(r.candidates.empty());
  for (const std::string& name : causes) {
    CAPTURE(name);
    CHECK(contains(r.causes, name));
    CHECK(r.reason.find(name) != std::string::npos);
  }
  Random random(161);
  for (int n = 0; n < 2000; ++n) {
    Eigen::VectorXd x(7);
    for (std::size_t k = 0; k < 7; ++k)
      x[static_cast<Eigen::Index>(k)] = random.uniform(p.variables[k].low, std::min(1e3, p.variables[k].high));
    CHECK_FALSE(allowed(p, x));
  }
}

}  // namespace

TEST_SUITE("verdict") {
  TEST_CASE("status words") {
    CHECK(std::string(to_string(Status::optimal)) == "optimal");
    CHECK(std::string(to_string(Status::unbounded)) == "unbounded");
    CHECK(std::string(to_string(Status::infeasible)) == "infeasible");
    CHECK(std::string(to_string(Status::stopped)) == "stopped");
  }

  TEST_CASE("eqs. (8)-(9) alone are unbounded: the base and both heights grow") {
    for (const double most : {infinity, 1e9}) {
      const Result r = optimize(open_study(most, most));
      CAPTURE(r.reason);
      CHECK(r.status == Status::unbounded);
      CHECK((contains(r.causes, "a2") || contains(r.causes, "a1")));
      CHECK(contains(r.causes, "zp"));
      CHECK(contains(r.causes, "zs"));
      CHECK_FALSE(contains(r.causes, "theta_z"));
      for (const std::string& name : r.causes) CHECK(r.reason.find(name) != std::string::npos);
      REQUIRE(!r.candidates.empty());
      CHECK(r.candidates.front().condition_number < 2.5633);  // past the best of all designs with sides up to 1000
      CHECK(r.candidates.front().condition_number > 2.5358);  // never below the infimum
    }
  }

  TEST_CASE("no upper bounds, but a ratio that limits the base: optimal") {
    Problem p = open_study(infinity, infinity);
    p.limits = paper_study().limits;
    const Result r = optimize(p);
    CHECK(r.status == Status::optimal);
    REQUIRE(!r.candidates.empty());
    CHECK(std::abs(r.candidates.front().condition_number - paper_optimum) <= 1e-6);
  }

  TEST_CASE("finite sides are bounds, however large: heights without bounds stay finite") {
    // With sides up to 1e5 the optimum is 2.53645, at heights of about a quarter of the base.
    const Result r = optimize(open_study(1e5, infinity));
    CAPTURE(r.reason);
    CHECK(r.status == Status::optimal);
    REQUIRE(!r.candidates.empty());
    CHECK(std::abs(r.candidates.front().condition_number - 2.53645) <= 1e-5);
  }

  TEST_CASE("eqs. (8)-(9) stay unbounded when the heights start at tens of thousands") {
    Problem p = open_study(infinity, infinity);
    p.variables[4].low = p.variables[5].low = 15000.0;  // a robot in millimetres, say, with l_c left at 1
    const Result r = optimize(p);
    CAPTURE(r.reason);
    CHECK(r.status == Status::unbounded);
  }

  TEST_CASE("infeasible: limits that contradict each other, the bounds, or the order of zs and zp") {
    Problem p = paper_study();
    p.limits = {{"radius_ratio", 0.0, 2.0}, {"radius_ratio", 3.0, 10.0}};
    check_infeasible(p, {"radius_ratio"});
    Settings brief;
    brief.explain = false;
    const Result unexplained = optimize(p, brief);
    CHECK(unexplained.status == Status::infeasible);
    CHECK(unexplained.causes.empty());

    p = paper_study();  // base at least 10, platform at most 1
    p.variables[1].low = 10.0;
    p.variables[2] = p.variables[3] = {0.1, 1.0};
    check_infeasible(p, {"radius_ratio", "a2", "b1", "b2"});

    p = paper_study();
    p.limits = {{.name = "leg_ratio", .high = 0.5}};
    check_infeasible(p, {"leg_ratio"});

    p = paper_study();
    p.variables[4] = {1.0, 2.0};
    p.variables[5] = {3.0, 4.0};
    check_infeasible(p, {"zs", "zp", "zp > zs"});

    p = paper_study();
    p.variables[4] = p.variables[5] = {2.0, 2.0};
    check_infeasible(p, {"zp > zs"});

    p = paper_study();
    p.limits = {{.name = "zs_fraction", .low = 1.5}};
    check_infeasible(p, {"zs_fraction"});
  }

  TEST_CASE("infeasible: the limit and the bound, and no other variable") {
    Problem p = paper_study();
    p.limits = {{.name = "height", .low = 5.0}};
    p.variables[4] = {1.0, 4.0};
    CHECK(optimize(p, {.starts = 4}).causes == std::vector<std::string>{"height", "zp"});
  }

  TEST_CASE("all variables fixed: the design itself") {
    Problem p = fixed_study({0.0, 6.0, 3.0, 0.0, 5.0, 3.0, 0.0});
    const Result r = optimize(p);
    CHECK(r.status == Status::optimal);
    REQUIRE(r.candidates.size() == 1);
    CHECK(r.candidates.front().variables == Eigen::VectorXd{{0, 6, 3, 0, 5, 3, 0}});
    CHECK(relative_error(r.candidates.front().condition_number,
                         studies::condition_number(p, r.candidates.front().variables)) <= 64.0 * eps);

    p = fixed_study({0.0, 6.5, 3.0, 0.0, 5.0, 3.0, 0.0});
    check_infeasible(p, {"radius_ratio"});
  }

  TEST_CASE("zs just below zp is feasible: the order has no minimum distance") {
    for (const double gap : {1e-3, 1e-6, 1e-9}) {
      CAPTURE(gap);
      const Problem p = fixed_study({0.0, 6.0, 3.0, 0.0, 5.0, 5.0 - gap, 0.0});
      const Result r = optimize(p);
      CHECK(r.status == Status::optimal);
      REQUIRE(!r.candidates.empty());
      const double kappa = studies::condition_number(p, r.candidates.front().variables);
      CHECK(relative_error(r.candidates.front().condition_number, kappa) <= 64.0 * eps * kappa);
    }
  }

  TEST_CASE("a singular design is never optimal, and its condition number is infinite") {
    Problem flat = open_study(10.0, 10.0);
    flat.variables[5] = {0.0, 0.0};
    Problem similar = open_study(10.0, 10.0);
    similar.variables[0] = similar.variables[2] = {0.0, 0.0};  // two triangles alike
    for (const Problem& p : {fixed_study({1.0, 2.0, 0.5, 1.0, 5.0, 3.0, 0.0}),  // similar hexagons
                             fixed_study({1.0, 2.0, 1.5, 1.0, 5.0, 0.0, 0.0}),  // O in the base
                             flat, similar}) {
      const Result r = optimize(p);
      CAPTURE(r.reason);
      CHECK(r.status != Status::optimal);
      CHECK(r.status != Status::unbounded);
      for (const Candidate& c : r.candidates) CHECK_FALSE(std::isfinite(c.condition_number));
    }
    CHECK(refuses("a1, a2", [] { optimize(fixed_study({0.0, 0.0, 1.5, 1.0, 5.0, 3.0, 0.0})); }));
  }

  TEST_CASE("infeasible by the architecture: the reason names the class") {
    Problem general;
    general.family = "general";
    const ninedof::DesignFamily& family = ninedof::design_family("general");
    for (const ninedof::VariableInfo& v : family.variables()) general.variables.push_back({v.low, v.low});
    const auto set = [&](const std::string& name, double value) {
      general.variables[static_cast<std::size_t>(family.index(name))] = {value, value};
    };
    set("zp", 4.0);
    set("zs", 2.0);
    REQUIRE(optimize(general).status == Status::optimal);
    const Problem sound = general;
    for (const char* axis : {"x", "y", "z"})
      for (const char* plate : {"base", "platform"}) {
        const std::string joint = std::string(plate) + "_external_";
        const auto& first = general.variables[static_cast<std::size_t>(family.index(joint + "1_" + axis))];
        set(joint + "2_" + axis, first.low);
      }
    CHECK(optimize(general).reason.find("external legs 1 and 2 with the same joints") != std::string::npos);
    general = sound;
    for (const char* joint : {"1", "2", "3"}) set(std::string("base_internal_") + joint + "_y", 0.0);
    CHECK(optimize(general).reason.find("det B is 0 at every pose") != std::string::npos);
    const Result similar = optimize(fixed_study({1.0, 2.0, 0.5, 1.0, 5.0, 3.0, 0.0}));
    CHECK(similar.reason.find("similar and, at the orientation of the pose, parallel") != std::string::npos);
    const Result flat = optimize(fixed_study({1.0, 2.0, 1.5, 1.0, 5.0, 0.0, 0.0}));
    CHECK(flat.reason.find("architecture") == std::string::npos);
  }

  TEST_CASE("too few evaluations: stopped, with the best feasible design found") {
    const Result r = optimize(paper_study(), {.starts = 8, .max_evaluations = 3});
    CHECK(r.status == Status::stopped);
    CHECK(!r.reason.empty());
    REQUIRE(!r.candidates.empty());  // error.hpp: the best point found is returned as such
    CHECK(allowed(paper_study(), r.candidates.front().variables, 1e-8));
  }

  TEST_CASE("stopped before the first start: no candidate") {
    std::stop_source source;
    source.request_stop();
    const Result r = optimize(paper_study(), {}, {.stop = source.get_token(), .progress = {}});
    CHECK(r.status == Status::stopped);
    CHECK(r.starts_done == 0);
    CHECK(r.candidates.empty());
  }

  TEST_CASE("stopped among very many starts: returns the best so far within a fifth of a second") {
    using clock = std::chrono::steady_clock;
    std::vector<Problem> problems{paper_study(), open_study(infinity, infinity)};
    for (const Problem& p : problems) {
      std::stop_source source;
      clock::time_point asked;
      const std::jthread impatient([&] {
        std::this_thread::sleep_for(std::chrono::milliseconds(60));
        asked = clock::now();
        source.request_stop();
      });
      const Result r = optimize(p, {.starts = 200'000}, {.stop = source.get_token(), .progress = {}});
      CHECK(clock::now() - asked < std::chrono::milliseconds(200));
      CHECK(r.status == Status::stopped);
      CHECK(r.starts_done > 0);
      CHECK(r.starts_done < 200'000);
      CAPTURE(r.reason);
      REQUIRE(!r.candidates.empty());
      CHECK(allowed(p, r.candidates.front().variables, 1e-8));
    }
  }

  TEST_CASE("progress: every start is counted once, the best never rises, one call at a time") {
    for (const int threads : {1, 3}) {
      long last = 0;
      double best = infinity;
      std::atomic<int> inside = 0;
      Control control;
      control.progress = [&](long done, long total, double now) {
        CHECK(++inside == 1);
        CHECK(done == last + 1);
        CHECK(total == 40);
        CHECK(now <= best);
        last = done;
        best = now;
        --inside;
      };
      const Result r = optimize(paper_study(), {.starts = 40, .threads = threads}, control);
      CHECK(last == 40);
      CHECK(best == doctest::Approx(r.candidates.front().condition_number).epsilon(1e-12));
    }
    long last = 0, total = 0;
    Control control;
    control.progress = [&](long done, long all, double) { last = done, total = all; };
    optimize(fixed_study({0.0, 6.0, 3.0, 0.0, 5.0, 3.0, 0.0}), {}, control);
    CHECK(last == total);
  }

  TEST_CASE("an exception in progress ends the run and is passed on") {
    Control control;
    control.progress = [](long done, long, double) {
      if (done == 5) throw std::runtime_error("enough");
    };
    CHECK_THROWS_WITH_AS(optimize(paper_study(), {.threads = 2}, control), "enough", std::runtime_error);
  }

  TEST_CASE("invalid problems and settings throw, naming the argument") {
    const auto refused = [](const std::string& name, const auto& change) {
      Problem p = paper_study();
      change(p);
      return refuses(name, [&] { optimize(p); }) && refuses(name, [&] { p.validate(); });
    };
    CHECK(refused("family", [](Problem& p) { p.family = "round"; }));
    for (const double bad : {0.0, -1.0, not_a_number, infinity})
      CHECK(refused("characteristic_length", [&](Problem& p) { p.characteristic_length.value = bad; }));
    CHECK(refused("variables", [](Problem& p) { p.variables.pop_back(); }));
    CHECK(refused("variables", [](Problem& p) { p.variables.clear(); }));
    CHECK(refused("zp", [](Problem& p) { p.variables[4] = {2.0, 1.0}; }));
    CHECK(refused("a1", [](Problem& p) { p.variables[0] = {-1.0, 1.0}; }));
    CHECK(refused("a1", [](Problem& p) { p.variables[0] = {not_a_number, 1.0}; }));
    CHECK(refused("b2", [](Problem& p) { p.variables[3] = {0.0, not_a_number}; }));
    CHECK(refused("b2", [](Problem& p) { p.variables[3] = {infinity, infinity}; }));
    CHECK(refused("theta_z", [](Problem& p) { p.variables[6] = {-infinity, -infinity}; }));
    CHECK(refused("constraints", [](Problem& p) { p.limits.push_back({.name = "weight", .high = 1.0}); }));
    CHECK(refused("leg_ratio", [](Problem& p) { p.limits.push_back({"leg_ratio", 3.0, 2.0}); }));
    CHECK(refuses("starts", [] { optimize(paper_study(), {.starts = 0}); }));
    CHECK(refuses("max_evaluations", [] { optimize(paper_study(), {.max_evaluations = 0}); }));
  }
}
