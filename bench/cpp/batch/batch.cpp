#include "ninedof/batch/batch.hpp"

#include <benchmark/benchmark.h>

#include <memory>
#include <string>

#include "support/baseline.hpp"
#include "support/data.hpp"
#include "support/figure.hpp"

namespace bench {
namespace {

/// Long stacks: the overhead of a call is not measured.
constexpr std::size_t pieces = 4, stack_size = 4096;

/// A stack of poses of one robot, in the memory layout of the batch functions.
struct Stack {
  ninedof::Geometry geometry;
  std::vector<ninedof::Configuration> poses;
  std::vector<double> position, rotation, internal_point;
  mutable std::vector<double> out;

  ninedof::batch::Configurations view() const {
    return {position.data(), rotation.data(), internal_point.data(), static_cast<long>(poses.size())};
  }
};
using Stacks = std::shared_ptr<const std::vector<Stack>>;

/// Hexagonal and general robots in turn.
Stacks stacks() {
  Random random(4);
  auto all = std::make_shared<std::vector<Stack>>();
  for (std::size_t piece = 0; piece < pieces; ++piece) {
    Stack s{random_geometry(random, piece % 2 == 0), {}, {}, {}, {}, std::vector<double>(9 * stack_size)};
    for (std::size_t k = 0; k < stack_size; ++k) {
      const ninedof::Configuration c = near_home(random);
      s.poses.push_back(c);
      s.position.insert(s.position.end(), c.position.begin(), c.position.end());
      const Eigen::Matrix<double, 3, 3, Eigen::RowMajor> q = c.rotation;
      s.rotation.insert(s.rotation.end(), q.data(), q.data() + 9);
      s.internal_point.insert(s.internal_point.end(), c.internal_point.begin(), c.internal_point.end());
    }
    all->push_back(std::move(s));
  }
  return all;
}

const double* conditions(const Stack& s) {
  ninedof::batch::condition_numbers(s.geometry, s.view(), {&length, 0}, ninedof::Norm::two, s.out.data());
  return s.out.data();
}
const double* lengths(const Stack& s) {
  ninedof::batch::leg_lengths(s.geometry, s.view(), s.out.data());
  return s.out.data();
}

template <class Batch, class Single>
Figure figure(const std::string& name, const std::string& baseline, const Stacks& data, Batch batch, Single single,
              Target target = {}) {
  return {name + ", a stack (" + ninedof::batch::simd_level() + ")",
          baseline,
          pieces,
          stack_size,
          [data, batch](std::size_t block) { benchmark::DoNotOptimize(batch((*data)[block])); },
          [data, single](std::size_t block) {
            const Stack& s = (*data)[block];
            for (const ninedof::Configuration& c : s.poses) benchmark::DoNotOptimize(single(s.geometry, c));
          },
          std::move(target)};
}

Target nanoseconds(double most) {
  return {ninedof::format_number(most) + " ns", [most](const Times& t) { return t.ours_median <= most; }};
}

}  // namespace

Figures batch() {
  const Stacks data = stacks();
  const auto plain_condition = [](const auto& g, const auto& c) { return plain::condition_number(g, c, length); };
  for (const Stack& s : *data) {
    for (std::size_t k = 0; k < stack_size; ++k) {
      const double kappa = plain_condition(s.geometry, s.poses[k]);
      require_close("condition number of a stack", conditions(s)[k], kappa, 1e-13 * kappa * kappa);
      const ninedof::Vec9 l = plain::leg_lengths(s.geometry, s.poses[k]);
      for (std::size_t j = 0; j < 9; ++j)
        require_close("leg length of a stack", lengths(s)[9 * k + j], l[static_cast<Eigen::Index>(j)], 1e-14);
    }
  }

  // Rows a1 a2 b1 b2 zp zs, in units of the characteristic length.
  const auto designs = std::make_shared<std::vector<double>>();
  const auto robots = std::make_shared<std::vector<Pose>>();
  for (const Variables& x : random_designs()) {
    designs->insert(designs->end(), x.begin(), x.begin() + 6);
    robots->push_back({ninedof::Geometry::hexagonal(x[0], x[1], x[2], x[3]), ninedof::neutral(x[4], x[5], 0.0)});
  }
  const auto found = std::make_shared<std::vector<double>>(robots->size());
  const auto closed_form = [designs, found](std::size_t) {
    ninedof::batch::hexagonal_condition_numbers(designs->data(), static_cast<long>(found->size()), found->data());
    benchmark::DoNotOptimize(found->data());
  };
  const auto svd = [robots](std::size_t) {
    for (const Pose& p : *robots) benchmark::DoNotOptimize(plain::condition_number(p.geometry, p.configuration, 1.0));
  };
  closed_form(0);
  for (std::size_t k = 0; k < robots->size(); ++k) {
    const double kappa = plain::condition_number((*robots)[k].geometry, (*robots)[k].configuration, 1.0);
    require_close("closed form of many designs", (*found)[k], kappa, 1e-13 * kappa * kappa);
  }

  const std::string level = ninedof::batch::simd_level();
  const Target conditions_target = level == "v4" ? nanoseconds(40.0) : level == "v3" ? nanoseconds(80.0) : Target{};
  return {
      {figure("condition number", "plain Eigen: J', JacobiSVD", data, conditions, plain_condition, conditions_target),
       figure("leg lengths", "plain Eigen", data, lengths,
              [](const auto& g, const auto& c) { return plain::leg_lengths(g, c); }),
       {"closed form of hexagonal designs, a stack (" + level + ")", "plain Eigen: J', JacobiSVD", 1, robots->size(),
        closed_form, svd, level == "v4" ? nanoseconds(5.0) : Target{}}},
      {}};
}

}  // namespace bench
