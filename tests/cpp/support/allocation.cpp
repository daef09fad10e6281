/// Hot calls do not allocate. Counted where all of it passes: in malloc, which this file replaces in the test
/// executable (operator new and Eigen's aligned arrays end there). Under a sanitizer malloc is the sanitizer's own, to
/// be replaced by nobody, and off glibc there is no other allocator to hand on to: there these tests are skipped and
/// say so.

#include <doctest/doctest.h>

#include <atomic>
#include <cstdlib>
#include <vector>

#include "math/linear/svd6.hpp"
#include "ninedof/conditioning/conditioning.hpp"
#include "ninedof/conditioning/hexapod.hpp"
#include "ninedof/conditioning/sensitivity.hpp"
#include "ninedof/conditioning/symmetric.hpp"
#include "ninedof/families/design_family.hpp"
#include "ninedof/kinematics/acceleration.hpp"
#include "ninedof/kinematics/velocity.hpp"
#include "ninedof/position/forward_position.hpp"
#include "ninedof/position/tracking.hpp"
#include "ninedof/robot/legs.hpp"
#include "ninedof/singularity/singularity.hpp"
#include "ninedof/statics/accuracy.hpp"
#include "ninedof/statics/ellipsoid.hpp"
#include "ninedof/statics/statics.hpp"
#include "support/rotation_problems.hpp"
#include "support/support.hpp"

using namespace ninedof;
using namespace support;

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define NINEDOF_SANITIZED
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer) || __has_feature(memory_sanitizer)
#define NINEDOF_SANITIZED
#endif
#endif

#if defined(__GLIBC__) && !defined(NINEDOF_SANITIZED)
#define NINEDOF_COUNTS true
namespace {
std::atomic<long> allocations = 0;
}
extern "C" {
void* __libc_malloc(std::size_t);  // glibc's own names
void* __libc_calloc(std::size_t, std::size_t);
void* __libc_realloc(void*, std::size_t);
void* __libc_memalign(std::size_t, std::size_t);
[[gnu::visibility("default")]] void* malloc(std::size_t size) noexcept {
  ++allocations;
  return __libc_malloc(size);
}
[[gnu::visibility("default")]] void* calloc(std::size_t count, std::size_t size) noexcept {
  ++allocations;
  return __libc_calloc(count, size);
}
[[gnu::visibility("default")]] void* realloc(void* old, std::size_t size) noexcept {
  ++allocations;
  return __libc_realloc(old, size);
}
[[gnu::visibility("default")]] void* aligned_alloc(std::size_t alignment, std::size_t size) noexcept {
  ++allocations;
  return __libc_memalign(alignment, size);
}
[[gnu::visibility("default")]] int posix_memalign(void** out, std::size_t alignment, std::size_t size) noexcept {
  ++allocations;
  *out = __libc_memalign(alignment, size);
  return *out == nullptr ? 12 : 0;  // ENOMEM
}
}
#else
#define NINEDOF_COUNTS false
namespace {
const long allocations = 0;
}
#endif

namespace {

/// Allocations made by ten calls.
long allocations_of(const std::invocable auto& call) {
  const long before = allocations;
  for (int n = 0; n < 10; ++n) call();
  return allocations - before;
}

/// Keeps a result alive under the optimizer.
template <class T>
void keep(const T& value) {
  asm volatile("" : : "r"(&value) : "memory");
}

}  // namespace

TEST_SUITE("allocation") {
  TEST_CASE("whether allocations can be counted here") {
    if (!NINEDOF_COUNTS) MESSAGE("not counted: built with a sanitizer, which brings its own malloc, or without glibc");
    CHECK(true);
  }

  TEST_CASE("the count sees malloc, new, and Eigen's arrays" * doctest::skip(!NINEDOF_COUNTS)) {
    CHECK(allocations_of([] {
            void* p = std::malloc(100);
            keep(p);
            std::free(p);
          }) == 10);
    CHECK(allocations_of([] { keep(std::vector<double>(100)); }) == 10);
    CHECK(allocations_of([] { keep(Eigen::VectorXd(100)); }) == 10);
    CHECK(allocations_of([] { keep(Vec9::Zero().eval()); }) == 0);
  }

  TEST_CASE("general path: legs, Jacobian, velocity, acceleration, conditioning, singular or not" *
            doctest::skip(!NINEDOF_COUNTS)) {
    Random random(181);
    Robot singular = random_robot(random);
    singular.configuration.internal_point = singular.geometry.base_internal()[0];
    const Vec9 rates = random.matrix<Vec9>(), weights = rates.cwiseAbs();
    for (const Robot& robot : {random_robot(random), random_symmetric_robot(random), singular}) {
      const auto& [g, c] = robot;
      CHECK(allocations_of([&] { keep(legs(g, c)); }) == 0);
      CHECK(allocations_of([&] { keep(leg_lengths(g, c)); }) == 0);
      CHECK(allocations_of([&] { keep(jacobian(g, c, 0.7)); }) == 0);
      CHECK(allocations_of([&] { keep(velocity_matrices(g, c, 0.7)); }) == 0);
      CHECK(allocations_of([&] { keep(forward_velocity(g, c, rates)); }) == 0);
      const Velocity v{rates.head<3>(), rates.segment<3>(3), rates.tail<3>()};
      CHECK(allocations_of([&] { keep(inverse_velocity(g, c, v)); }) == 0);
      CHECK(allocations_of([&] { keep(internal_velocity(g, c, v.omega, v.pdot, weights)); }) == 0);
      CHECK(allocations_of([&] { keep(null_motion(g, c)); }) == 0);
      CHECK(allocations_of([&] { keep(forward_acceleration(g, c, rates, weights)); }) == 0);
      CHECK(allocations_of([&] { keep(inverse_acceleration(g, c, v, {v.omega, v.pdot, v.sdot})); }) == 0);
      CHECK(allocations_of([&] { keep(jacobian_rate(g, c, v, 0.7)); }) == 0);
      CHECK(allocations_of([&] { keep(conditioning_matrix(g, c, 0.7)); }) == 0);
      CHECK(allocations_of([&] { keep(singular_values(g, c, 0.7)); }) == 0);
      CHECK(allocations_of([&] { keep(condition_number(g, c, 0.7)); }) == 0);
      CHECK(allocations_of([&] { keep(condition_number(g, c, 0.7, Norm::frobenius)); }) == 0);
      CHECK(allocations_of([&] { keep(manipulability(g, c)); }) == 0);
      CHECK(allocations_of([&] { keep(isotropy_residual(g, c)); }) == 0);
      CHECK(allocations_of([&] { keep(singularity_margins(g, c)); }) == 0);
      CHECK(allocations_of([&] { keep(singularity(g, c)); }) == 0);
      CHECK(allocations_of([&] { keep(distance_to_singularity(g, c, rates)); }) == 0);
      CHECK(allocations_of([&] { keep(plus(c, rates)); }) == 0);
      CHECK(allocations_of([&] { keep(minus(c, plus(c, rates))); }) == 0);
    }
    const Mat6 m = random.matrix<Mat6>();
    CHECK(allocations_of([&] { keep(singular_values_6x6(m)); }) == 0);
  }

  TEST_CASE("direct position analysis, by either method" * doctest::skip(!NINEDOF_COUNTS)) {
    Random random(184);
    const auto [g, c] = random_robot(random);
    const Vec9 lengths = leg_lengths(g, plus(c, 0.01 * random.matrix<Vec9>()));
    for (const RotationMethod method : {RotationMethod::elimination, RotationMethod::null_space})
      CHECK(allocations_of([&] { keep(forward_position(g, lengths, method)); }) == 0);
    const Tracker tracker(g);
    CHECK(allocations_of([&] { keep(tracker(lengths, c)); }) == 0);
  }

  TEST_CASE("statics, accuracy and ellipsoids, singular or not" * doctest::skip(!NINEDOF_COUNTS)) {
    Random random(184);
    Robot singular = random_robot(random);
    singular.configuration.internal_point = singular.geometry.base_internal()[0];
    Tolerances t;
    t.legs.setConstant(1e-3);
    for (const Robot& robot : {random_robot(random), singular}) {
      const auto& [g, c] = robot;
      const Load load{Vec3::Ones(), Vec3::Ones(), Vec3::Ones()};
      CHECK(allocations_of([&] { keep(leg_forces(g, c, load)); }) == 0);
      CHECK(allocations_of([&] { keep(self_stress(g, c)); }) == 0);
      CHECK(allocations_of([&] { keep(stiffness(g, c, Vec9::Ones())); }) == 0);
      CHECK(allocations_of([&] { keep(error_bounds(g, c, t)); }) == 0);
      CHECK(allocations_of([&] { keep(velocity_ellipsoid(g, c)); }) == 0);
      CHECK(allocations_of([&] { keep(velocity_ellipsoid(g, c, TwistPart::rotation)); }) == 0);
    }
  }

  TEST_CASE("closed form, plain and with gradients" * doctest::skip(!NINEDOF_COUNTS)) {
    Random random(182);
    const auto [g, c] = random_symmetric_robot(random);
    const AxisDesign<double> d = axis_design(g, c);
    CHECK(allocations_of([&] { keep(axis_spectrum(d, 0.7)); }) == 0);
    using D = Dual<3>;
    const auto point = [](const Xyz<double>& p) { return Xyz<D>{p.x, p.y, D::variable(p.z, 0)}; };
    const AxisDesign<D> dual{point(d.base_external),     point(d.base_internal), point(d.platform_external),
                             point(d.platform_internal), D::variable(d.zp, 1),   D::variable(d.zs, 2)};
    CHECK(allocations_of([&] { keep(axis_spectrum(dual, 0.7)); }) == 0);
  }

  TEST_CASE("derivatives by points, singular vectors with them" * doctest::skip(!NINEDOF_COUNTS)) {
    Random random(183);
    const auto [g, c] = random_robot(random);
    CHECK(allocations_of([&] {
            const Points at = points(g, c);
            const NineLegs legs = nine_legs(at);
            const Spectrum s = spectrum(at, legs, 0.7);
            PointGradient out = zero_gradient();
            for (int k = 0; k < 6; ++k) add_spectrum_gradient(at, legs, s, 0, k, 1.0, out);
            keep(out);
          }) == 0);
    const Mat6 m = random.matrix<Mat6>();
    CHECK(allocations_of([&] { keep(right_svd_6x6(m)); }) == 0);
  }

  TEST_CASE("rotation problems" * doctest::skip(!NINEDOF_COUNTS)) {
    Random random(184);
    const Triple d = random_directions(random), w = random_directions(random);
    const Mat3 q = random.rotation();
    for (const RotationProblem& p : {solved_by(q, d, w), solved_by(q, d, {w[0], w[0], w[0]})}) {
      CHECK(allocations_of([&] { keep(null_space_rotations(p)); }) == 0);
      CHECK(allocations_of([&] { keep(polish_rotation(p, Mat3::Identity())); }) == 0);
    }
  }

  TEST_CASE("design families: blueprints and the axis" * doctest::skip(!NINEDOF_COUNTS)) {
    for (const std::string& name : design_family_names()) {
      const DesignFamily& family = design_family(name);
      Eigen::VectorXd x = Eigen::VectorXd::Ones(static_cast<Eigen::Index>(family.variables().size()));
      x[family.index("zp")] = 2.0;
      const std::span<const double> variables{x.data(), family.variables().size()};
      Blueprint blueprint;
      CHECK(allocations_of([&] { family.blueprint(variables, blueprint); }) == 0);
      if (!family.symmetric()) continue;
      AxisPoint point;
      for (const Machine machine : {Machine::nine_legged, Machine::six_legged})
        CHECK(allocations_of([&] { family.axis(variables, 1.0, {}, machine, point); }) == 0);
    }
  }
}
