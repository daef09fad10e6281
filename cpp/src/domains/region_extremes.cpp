#include "ninedof/domains/region_extremes.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

#include "math/numbers.hpp"
#include "ninedof/domains/region_sample.hpp"
#include "ninedof/math/error.hpp"
#include "ninedof/math/parallel.hpp"

namespace ninedof {
namespace {

constexpr long blocks = 64;  // of samples
// Parts of the region. A descent begins from the worst sample of a part, so that no two begin next to each other.
constexpr std::size_t parts = 64;
constexpr long fewest_descents = 6, most_descents = 24;  // of a number; the most where there are many samples
constexpr double first_step = 0.2;                       // of a descent, in parts of the region
constexpr long most_evaluations = 2000;                  // of a descent

using Make = std::function<std::unique_ptr<PoseNumbers>()>;

/// By the signs of the coordinates; along a path by quarters, which takes the place of those that are not used there.
std::size_t part_of(const Region& region, const Vec6& at) {
  std::size_t out = 0;
  for (Eigen::Index k = 0; k < 6; ++k) out += at[k] > 0.0 ? std::size_t{1} << static_cast<unsigned>(k) : 0;
  if (region.shape == Region::Shape::path && std::abs(at[0]) > 0.5) out += 2;
  return out;
}

/// The lowest of every number in every part of the region.
class Lowest {
 public:
  explicit Lowest(std::size_t numbers) : numbers_(numbers), met_(parts * numbers, {infinity, Vec6::Zero()}) {}
  MetNumber& at(std::size_t part, std::size_t number) { return met_[part * numbers_ + number]; }
  const MetNumber& at(std::size_t part, std::size_t number) const { return met_[part * numbers_ + number]; }
  void take(std::size_t part, const std::vector<double>& values, const Vec6& where) {
    for (std::size_t k = 0; k < numbers_; ++k)
      if (values[k] < at(part, k).value) at(part, k) = {values[k], where};
  }
  void take(const Lowest& other) {
    for (std::size_t k = 0; k < met_.size(); ++k)
      if (other.met_[k].value < met_[k].value) met_[k] = other.met_[k];
  }
  /// The lowest of a number in the parts where it is lowest, these first.
  std::vector<MetNumber> first(std::size_t number, std::size_t count) const {
    std::vector<MetNumber> out;
    for (std::size_t part = 0; part < parts; ++part)
      if (at(part, number).value < infinity) out.push_back(at(part, number));
    std::ranges::stable_sort(out, {}, &MetNumber::value);
    out.resize(std::min(out.size(), count));
    return out;
  }

 private:
  std::size_t numbers_;
  std::vector<MetNumber> met_;
};

Lowest sampled(const Region& region, const Make& make, const std::vector<int>& groups, const RegionSettings& settings,
               const Control& control) {
  const auto numbers = static_cast<std::size_t>(std::accumulate(groups.begin(), groups.end(), 0));
  const long block = (settings.samples + blocks - 1) / blocks;
  std::vector<std::unique_ptr<Lowest>> of_block(at_index(blocks));
  parallel_for(blocks, 1, settings.threads, [&](long first, long) {
    const std::unique_ptr<PoseNumbers> pose = make();
    Lowest lowest(numbers);
    std::vector<double> values(numbers);
    for (long n = first * block; n < std::min(settings.samples, (first + 1) * block); ++n) {
      if (control.stop.stop_requested()) return;
      const Vec6 at = region_sample(region, n, settings.seed);
      pose->go(at);
      double* out = values.data();
      for (std::size_t g = 0; g < groups.size(); out += groups[g++]) pose->evaluate(static_cast<int>(g), out);
      lowest.take(part_of(region, at), values, at);
    }
    of_block[at_index(first)] = std::make_unique<Lowest>(std::move(lowest));
  });
  if (control.stop.stop_requested()) throw Stopped{};
  Lowest out(numbers);
  for (const auto& lowest : of_block) out.take(*lowest);
  return out;
}

/// Lowers one number by moves both ways, and along the way that a round of moves has led: a ridge need not follow one
/// of the moves. A step is doubled where it helps and halved where none does.
class Descent {
 public:
  Descent(PoseNumbers& pose, const Region& region, int group, int number, int size)
      : pose_(pose), region_(region), group_(group), number_(at_index(number)), values_(at_index(size)) {}

  long run(MetNumber& met, double last_step, const std::stop_token& stop) {
    least_decrease_ = last_step * last_step;
    for (double step = first_step; step >= last_step && count_ < most_evaluations; step *= 0.5)
      for (bool lower = true; lower && count_ < most_evaluations && !stop.stop_requested();) {
        const Vec6 before = met.at;
        lower = false;
        for (int move = 0; move < region_moves; ++move)
          for (const double side : {1.0, -1.0})
            for (double length = step; length < 2.0; length *= 2.0) {
              if (!takes(region_moved(region_, met.at, move, side * length), met)) break;
              lower = true;
            }
        const Vec6 way = met.at - before;
        for (double length = 1.0; lower && length < 1e6; length *= 2.0)
          if (!takes(met.at + length * way, met)) break;
      }
    return count_;
  }

 private:
  bool takes(const Vec6& to, MetNumber& met) {
    const Vec6 next = region_.nearest(to);
    if ((next - met.at).isZero(0.0)) return false;
    pose_.go(next);
    pose_.evaluate(group_, values_.data());
    ++count_;
    if (!(values_[number_] < met.value - least_decrease_ * (1.0 + std::abs(met.value)))) return false;
    met = {values_[number_], next};
    return true;
  }

  PoseNumbers& pose_;
  const Region& region_;
  int group_;
  std::size_t number_;
  std::vector<double> values_;
  double least_decrease_ = 0.0;  // of a smooth number at its least
  long count_ = 0;
};

}  // namespace

const MetNumber& RegionExtremes::least(std::size_t number) const {
  return *std::ranges::min_element(ends.at(number), {}, &MetNumber::value);
}

RegionExtremes region_extremes(const Region& region, const Make& make, const RegionSettings& settings,
                               const Control& control) {
  region.validate();
  if (settings.samples < 1) throw InvalidArgument("samples", std::to_string(settings.samples), "one or more");
  const std::unique_ptr<PoseNumbers> shape = make();
  const std::vector<int> groups = shape->groups();
  const Lowest lowest = sampled(region, make, groups, settings, control);

  RegionExtremes out;
  out.poses = settings.samples;
  std::vector<std::pair<int, int>> place;  // of each number: its group, and its place there
  for (std::size_t g = 0; g < groups.size(); ++g)
    for (int k = 0; k < groups[g]; ++k) place.emplace_back(static_cast<int>(g), k);
  const auto descents = static_cast<std::size_t>(std::clamp(settings.samples / 4000, fewest_descents, most_descents));
  std::vector<double> least;
  for (std::size_t k = 0; k < place.size(); ++k) {
    out.ends.push_back(lowest.first(k, descents));
    least.push_back(out.ends.back().empty() ? infinity : out.ends.back().front().value);
  }
  const std::vector<double> below = shape->worthwhile(least);
  std::vector<long> counts(place.size(), 0);
  parallel_for(static_cast<long>(place.size()), 1, settings.threads, [&](long k, long) {
    const std::unique_ptr<PoseNumbers> pose = make();
    const auto [group, number] = place[at_index(k)];
    for (MetNumber& met : out.ends[at_index(k)])
      if (met.value < below[at_index(k)])
        counts[at_index(k)] +=
            Descent(*pose, region, group, number, groups[at_index(group)]).run(met, settings.last_step, control.stop);
  });
  if (control.stop.stop_requested()) throw Stopped{};
  out.poses = std::accumulate(counts.begin(), counts.end(), out.poses);
  return out;
}

}  // namespace ninedof
