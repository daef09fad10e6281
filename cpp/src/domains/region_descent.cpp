#include "domains/region_descent.hpp"

#include <algorithm>
#include <cmath>

#include "math/slsqp.hpp"
#include "ninedof/domains/region_sample.hpp"

namespace ninedof {
namespace {

constexpr double first_step = 0.2, probing_step = 0.05;  // by coordinates, in parts of the region
constexpr long most_evaluations = 2000;                  // of a descent
constexpr SlsqpSettings ascent{.tolerance = 1e-15, .max_evaluations = 100};
constexpr SlsqpSettings a_little{.tolerance = 1e-10, .max_evaluations = 25};
constexpr double stationary = 1e-5;  // of the slopes
constexpr int most_rounds = 4;
constexpr double corner_gap = 1e-13;  // from the corners of a path, where its slopes change
// In parts of the region. By slopes an end is known to 1e-6 where its number is flat there, and then it is as low as
// the others to 1e-13.
constexpr double same_pose = 1e-5;
constexpr double same_value = 1e-11;  // of ends in one flat place

/// A number at poses.
class Number {
 public:
  Number(PoseNumbers& pose, const NumberPlace& place)
      : pose_(pose), place_(place), smooth_(pose.smooth(place.group, place.number)), values_(at_index(place.size)) {}

  bool smooth() const { return smooth_; }
  long count() const { return count_; }
  double at(const Vec6& at) {
    Vec6 unused;
    if (smooth_) return slopes(at, unused);
    ++count_;
    pose_.go(at);
    pose_.evaluate(place_.group, values_.data());
    return values_[at_index(place_.number)];
  }
  double slopes(const Vec6& at, Vec6& by_at) {
    ++count_;
    return pose_.slopes(place_.group, place_.number, at, by_at);
  }

 private:
  PoseNumbers& pose_;
  NumberPlace place_;
  bool smooth_;
  std::vector<double> values_;
  long count_ = 0;
};

/// Lowers one number by moves both ways, and along the way that a round of moves has led: a ridge need not follow one
/// of the moves. A step is doubled where it helps and halved where none does.
class CoordinateDescent {
 public:
  CoordinateDescent(Number& number, const Region& region, double last_step)
      : number_(number), region_(region), least_decrease_(last_step * last_step) {}

  /// Whether a lower pose was found.
  bool run(MetNumber& met, double first, double last, const std::stop_token& stop) {
    const double before = met.value;
    for (double step = first; step >= last && number_.count() < most_evaluations; step *= 0.5)
      for (bool lower = true; lower && number_.count() < most_evaluations && !stop.stop_requested();)
        lower = round(met, step);
    return met.value < before;
  }

 private:
  bool round(MetNumber& met, double step) {
    const Vec6 before = met.at;
    bool lower = false;
    for (int move = 0; move < region_moves; ++move)
      for (const double side : {1.0, -1.0})
        for (double length = step; length < 2.0; length *= 2.0) {
          if (!takes(region_moved(region_, met.at, move, side * length), met)) break;
          lower = true;
        }
    const Vec6 way = met.at - before;
    for (double length = 1.0; lower && length < 1e6; length *= 2.0)
      if (!takes(met.at + length * way, met)) break;
    return lower;
  }
  bool takes(const Vec6& to, MetNumber& met) {
    const Vec6 next = region_.nearest(to);
    if ((next - met.at).isZero(0.0)) return false;
    const double value = number_.at(next);
    if (!(value < met.value - least_decrease_ * (1.0 + std::abs(met.value)))) return false;
    met = {value, next};
    return true;
  }

  Number& number_;
  const Region& region_;
  double least_decrease_;  // of a smooth number at its least
};

/// Lowers a smooth number by SLSQP in the coordinates that are not fixed, in parts of the region.
class SmoothDescent {
 public:
  SmoothDescent(Number& number, const Region& region, const SlsqpSettings& settings)
      : number_(number), region_(region), reach_(region.reach()), settings_(settings) {
    for (Eigen::Index k = 0; k < 6; ++k)
      if (reach_[k] > 0.0) free_.push_back(k);
    if (region.shape == Region::Shape::ball && region.size[0] > 0.0) round_.push_back({0, 1, 2});
    if (region.shape == Region::Shape::cylinder && region.size[0] > 0.0) round_.push_back({0, 1});
    if (region.tilt > 0.0) round_.push_back({3, 4});
  }

  /// Whether the end is stationary: at a kink it is not.
  bool run(MetNumber& met, const std::stop_token& stop) {
    const auto n = static_cast<Eigen::Index>(free_.size());
    if (n == 0) return true;
    Nlp nlp;
    nlp.variables = n;
    nlp.constraints = static_cast<Eigen::Index>(round_.size());
    nlp.low = Eigen::VectorXd::Constant(n, -1.0);
    nlp.high = -nlp.low;
    if (region_.shape == Region::Shape::path) {
      const auto [way, from, to] = region_.straight(met.at[0]);
      nlp.low[0] = from + corner_gap;
      nlp.high[0] = to - corner_gap;
    }
    double steepest = 0.0;
    nlp.evaluate = [&](const Eigen::VectorXd& z, Nlp::Values& out) {
      Vec6 slopes;
      out.f = number_.slopes(from_parts(z), slopes);
      if (!std::isfinite(out.f) || !slopes.allFinite() || stop.stop_requested()) return false;
      out.f_gradient = to_parts(slopes.cwiseProduct(reach_));
      steepest = std::max(steepest, out.f_gradient.norm());
      fill_round(z, out);
      return true;
    };
    const Vec6 start = met.at.cwiseQuotient(reach_.cwiseMax(1e-300));
    const MetNumber end = at(region_.nearest(from_parts(slsqp(nlp, to_parts(start), settings_))));
    if (end.value < met.value) met = end;
    return residual(met) <= stationary * steepest;
  }

 private:
  Vec6 from_parts(const Eigen::VectorXd& z) const {
    Vec6 out = Vec6::Zero();
    for (std::size_t k = 0; k < free_.size(); ++k) out[free_[k]] = reach_[free_[k]] * z[static_cast<Eigen::Index>(k)];
    return out;
  }
  Eigen::VectorXd to_parts(const Vec6& v) const {
    Eigen::VectorXd out(static_cast<Eigen::Index>(free_.size()));
    for (std::size_t k = 0; k < free_.size(); ++k) out[static_cast<Eigen::Index>(k)] = v[free_[k]];
    return out;
  }
  MetNumber at(const Vec6& where) { return {number_.at(where), where}; }

  /// The squares of the round parts are at most 1.
  void fill_round(const Eigen::VectorXd& z, Nlp::Values& out) const {
    out.c_gradient.setZero();
    for (std::size_t r = 0; r < round_.size(); ++r) {
      const auto row = static_cast<Eigen::Index>(r);
      out.c[row] = -1.0;
      for (std::size_t k = 0; k < free_.size(); ++k) {
        if (std::ranges::find(round_[r], free_[k]) == round_[r].end()) continue;
        const auto column = static_cast<Eigen::Index>(k);
        out.c[row] += z[column] * z[column];
        out.c_gradient(row, column) = 2.0 * z[column];
      }
    }
  }

  /// How far a step down the slopes leads within the region, in its parts: nowhere from a local least.
  double residual(const MetNumber& met) {
    Vec6 slopes;
    number_.slopes(met.at, slopes);
    const Vec6 step = slopes.cwiseProduct(reach_).cwiseProduct(reach_);
    const Vec6 moved = region_.nearest(met.at - step) - met.at;
    return moved.cwiseQuotient(reach_.cwiseMax(1e-300)).norm();
  }

  Number& number_;
  const Region& region_;
  Vec6 reach_;
  SlsqpSettings settings_;
  std::vector<Eigen::Index> free_;
  std::vector<std::vector<Eigen::Index>> round_;
};

}  // namespace

long descend(PoseNumbers& pose, const Region& region, const NumberPlace& place, double last_step,
             const std::stop_token& stop, MetNumber& met) {
  Number number(pose, place);
  CoordinateDescent by_coordinates(number, region, last_step);
  if (!number.smooth()) {
    by_coordinates.run(met, first_step, last_step, stop);
    return number.count();
  }
  SmoothDescent by_slopes(number, region, ascent);
  for (int round = 0; round < most_rounds && !stop.stop_requested(); ++round) {
    const double before = met.value;
    const bool settled = by_slopes.run(met, stop);
    if (settled && met.value < before) break;
    // A kink, a corner of a path, or a start that is stationary but need not be lowest around.
    if (!by_coordinates.run(met, probing_step, settled ? probing_step : last_step, stop)) break;
  }
  return number.count();
}

long descend_a_little(PoseNumbers& pose, const Region& region, const NumberPlace& place, const std::stop_token& stop,
                      MetNumber& met) {
  Number number(pose, place);
  SmoothDescent(number, region, a_little).run(met, stop);
  return number.count();
}

long drop_repeated(PoseNumbers& pose, const Region& region, const NumberPlace& place, std::vector<MetNumber>& ends) {
  Number number(pose, place);
  const Vec6 apart = same_pose * region.reach();
  const auto same = [&](const MetNumber& a, const MetNumber& b) {
    if (((a.at - b.at).cwiseAbs().array() <= apart.array()).all()) return true;
    const double room = same_value * (1.0 + std::abs(a.value));
    if (!(std::abs(a.value - b.value) <= room)) return false;
    return std::abs(number.at(region.nearest(0.5 * (a.at + b.at))) - a.value) <= room;
  };
  std::vector<MetNumber> out;
  for (const MetNumber& end : ends) {
    const auto other = std::ranges::find_if(out, [&](const MetNumber& kept) { return same(kept, end); });
    if (other == out.end()) out.push_back(end);
    else if (end.value < other->value) *other = end;
  }
  ends = std::move(out);
  return number.count();
}

}  // namespace ninedof
