#include "redundancy/search/scan.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <unordered_set>

#include "math/sort_by.hpp"
#include "ninedof/batch/batch.hpp"

namespace ninedof {
namespace {

constexpr double box_reach = 1.5;  // half the edge of the box without limits, in sizes of the robot
constexpr int most_halvings = 12;  // before the first values; limits leave less than a cell where that is not enough
constexpr std::size_t most_divided = 2000;  // cells at a time
constexpr int projections = 6;              // onto limits

/// A number for the place of a cell.
std::uint64_t key(int x, int y, int z) {
  const auto part = [](int k) { return static_cast<std::uint64_t>(k + 1); };
  return (part(x) << 42) | (part(y) << 21) | part(z);
}

/// Values of PoseObjective::exact, by the vector kernels.
std::vector<double> values(const PoseObjective& objective, const std::vector<Vec3>& points) {
  const ScaledPose& pose = objective.pose();
  const InternalPointProblem& problem = objective.problem();
  std::vector<double> out(points.size());
  if (points.empty()) return out;
  std::vector<Vec3> s;
  s.reserve(points.size());
  for (const Vec3& x : points) s.push_back(pose.unscaled(x));
  const Eigen::Matrix<double, 3, 3, Eigen::RowMajor> rotation = pose.rotation();
  const batch::Configurations all{
      pose.position().data(), rotation.data(), s[0].data(), static_cast<long>(s.size()), 0, 0, 3};
  switch (problem.criterion) {
    case Criterion::condition_number:
      batch::condition_numbers(pose.geometry(), all, {&problem.characteristic_length, 0}, Norm::two, out.data());
      for (double& value : out) value = std::log(value);
      break;
    case Criterion::singularity: {
      std::vector<double> margins(3 * s.size());
      batch::singularity_margins(pose.geometry(), all, margins.data());
      for (std::size_t k = 0; k < s.size(); ++k)
        out[k] = -std::log(Eigen::Map<const Vec3>(&margins[3 * k]).cwiseAbs().minCoeff());
      break;
    }
    case Criterion::leg_centring:
      std::ranges::transform(points, out.begin(), [&](const Vec3& x) { return objective.exact(x); });
      break;
  }
  return out;
}

}  // namespace

Scan::Scan(const PoseObjective& objective, int n)
    : objective_(objective),
      low_(Vec3::Constant(-box_reach)),
      high_(Vec3::Constant(box_reach)),
      parts_(std::max(1, n / 4)) {
  const ScaledPose& pose = objective.pose();
  for (int k = 0; k < 6; ++k) {
    low_ = low_.cwiseMax((pose.joint(k).array() - pose.high()[k]).matrix());
    high_ = high_.cwiseMin((pose.joint(k).array() + pose.high()[k]).matrix());
  }
  if (!(low_.array() < high_.array()).all()) return;
  for (int x = 0; x < parts_; ++x)
    for (int y = 0; y < parts_; ++y)
      for (int z = 0; z < parts_; ++z) cells_.push_back({{x, y, z}, middle({x, y, z}), 0.0});
  const std::size_t enough = at_index(n) * at_index(n) * at_index(n) / 64;
  for (int k = 0; k < most_halvings && cells_.size() <= enough; ++k) {
    std::vector<ScanCell> next;
    parts_ *= 2;
    for (const ScanCell& cell : cells_) add_parts(cell.place, false, next);
    cells_ = std::move(next);
  }
  evaluate(cells_);
  for (ScanCell& cell : cells_)
    if (pose.volumes(cell.x).cwiseSign() != objective.signs()) cell.value = infinity;
}

void Scan::add_parts(const std::array<int, 3>& place, bool of_chamber, std::vector<ScanCell>& out) const {
  const double half = 0.5 * diagonal();
  for (int k = 0; k < 8; ++k) {
    const std::array<int, 3> part{2 * place[0] + k / 4, 2 * place[1] + k / 2 % 2, 2 * place[2] + k % 2};
    Vec3 x = middle(part);
    // The violation grows no faster than the way.
    if (objective_.violation(x) > half) continue;
    const double broken = objective_.project(x, projections);
    if (of_chamber && objective_.pose().volumes(x).cwiseSign() != objective_.signs()) continue;
    out.push_back({part, x, broken});
  }
}

void Scan::evaluate(std::vector<ScanCell>& cells) const {
  std::vector<Vec3> points;
  points.reserve(cells.size());
  for (const ScanCell& cell : cells) points.push_back(cell.x);
  const std::vector<double> found = values(objective_, points);
  for (std::size_t k = 0; k < cells.size(); ++k) cells[k].value = found[k];
}

void Scan::keep(double best, const std::function<bool(const Vec3&)>& reached) {
  std::erase_if(cells_, [&](const ScanCell& cell) { return !cell.may_hold(best) || !reached(cell.x); });
}

void Scan::divide(double best) {
  std::erase_if(cells_, [&](const ScanCell& cell) { return !cell.may_hold(best); });
  if (cells_.size() > most_divided) {
    const auto lowest = [](const ScanCell& cell) { return cell.value < infinity ? cell.value - cell.drop : infinity; };
    sort_by(cells_, lowest);  // not nth_element: cells of a symmetric robot tie
    cells_.resize(most_divided);
    complete_ = false;
  }
  std::vector<ScanCell> next;
  std::vector<std::size_t> first;
  next.reserve(8 * cells_.size());
  parts_ *= 2;
  for (const ScanCell& cell : cells_) {
    first.push_back(next.size());
    add_parts(cell.place, true, next);
  }
  first.push_back(next.size());
  evaluate(next);
  for (std::size_t k = 0; k < cells_.size(); ++k) {
    const double whole = cells_[k].value;
    double least = whole, greatest = whole < infinity ? whole : -infinity;
    for (std::size_t part = first[k]; part < first[k + 1]; ++part) {
      if (!(next[part].value < infinity)) continue;
      least = std::min(least, next[part].value);
      greatest = std::max(greatest, next[part].value);
    }
    for (std::size_t part = first[k]; part < first[k + 1]; ++part)
      if (greatest > least) next[part].drop = greatest - least;
  }
  cells_ = std::move(next);
}

std::vector<ScanCell> Scan::valleys(double best) const {
  std::vector<ScanCell> rising, out;
  std::ranges::copy_if(cells_, std::back_inserter(rising), [&](const ScanCell& cell) { return cell.may_hold(best); });
  std::ranges::sort(rising, {}, [](const ScanCell& cell) { return std::pair(cell.value, cell.place); });
  std::unordered_set<std::uint64_t> lower;
  for (const ScanCell& cell : rising) {
    const auto [x, y, z] = cell.place;
    bool least = true;
    for (int k = 0; k < 27 && least; ++k) least = !lower.contains(key(x + k / 9 - 1, y + k / 3 % 3 - 1, z + k % 3 - 1));
    if (least) out.push_back(cell);
    lower.insert(key(x, y, z));
  }
  return out;
}

}  // namespace ninedof
