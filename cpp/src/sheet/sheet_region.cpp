#include "ninedof/sheet/sheet_region.hpp"

#include <algorithm>
#include <cmath>

#include "math/numbers.hpp"
#include "ninedof/conditioning/conditioning.hpp"
#include "ninedof/domains/region_sample.hpp"
#include "ninedof/math/parallel.hpp"
#include "ninedof/robot/legs.hpp"
#include "ninedof/singularity/singularity.hpp"

namespace ninedof {
namespace {

constexpr int turns = 24;      // directions of the greatest tilt, at each corner
constexpr double same = 1e-7;  // of the region: nearer poses are one
constexpr long mean_parts = 8;
constexpr double placed_last_step = 1e-4;  // of descents where O is placed at every step

/// Numbers of a sheet, each the worse the lower: one that is worst at both ends comes twice, the second time negative.
/// The lengths of the external legs are a group of their own.
class Numbers : public PoseNumbers {
 public:
  Numbers(const SheetNumbers& sheet, const Geometry& g, const Configuration& neutral, const Region& region,
          PlacedAt placed)
      : sheet_(sheet), geometry_(g), neutral_(neutral), region_(region), placed_(std::move(placed)) {}

  std::vector<int> groups() const override {
    std::vector<int> out{6, 12};
    for (const SheetGroup& group : sheet_.groups()) out.push_back(group.size * (group.worst == WorstEnd::both ? 2 : 1));
    return out;
  }
  void go(const Vec6& at) override {
    at_ = at;
    known_ = false;
  }
  void evaluate(int group, double* out) override {
    if (group == 0) return both_ends(leg_lengths(geometry_, region_.configuration(at_, neutral_)).head<3>(), out);
    if (!known_) here_ = placed_ ? placed_(at_) : region_.configuration(at_, neutral_);
    known_ = true;
    if (group == 1) return both_ends(leg_lengths(geometry_, here_).tail<6>(), out);
    const auto which = static_cast<std::size_t>(group - 2);
    sheet_.evaluate(which, here_, out);
    const SheetGroup& numbers = sheet_.groups()[which];
    Eigen::Map<Eigen::VectorXd> first(out, numbers.size);
    if (numbers.worst == WorstEnd::both) Eigen::Map<Eigen::VectorXd>(out + numbers.size, numbers.size) = -first;
    if (numbers.worst == WorstEnd::greatest) first = -first;
  }
  std::vector<double> worthwhile(const std::vector<double>& sampled) const override {
    std::vector<double> below(sampled.size(), placed_ ? -infinity : infinity);
    std::fill_n(below.begin(), 18, infinity);
    return below;
  }

 private:
  template <class Lengths>
  static void both_ends(const Lengths& lengths, double* out) {
    constexpr Eigen::Index size = Lengths::RowsAtCompileTime;
    Eigen::Map<Eigen::Matrix<double, 2 * size, 1>>{out} << lengths, -lengths;
  }

  const SheetNumbers& sheet_;
  const Geometry& geometry_;
  const Configuration& neutral_;
  const Region& region_;
  PlacedAt placed_;
  Vec6 at_ = Vec6::Zero();
  Configuration here_;
  bool known_ = false;
};

/// The corners from which a singularity is nearest, for every way of moving.
std::vector<Vec6> near_singular(const SheetQuestion& q, const Region& region, int threads, const Control& control) {
  const std::vector<Vec6> corners = region_corners(region, turns);
  std::vector<Configuration> poses;
  for (const Vec6& at : corners) poses.push_back(region.configuration(at, q.neutral));
  const bool held = q.motion && q.motion->internal == InternalMotion::held;
  const NearestSingularities found = nearest_singularities(q.geometry, poses, held, threads, control.stop);
  return {corners[at_index(found.shift.pose)], corners[at_index(found.turn.pose)],
          corners[at_index(found.internal.pose)]};
}

/// The mean of the condition number over an even sample.
void take_mean(const SheetQuestion& q, const Region& region, const std::function<PlacedAt()>& placing,
               const RegionSettings& settings, const Control& control, SheetRegion& out) {
  const long count = std::max(settings.samples / 2, 1L);
  Eigen::VectorXd values = Eigen::VectorXd::Constant(count, infinity);
  out.mean = out.mean_error = infinity;
  if (!q.characteristic_length) return;
  out.poses += count;
  parallel_for(count, 64, settings.threads, [&](long first, long last) {
    if (control.stop.stop_requested()) return;
    const PlacedAt placed = placing ? placing() : [&](const Vec6& at) { return region.configuration(at, q.neutral); };
    for (long n = first; n < last; ++n)
      values[n] = condition_number(q.geometry, placed(even_sample(region, n, settings.seed)), *q.characteristic_length);
  });
  if (control.stop.stop_requested()) throw Stopped{};
  out.mean = values.mean();
  const long parts = std::min(mean_parts, count);
  if (parts < 2 || !values.allFinite()) return;
  Eigen::VectorXd means(parts);
  for (long part = 0, from = 0; part < parts; ++part) {
    const long size = count / parts + (part < count % parts ? 1 : 0);
    means[part] = values.segment(from, size).mean();
    from += size;
  }
  out.mean_error = std::sqrt((means.array() - means.mean()).square().sum() / static_cast<double>((parts - 1) * parts));
}

}  // namespace

SheetRegion sheet_over_region(const SheetQuestion& question, const Region& region, const RegionSettings& settings,
                              const std::function<PlacedAt()>& placing, const Control& control) {
  const SheetNumbers sheet(question);
  const auto make = [&] {
    return std::make_unique<Numbers>(sheet, question.geometry, question.neutral, region,
                                     placing ? placing() : PlacedAt());
  };
  RegionSettings search = settings;
  if (placing) search.last_step = std::max(search.last_step, placed_last_step);
  const RegionExtremes found = region_extremes(region, make, search, control);
  SheetRegion out;
  out.poses = found.poses;
  std::vector<Vec6> worst;
  for (std::size_t k = 0; k < found.ends.size(); ++k)
    if (!found.ends[k].empty()) worst.push_back(found.least(k).at);
  if (!placing) {
    const std::vector<Vec6> near = near_singular(question, region, settings.threads, control);
    worst.insert(worst.end(), near.begin(), near.end());
  }
  const Vec6 unit = same * region.reach().cwiseMax(1e-300);
  for (const Vec6& at : worst) {
    const auto is_same = [&](const Vec6& other) { return ((at - other).cwiseAbs().array() <= unit.array()).all(); };
    if (std::ranges::none_of(out.worst, is_same)) out.worst.push_back(at);
  }
  take_mean(question, region, placing, settings, control, out);
  return out;
}

std::array<Vec9, 2> leg_lengths_over(const Geometry& g, const Configuration& neutral, const Region& region,
                                     const RegionSettings& settings, const Control& control) {
  const SheetQuestion lengths_alone{.geometry = g, .neutral = neutral};
  const SheetNumbers sheet(lengths_alone);
  const RegionExtremes found = region_extremes(
      region, [&] { return std::make_unique<Numbers>(sheet, g, neutral, region, PlacedAt()); }, settings, control);
  std::array<Vec9, 2> out;
  for (std::size_t leg = 0; leg < 9; ++leg) {
    const std::size_t shortest = leg < 3 ? leg : leg + 3, longest = shortest + (leg < 3 ? 3 : 6);
    out[0][static_cast<Eigen::Index>(leg)] = found.least(shortest).value;
    out[1][static_cast<Eigen::Index>(leg)] = -found.least(longest).value;
  }
  return out;
}

}  // namespace ninedof
