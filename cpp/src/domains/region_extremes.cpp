#include "ninedof/domains/region_extremes.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

#include "domains/region_descent.hpp"
#include "math/numbers.hpp"
#include "math/sort_by.hpp"
#include "ninedof/domains/region_sample.hpp"
#include "ninedof/math/error.hpp"
#include "ninedof/math/parallel.hpp"

namespace ninedof {
namespace {

constexpr long samples_a_block = 512, most_blocks = 64;
// Parts of the region. A descent begins from the worst sample of a part, so that no two begin next to each other.
constexpr std::size_t parts = 64;
constexpr long fewest_descents = 6, most_descents = 24;  // of a number; the most where there are many samples

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
    sort_by(out, &MetNumber::value);
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
  // Few blocks of few samples: each keeps the lowest of every number in every part.
  const long blocks = std::clamp(settings.samples / samples_a_block, 1L, most_blocks);
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

/// How many samples a number descends from.
std::size_t starts_of(const RegionSettings& settings) {
  if (settings.most_starts > 0) return static_cast<std::size_t>(settings.most_starts);
  return static_cast<std::size_t>(std::clamp(settings.samples / 4000, fewest_descents, most_descents));
}

/// The known poses where a number is near its least.
std::vector<MetNumber> near_least(const std::vector<Vec6>& known, const Eigen::MatrixXd& values, Eigen::Index number,
                                  double highest) {
  std::vector<MetNumber> out;
  for (std::size_t n = 0; n < known.size(); ++n)
    if (const double value = values(number, static_cast<Eigen::Index>(n)); value < infinity && value <= highest)
      out.push_back({value, known[n]});
  return out;
}

/// Every number at the known poses, a column each.
Eigen::MatrixXd at_known(PoseNumbers& pose, const std::vector<Vec6>& known, const std::vector<int>& groups) {
  const auto numbers = std::accumulate(groups.begin(), groups.end(), 0);
  Eigen::MatrixXd out(numbers, static_cast<Eigen::Index>(known.size()));
  for (std::size_t n = 0; n < known.size(); ++n) {
    pose.go(known[n]);
    double* column = out.col(static_cast<Eigen::Index>(n)).data();
    for (std::size_t g = 0; g < groups.size(); column += groups[g++]) pose.evaluate(static_cast<int>(g), column);
  }
  return out;
}

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
  std::vector<Vec6> known;
  for (const Vec6& at : settings.known) known.push_back(region.nearest(at));
  const Eigen::MatrixXd values = at_known(*shape, known, groups);

  RegionExtremes out;
  std::vector<NumberPlace> place;
  for (std::size_t g = 0; g < groups.size(); ++g)
    for (int k = 0; k < groups[g]; ++k) place.push_back({static_cast<int>(g), k, groups[g]});
  std::vector<double> least;
  for (std::size_t k = 0; k < place.size(); ++k) {
    out.ends.push_back(lowest.first(k, starts_of(settings)));
    least.push_back(out.ends.back().empty() ? infinity : out.ends.back().front().value);
    for (const double value : values.row(static_cast<Eigen::Index>(k))) least.back() = std::min(least.back(), value);
  }
  const std::vector<double> below = shape->worthwhile(least);
  std::vector<long> counts(place.size(), 0);
  parallel_for(static_cast<long>(place.size()), 1, settings.threads, [&](long n, long) {
    const std::unique_ptr<PoseNumbers> pose = make();
    const std::size_t k = at_index(n);
    std::vector<MetNumber>& ends = out.ends[k];
    for (const MetNumber& met : near_least(known, values, static_cast<Eigen::Index>(k), least[k] + settings.near))
      ends.push_back(met);
    for (MetNumber& met : ends)
      if (met.value < below[k]) counts[k] += descend(*pose, region, place[k], settings.last_step, control.stop, met);
    counts[k] += drop_repeated(*pose, region, place[k], ends);
  });
  if (control.stop.stop_requested()) throw Stopped{};
  out.poses = std::accumulate(counts.begin(), counts.end(), settings.samples + static_cast<long>(known.size()));
  return out;
}

}  // namespace ninedof
