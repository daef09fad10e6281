/// domains/bound.hpp: what the loop promises of any search, and that every search which it drives ends early. Oracle of
/// the first: what is left of an interval where a function is above a bound, by bisection in one thread.

#include "domains/bound.hpp"

#include <doctest/doctest.h>

#include <chrono>
#include <cmath>
#include <functional>
#include <string>
#include <thread>

#include "ninedof/families/design_family.hpp"
#include "ninedof/proof/admissible.hpp"
#include "ninedof/proof/condition_search.hpp"
#include "ninedof/proof/optimum.hpp"
#include "ninedof/workspace/certified.hpp"
#include "support/support.hpp"

using namespace ninedof;
using namespace support;

namespace {

struct Piece {
  double low, high;
  bool operator<(const Piece& other) const { return high - low < other.high - other.low; }
};

/// Bisects [0, 1] to pieces of 2^-12 about the zeros of a polynomial; `order` has the pieces as they were merged.
template <class Open>
struct Zeros : BoxSearch {
  Open open;
  std::size_t at_once = 8;
  std::vector<double> order;
  std::stop_source* source = nullptr;  // asked to stop by a look near 0.7

  std::size_t together() const { return at_once; }
  bool enough() const { return false; }
  std::optional<bool> look(const Piece& x, const std::stop_token& stop) const {
    if (source != nullptr && x.low < 0.7 && 0.7 < x.high && x.high - x.low < 0.01) source->request_stop();
    if (stop.stop_requested()) return {};
    const double middle = 0.5 * (x.low + x.high), half = 0.5 * (x.high - x.low);
    return std::abs((middle - 0.2) * (middle - 0.7)) <= half * (1.0 + half);
  }
  void merge(const Piece& x, bool has_zero) {
    ++looked;
    order.push_back(x.low + x.high);
    const double middle = 0.5 * (x.low + x.high);
    if (!has_zero || x.high - x.low < 0x1p-12) return;
    open.push({x.low, middle});
    open.push({middle, x.high});
  }
};

template <class Open>
Zeros<Open> begun() {
  Zeros<Open> out;
  out.open.push({0.0, 1.0});
  return out;
}

Problem plates() {
  Problem out;
  out.variables = {{0.0, 60.0}, {0.0, 60.0}, {0.0, 60.0}, {0.0, 60.0}, {0.05, 80.0}, {0.05, 80.0}, {0.0, 0.0}};
  out.limits = {{.name = "radius_ratio", .high = 2.0}};
  return out;
}
PosedRobot machine() {
  Region region;
  region.size = {0.3, 0.3, 0.2};
  region.tilt = 0.1;
  return {Geometry::hexagonal(0.0, 5.8, 2.9, 0.0), neutral(4.0, 2.4), 1.0, {region}, {}, {}};
}
DesignQuestion designs(double condition) {
  DesignQuestion out;
  out.problem.family = "hexagonal";
  out.problem.variables = {{0.0, 0.0}, {2.0, 10.0}, {1.0, 5.0}, {0.0, 0.0}, {5.0, 5.0}, {3.0, 3.0}, {0.0, 0.0}};
  out.problem.limits = {{.name = "leg_length", .high = 6.6}};
  out.region = machine().region;
  out.at = {0.0, 6.0, 3.0, 0.0, 5.0, 3.0, 0.0};
  out.varied = {1, 2};
  out.low = {2.0, 1.0};
  out.high = {10.0, 5.0};
  out.condition = condition;
  return out;
}

/// A question that takes minutes, for so many seconds; whether its answer says that more is to be done.
struct Long {
  std::string name;
  std::function<bool(double seconds, const Control& control)> unfinished;
};
const std::vector<Long>& long_searches() {
  static const std::vector<Long> all{
      {"worst condition number",
       [](double seconds, const Control& control) {
         return !worst_condition(machine(), {.threads = 2, .seconds = seconds, .gap = 1e-7}, {}, control).left.empty();
       }},
      {"extremes",
       [](double seconds, const Control& control) {
         const PoseQuantity distance{.limit_name = "leg_clearance", .greatest = false, .relative = 1e-14};
         const ProofSettings settings{.threads = 2, .seconds = seconds, .boxes = 1'000'000'000};
         const Extreme found = pose_extremes(machine(), {distance}, settings, control).front();
         return found.low < found.high * (1.0 - 1e-14);
       }},
      {"admissible designs",
       [](double seconds, const Control& control) {
         return admissible_designs(designs(4.6), {.threads = 2, .seconds = seconds}, {}, control).undecided > 0.0;
       }},
      {"any admissible design",
       [](double seconds, const Control& control) {
         const DesignExistence found = any_admissible(designs(4.0), {.threads = 2, .seconds = seconds}, control);
         return found.state == DesignExistence::State::undecided && found.open > 0;
       }},
      {"class optimum",
       [](double seconds, const Control& control) {
         const OptimumSettings settings{.target = 3.7626590785, .threads = 2, .time_limit = std::max(seconds, 1e-9)};
         return !prove_optimum(plates(), settings, control).complete;
       }},
      {"non-planar optimum",
       [](double seconds, const Control& control) {
         Problem study;
         study.family = "symmetric_nonplanar";
         for (const VariableInfo& one : design_family(study.family).variables())
           study.variables.push_back({std::max(one.low, -2.0), std::min(one.high, 5.0)});
         study.limits = {{.name = "leg_ratio", .high = 2.5}, {.name = "joint_height", .high = 0.3, .of = Unit::radius}};
         const OptimumSettings settings{.target = 1.4, .threads = 2, .time_limit = std::max(seconds, 1e-9)};
         return !prove_optimum(study, settings, control).complete;
       }},
      {"certified workspace",
       [](double seconds, const Control& control) {
         WorkspaceDomain domain;
         domain.low = {-9.0, -9.0, -9.0};
         domain.high = {9.0, 9.0, 9.0};
         WorkspaceCriteria criteria;
         criteria.condition_number = 9.0;
         const CertifiedWorkspace found =
             certified_workspace(machine().geometry, domain, {}, criteria,
                                 {.gap = 1e-9, .seconds = seconds, .threads = 2, .boxes = 1'000'000'000}, {}, control);
         const bool stopped = control.stop.stop_requested();
         return found.end == (stopped ? CertifiedWorkspace::End::stopped : CertifiedWorkspace::End::time);
       }},
  };
  return all;
}

constexpr double hour = 3600.0, most_seconds = sanitized ? 60.0 : 10.0;  // on a machine that does other things too

double seconds_of(const std::function<void()>& call) {
  const auto begin = std::chrono::steady_clock::now();
  call();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

}  // namespace

TEST_SUITE("bound") {
  TEST_CASE("what is merged, and in which order, does not depend on the number of threads") {
    Zeros<OpenHeap<Piece>> one = begun<OpenHeap<Piece>>();
    bound(one, {});
    CHECK(one.open.empty());
    CHECK(one.looked > 40);
    for (const int threads : {2, 5}) {
      Zeros<OpenHeap<Piece>> other = begun<OpenHeap<Piece>>();
      bound(other, {}, threads, 3);
      CHECK(other.order == one.order);
    }
  }

  TEST_CASE("a heap gives the greatest first, a stack the last ones in their order") {
    OpenHeap<int> heap;
    OpenStack<int> stack;
    for (const int n : {3, 1, 4, 1, 5}) {
      heap.push(n);
      stack.push(n);
    }
    std::vector<int> from_heap, from_stack;
    heap.take(3, from_heap);
    stack.take(3, from_stack);
    CHECK(from_heap == std::vector{5, 4, 3});
    CHECK(from_stack == std::vector{4, 1, 5});
    CHECK(heap.size() == 2);
    CHECK(stack == std::vector{3, 1});
    stack.take(9, from_stack);
    CHECK(stack.empty());
  }

  TEST_CASE("a stop leaves open what was not looked at, and the search goes on from there to the same pieces") {
    for (const std::size_t at_once : {1, 8}) {
      CAPTURE(at_once);
      Zeros<OpenStack<Piece>> whole = begun<OpenStack<Piece>>(), part = whole;
      whole.at_once = part.at_once = at_once;
      bound(whole, {});
      std::stop_source source;
      part.source = &source;
      bound(part, {source.get_token(), {}}, 2);
      const long before = part.looked;
      CHECK(before > 0);
      CHECK(before < whole.looked);
      CHECK(!part.open.empty());
      part.source = nullptr;
      bound(part, {}, 2);
      std::ranges::sort(part.order);
      std::ranges::sort(whole.order);
      CHECK(part.order == whole.order);
    }
  }

  TEST_CASE("progress is told after every round, with what was looked at") {
    Zeros<OpenHeap<Piece>> search = begun<OpenHeap<Piece>>();
    std::vector<long> told;
    bound(search, {{}, [&](long done, long total, double value) {
                     told.push_back(done);
                     CHECK(total == 0);
                     CHECK(std::isnan(value));
                   }});
    CHECK(told.size() > 5);
    CHECK(std::ranges::is_sorted(told));
    CHECK(told.back() == search.looked);
  }

  TEST_CASE("every search ends at a stop and at the end of its time, and says that it has not finished") {
    for (const Long& search : long_searches()) {
      CAPTURE(search.name);
      bool unfinished = false;
      std::stop_source before;
      before.request_stop();
      double took = seconds_of([&] { unfinished = search.unfinished(hour, {before.get_token(), {}}); });
      CHECK(unfinished);
      CHECK(took < most_seconds);

      std::stop_source later;
      double asked = 0.0;
      const auto begin = std::chrono::steady_clock::now();
      const std::jthread asks([&] {
        std::this_thread::sleep_for(std::chrono::milliseconds(300));
        later.request_stop();
        asked = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
      });
      took = seconds_of([&] { unfinished = search.unfinished(hour, {later.get_token(), {}}); });
      CHECK(unfinished);
      CHECK(took >= 0.3);
      CHECK(took - asked < most_seconds);

      for (const double seconds : {0.0, 0.3}) {
        took = seconds_of([&] { unfinished = search.unfinished(seconds, {}); });
        CHECK(unfinished);
        CHECK(took >= seconds);
        CHECK(took - seconds < most_seconds);
      }
    }
  }
}
