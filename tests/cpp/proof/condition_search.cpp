/// condition_search.hpp: enclosures of the worst condition number, and states that another run goes on from. Oracle:
/// the condition number at poses drawn from the region.

#include "ninedof/proof/condition_search.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "ninedof/conditioning/conditioning.hpp"
#include "ninedof/math/error.hpp"
#include "support/support.hpp"

using namespace ninedof;
using namespace support;

namespace {

constexpr double gap = sanitized ? 3e-3 : 3e-4;

PosedRobot small_machine() {
  Region region;
  region.size = {0.1, 0.1, 0.05};
  region.tilt = 0.05;
  return {Geometry::hexagonal(0.0, 5.8, 2.9, 0.0), neutral(4.0, 2.4), 1.0, {region}, {}, {}};
}

ConditionSettings settings() {
  return {.gap = gap};
}

const ConditionState& wide() {
  static const ConditionState state = search_condition(small_machine(), {.gap = 0.5});
  return state;
}
const ConditionState& narrow() {
  static const ConditionState state = search_condition(small_machine(), settings());
  return state;
}

/// A machine whose joints lie on the spheres of their tolerances.
PosedRobot built_at_random(PosedRobot machine, Random& random) {
  std::array<Triple, 4> joints{machine.geometry.base_external(), machine.geometry.base_internal(),
                               machine.geometry.platform_external(), machine.geometry.platform_internal()};
  for (std::size_t k = 0; k < 12; ++k)
    joints[k / 3][k % 3] += machine.tolerances.joints[k] * random.matrix<Vec3>().normalized();
  machine.geometry = Geometry(joints[0], joints[1], joints[2], joints[3]);
  return machine;
}

double condition_at(const PosedRobot& machine, const Vec6& at) {
  Configuration c = machine.neutral;
  c.position += at.head<3>();
  c.internal_point += at.head<3>();
  const Vec3 tilt(at[3], at[4], 0.0);
  if (tilt.norm() > 0.0) c.rotation = Eigen::AngleAxisd(tilt.norm(), tilt.normalized()).toRotationMatrix();
  return condition_number(machine.geometry, c, machine.characteristic_length);
}

bool lies_in(const Vec6& at, const std::array<double, 13>& box) {
  for (std::size_t k = 0; k < 6; ++k)
    if (const double x = at[static_cast<Eigen::Index>(k)]; x < box[1 + k] || x > box[7 + k]) return false;
  return true;
}

/// What a state says, at poses drawn from the region.
void check_at_poses(const PosedRobot& machine, const ConditionState& state) {
  Random random(5);
  const Region& region = machine.region.front();
  double worst = 0.0;
  for (int n = 0; n < cases(2000); ++n) {
    const Vec6 at = region.nearest(1.2 * random.matrix<Vec6>().cwiseProduct(region.reach()));
    const double value = condition_at(machine, at);
    worst = std::max(worst, value);
    const bool left = std::ranges::any_of(state.left, [&](const auto& box) { return lies_in(at, box); });
    if (!left && state.left.size() == state.left_count) CHECK(value <= state.target * (1.0 + 1e-12));
  }
  CHECK(worst <= state.high * (1.0 + 1e-12));
  Vec6 met;
  met << state.at.shift, state.at.tilt.head<2>(), state.at.yaw;
  CHECK(condition_at(machine, met) == doctest::Approx(state.low).epsilon(1e-9));
}

bool within(const ConditionState& state, double width) {
  return state.left_count == 0 && state.low <= state.high && state.high <= state.low * (1.0 + width) * (1.0 + 1e-9);
}

}  // namespace

TEST_SUITE("condition_search") {
  TEST_CASE("the enclosure is as narrow as the gap, and a wanted bound inside of it is proved") {
    const PosedRobot machine = small_machine();
    const ConditionState& found = narrow();
    CHECK(within(found, gap));
    check_at_poses(machine, found);
    ConditionSettings bounded{.gap = 0.2, .wanted = {found.low * 1.02, found.low * 0.9, found.high * 9.0}};
    const ConditionState wanted = search_condition(machine, bounded);
    CHECK(wanted.high <= found.low * 1.02);
    CHECK(wanted.low >= found.low * (1.0 - gap));
    check_at_poses(machine, wanted);
  }

  TEST_CASE("the bound of all machines within tolerances is above that of each, and near it") {
    PosedRobot machine = small_machine();
    machine.region.front().size = {1e-4, 1e-4, 1e-4};
    machine.region.front().tilt = 0.0;
    const double drawn = search_condition(machine, {.gap = 1e-2}).low;
    Random random(6);
    for (const double off : {1e-4, 1e-3, 1e-2}) {
      machine.tolerances.joints.fill(off);
      const double first = search_condition(machine, {.gap = 0.5}).low / drawn - 1.0;  // to first order
      const double bound = drawn * (1.0 + 15.0 * first);
      const ConditionState state = search_condition(machine, {.gap = 15.0 * first});
      CAPTURE(off);
      CHECK(first > 0.1 * off);
      CHECK(state.high <= bound * (1.0 + 2.0 * first));
      double worst = 0.0;
      for (int n = 0; n < cases(300); ++n)
        worst = std::max(worst, condition_at(built_at_random(machine, random), Vec6::Zero()));
      CHECK(worst > drawn);
      CHECK(worst <= state.high);
    }
  }

  TEST_CASE("machines at poses of the region, some joints exact, are below the bound of all") {
    PosedRobot machine = small_machine();
    for (std::size_t k = 0; k < 12; ++k) machine.tolerances.joints[k] = 3e-3 * static_cast<double>(k % 3);
    const ConditionState state = search_condition(machine, {.gap = 0.02});
    CHECK(state.high < 1.2 * state.low);
    const Region& region = machine.region.front();
    Vec6 ruling;  // of the machine as drawn: about half of those built are worse there
    ruling << narrow().at.shift, narrow().at.tilt.head<2>(), narrow().at.yaw;
    Random random(7);
    double worst = 0.0;
    for (int n = 0; n < cases(3000); ++n) {
      const Vec6 drawn = region.nearest(1.5 * random.matrix<Vec6>().cwiseProduct(region.reach()));
      const Vec6& at = n % 2 == 0 ? ruling : drawn;
      worst = std::max(worst, condition_at(built_at_random(machine, random), at));
    }
    CHECK(worst > narrow().low);
    CHECK(worst <= state.high);
  }

  TEST_CASE("where no division of poses proves the gap, as much as can be is proved, and the limits are tried") {
    PosedRobot machine = small_machine();
    machine.tolerances.joints.fill(1e-2);
    const ConditionState state = search_condition(machine, {.seconds = 600.0, .gap = 1e-3});
    CHECK(state.left_count == 0);
    CHECK(state.high > state.low * 1.01);
    CHECK(state.target < state.high);
    CHECK(state.high < 1.02 * state.target);
    const double limit = 1.05 * state.high;
    const ConditionState kept =
        search_condition(machine, {.seconds = 600.0, .gap = 0.05, .wanted = {1.2 * limit, limit}});
    CHECK(kept.high <= limit);
    CHECK(kept.boxes < 20000);
  }

  TEST_CASE("of tolerances as large as the machine nothing is proved, and the search ends") {
    PosedRobot machine = small_machine();
    machine.tolerances.joints.fill(1.0);
    const ConditionState state = search_condition(machine, {.seconds = 600.0, .gap = 0.05, .wanted = {50.0}});
    CHECK(state.high == infinity);
    CHECK(state.left_count == 0);
    CHECK(state.boxes < 1000);
  }

  TEST_CASE("a bound that no division of poses proves is given up at once") {
    PosedRobot machine = small_machine();
    machine.tolerances.joints.fill(1e-3);
    const double bound = narrow().high * 1.0008;
    const ConditionState state = search_condition(machine, {.seconds = 600.0, .gap = 0.5, .wanted = {bound}});
    CHECK(state.left_count == 0);
    CHECK(state.low < bound);
    CHECK(state.high > bound);
    CHECK(state.boxes < 2000);
    CHECK(within(search_condition(machine, {.gap = 0.1}), 0.1));  // others are proved
  }

  TEST_CASE("a state that has the gap stays as it is, and a wider one is narrowed") {
    const PosedRobot machine = small_machine();
    const ConditionState narrowed = search_condition(machine, settings(), wide());
    CHECK(within(narrowed, gap));
    CHECK(narrowed.boxes > wide().boxes);
    const ConditionState again = search_condition(machine, settings(), narrowed);
    CHECK(again.boxes == narrowed.boxes);
    CHECK(again.low == narrowed.low);
    CHECK(again.high == narrowed.high);
  }

  TEST_CASE("a search comes to its end from every state that it keeps") {
    const PosedRobot machine = small_machine();
    ConditionSettings sliced = settings();
    sliced.slice_seconds = sliced.least_seconds = 0.02;
    sliced.keep_share = 0.0;
    std::vector<ConditionState> kept;
    const auto keep = [&](const ConditionState& state) { kept.push_back(state); };
    const ConditionState found = search_condition(machine, sliced, {}, keep);
    CHECK(within(found, gap));
    REQUIRE(!kept.empty());
    for (std::size_t k = 0; k < kept.size(); k += std::max<std::size_t>(kept.size() - 1, 1)) {
      const ConditionState& part = kept[k];
      CHECK(part.left_count == part.left.size());
      CHECK(part.left_count > 0);
      CHECK(part.low <= found.low);
      CHECK(part.high >= found.high);
      check_at_poses(machine, part);
      const ConditionState end = search_condition(machine, settings(), part);
      CHECK(within(end, gap));
      CHECK(end.boxes > part.boxes);
      CHECK(end.low <= found.high);
      CHECK(found.low <= end.high);
    }
  }

  TEST_CASE("a stop leaves a state, also one between two searches") {
    const PosedRobot machine = small_machine();
    std::stop_source source;
    long last = 0;
    const auto stop_at = [&](long boxes) {
      return Control{source.get_token(), [&, boxes](long done, long, double) {
                       CHECK(done >= last);  // of all searches together
                       last = done;
                       if (done > boxes) source.request_stop();
                     }};
    };
    const ConditionState stopped = search_condition(machine, settings(), {}, {}, stop_at(100));
    CHECK(stopped.interrupted);
    CHECK(stopped.boxes > 100);
    check_at_poses(machine, stopped);
    const ConditionState held = search_condition(machine, settings(), wide(), {}, {source.get_token(), {}});
    CHECK(held.interrupted);
    CHECK(held.left_count == 0);  // no box was looked at: what was proved stays
    CHECK(held.high < infinity);
    const ConditionState end = search_condition(machine, settings(), stopped);
    CHECK(!end.interrupted);
    CHECK(within(end, gap));
  }

  TEST_CASE("a stop ends the search for the worst pose, too, that comes before the proof") {
    std::stop_source source;
    source.request_stop();
    const WorstOverPoses stopped = worst_condition(small_machine(), {}, {}, {source.get_token(), {}});
    const WorstOverPoses searched = worst_condition(small_machine(), {.seconds = 0.0});
    CHECK(stopped.interrupted);
    CHECK(stopped.extreme.low > 1.0);
    CHECK(stopped.extreme.low < searched.extreme.low);
  }

  TEST_CASE("more boxes than a state holds are those that the search began with") {
    const PosedRobot machine = small_machine();
    std::array<double, 13> all{};
    const Vec6 reach = machine.region.front().reach();
    for (std::size_t k = 0; k < 6; ++k) {
      all[7 + k] = reach[static_cast<Eigen::Index>(k)];
      all[1 + k] = -all[7 + k];
    }
    ConditionState begun;
    begun.low = narrow().low;
    begun.left = {all};
    begun.left_count = 1;
    begun.target = begun.low * (1.0 + 1e-8);  // out of reach in that time
    ConditionSettings hurried{.seconds = 0.0, .gap = 1e-9, .least_seconds = 0.1, .most_left = 1};
    const ConditionState left = search_condition(machine, hurried, begun);
    CHECK(left.boxes > 1);
    CHECK(left.left == begun.left);
    CHECK(left.left_count == 1);
    CHECK(left.target == begun.target);
  }

  TEST_CASE("boxes of other poses are refused") {
    PosedRobot machine = small_machine();
    ConditionState other;
    other.left = {{0.0, -1.0, -1.0, -1.0, -1.0, -1.0, -1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0}};
    CHECK_THROWS_WITH_AS(search_condition(machine, settings(), other), doctest::Contains("boxes"), InvalidArgument);
    other.left = {{std::nan("")}};
    CHECK_THROWS_AS(search_condition(machine, settings(), other), InvalidArgument);
  }
}
