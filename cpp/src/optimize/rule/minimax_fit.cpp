#include "optimize/rule/minimax_fit.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "math/linear/least_squares.hpp"
#include "math/numbers.hpp"
#include "math/sort_by.hpp"
#include "optimize/rule/rule_samples.hpp"

namespace ninedof {
namespace {

constexpr long dense_poses = 20'000, poses_at_once = 2'000;
constexpr std::size_t most_joined = 100;  // of the dense sample
constexpr int most_steps = 15, most_tries = 20;  // for each smoothing; of a step, each shorter than that before
constexpr double stiff = 3.0;  // what bends costs, in squares of zp: such rules are hard to prove, and worse between
constexpr double window = 8.0;       // smoothings below the worst row: others weigh next to nothing
constexpr double least_fall = 0.03;  // of a step, in smoothings
constexpr double first_damping = 1e-2, least_damping = 1e-6, shorter = 8.0, longer = 5.0;
constexpr double ridge = 1e-9;          // of terms that depend on each other at the poses taken
constexpr double middle_metric = 1e-2;  // of middles beside coefficients

double worst_of(const PlacedRows& rows) {
  return rows.value.maxCoeff();
}

}  // namespace

Vec6 rule_coordinates(const RuleRows& rows, const Vec6& at) {
  const Pose pose = rows.region().pose(at);
  Vec6 out;
  out << pose.position * (pose.in_zp ? rows.zp() : 1.0), at.tail<3>();
  return out;
}

MinimaxFit::MinimaxFit(const RuleRows& rows, const std::vector<Powers>& powers, const std::vector<Placed>& best)
    : rows_(rows), powers_(powers), scale_(Vec6::Ones()) {
  Vec6 reach = Vec6::Zero();
  for (const Placed& place : best) reach = reach.cwiseMax(rule_coordinates(rows, place.at).cwiseAbs());
  for (Eigen::Index k = 0; k < 6; ++k)
    if (reach[k] > 0.0) scale_[k] = std::exp2(std::ceil(std::log2(reach[k])));  // quotients are exact
  const auto count = static_cast<Eigen::Index>(powers.size());
  stiffness_.resize(3 * count);
  for (Eigen::Index m = 0; m < count; ++m) {
    const Powers& term = powers[at_index(m)];
    const double bends = std::max(std::reduce(term.begin(), term.end()) - 1, 0);
    for (Eigen::Index i = 0; i < 3; ++i) stiffness_[i * count + m] = stiff * bends * bends;
  }
  unknowns_ = Eigen::VectorXd::Zero(3 * count + rows.middle_count());
  std::vector<Vec6> poses;
  for (const Placed& place : best) poses.push_back(place.at);
  take(poses);
  Eigen::MatrixXd wanted = Eigen::MatrixXd::Zero(count, 3);
  for (std::size_t n = 0; n < best.size(); ++n)
    wanted += terms_.col(static_cast<Eigen::Index>(n)) * best[n].shift.transpose() / static_cast<double>(best.size());
  unknowns_.head(3 * count) = solve_definite(metric().topLeftCorner(count, count), wanted).reshaped();
  unknowns_.tail(rows.middle_count()) = rows.middles(placed(poses));
  move_to(unknowns_);
}

PointRule MinimaxFit::rule() const {
  PointRule out{scale_, powers_, {}};
  const auto count = static_cast<Eigen::Index>(powers_.size());
  for (Eigen::Index m = 0; m < count; ++m)
    out.coefficients.push_back(rows_.zp() * Vec3(unknowns_[m], unknowns_[count + m], unknowns_[2 * count + m]));
  return out;
}

double MinimaxFit::worst() const {
  double out = -infinity;
  for (const PlacedRows& rows : values_) out = std::max(out, worst_of(rows));
  return out;
}

void MinimaxFit::join(const std::vector<Vec6>& poses) {
  move_to(unknowns_);  // with the goal and the margin of now
  const Eigen::VectorXd middles = unknowns_.tail(rows_.middle_count());
  const double most = worst();
  std::vector<std::pair<double, Vec6>> worse;
  for (long first = 0; first < dense_poses; first += poses_at_once) {
    const std::vector<Placed> places = placed(sampled_poses(rows_.region(), first, poses_at_once));
    const std::vector<PlacedRows> values = rows_.at(places, middles);
    for (std::size_t k = 0; k < places.size(); ++k)
      if (const double value = worst_of(values[k]); value > most) worse.emplace_back(value, places[k].at);
  }
  sort_by(worse, [](const auto& one) { return -one.first; });
  std::vector<Vec6> all = poses;
  for (std::size_t k = 0; k < std::min(worse.size(), most_joined); ++k) all.push_back(worse[k].second);
  take(all);
  move_to(unknowns_);
}

void MinimaxFit::lower(double smoothing) {
  const Eigen::MatrixXd weights = metric();
  double damping = first_damping;
  for (int step = 0; step < most_steps; ++step) {
    const Model here = model(smoothing);
    const Eigen::VectorXd start = unknowns_;
    double fall = 0.0;
    for (int k = 0; k < most_tries && !(fall > 0.0); ++k) {
      if (k > 0) damping *= shorter;
      move_to(start - solve_definite(here.bend + damping * weights, here.gradient));
      fall = here.value - smoothed(smoothing);
    }
    if (!(fall > 0.0)) move_to(start);
    if (!(fall >= least_fall * smoothing)) return;
    damping = std::max(damping / longer, least_damping);
  }
}

Eigen::VectorXd MinimaxFit::terms_at(const Vec6& at) const {
  const Vec6 x = rule_coordinates(rows_, at).cwiseQuotient(scale_);
  Eigen::VectorXd out = Eigen::VectorXd::Ones(static_cast<Eigen::Index>(powers_.size()));
  for (std::size_t m = 0; m < powers_.size(); ++m)
    for (std::size_t k = 0; k < 6; ++k)
      for (int n = 0; n < powers_[m][k]; ++n) out[static_cast<Eigen::Index>(m)] *= x[static_cast<Eigen::Index>(k)];
  return out;
}

Vec3 MinimaxFit::shift_by(const Eigen::VectorXd& terms) const {
  const Eigen::Index count = terms.size();
  return {terms.dot(unknowns_.head(count)), terms.dot(unknowns_.segment(count, count)),
          terms.dot(unknowns_.segment(2 * count, count))};
}

std::vector<Placed> MinimaxFit::placed(const std::vector<Vec6>& poses) const {
  std::vector<Placed> out;
  for (const Vec6& given : poses) {
    const Vec6 at = rows_.region().nearest(given);
    out.push_back({at, shift_by(terms_at(at))});
  }
  return out;
}

void MinimaxFit::take(const std::vector<Vec6>& poses) {
  const std::vector<Placed> more = placed(poses);
  auto n = static_cast<Eigen::Index>(places_.size());
  places_.insert(places_.end(), more.begin(), more.end());
  terms_.conservativeResize(static_cast<Eigen::Index>(powers_.size()), static_cast<Eigen::Index>(places_.size()));
  for (const Placed& place : more) terms_.col(n++) = terms_at(place.at);
}

/// Sets the unknowns, and O and the rows at all places.
void MinimaxFit::move_to(const Eigen::VectorXd& unknowns) {
  unknowns_ = unknowns;
  for (std::size_t n = 0; n < places_.size(); ++n)
    places_[n].shift = shift_by(terms_.col(static_cast<Eigen::Index>(n)));
  values_ = rows_.at(places_, unknowns_.tail(rows_.middle_count()));
}

double MinimaxFit::smoothed(double smoothing) const {
  const double most = worst();
  double sum = 0.0;
  for (const PlacedRows& rows : values_)
    for (const double value : rows.value)
      if (value > most - window * smoothing) sum += std::exp((value - most) / smoothing);
  const auto c = unknowns_.head(stiffness_.size()).array();
  return most + smoothing * std::log(sum) + 0.5 * (stiffness_.array() * c * c).sum();
}

MinimaxFit::Model MinimaxFit::model(double smoothing) const {
  const Eigen::Index terms = terms_.rows(), middles = rows_.middle_count(), size = unknowns_.size();
  const double most = worst(), least = most - window * smoothing;
  Model out{smoothed(smoothing), Eigen::VectorXd::Zero(size), Eigen::MatrixXd::Zero(size, size)};
  double total = 0.0;
  for (Eigen::Index n = 0; n < terms_.cols(); ++n) {
    // Sums over the rows of a place with their weights: slopes by O, their products, those with slopes by middles.
    Vec3 slope = Vec3::Zero();
    Mat3 product = Mat3::Zero();
    Eigen::Matrix<double, 3, Eigen::Dynamic> mixed = Eigen::Matrix<double, 3, Eigen::Dynamic>::Zero(3, middles);
    const PlacedRows& rows = values_[at_index(n)];
    if (!(worst_of(rows) > least)) continue;
    for (Eigen::Index row = 0; row < rows.value.size(); ++row) {
      if (!(rows.value[row] > least)) continue;
      const double weight = std::exp((rows.value[row] - most) / smoothing);
      const Vec3 g = rows.by_shift.row(row).transpose();
      total += weight;
      slope += weight * g;
      product += weight * g * g.transpose();
      if (const auto [middle, by] = rows_.middle_of(rows, row); middle >= 0) {
        mixed.col(middle) += weight * by * g;
        out.gradient[3 * terms + middle] += weight * by;
        out.bend(3 * terms + middle, 3 * terms + middle) += weight * by * by;
      }
    }
    const Eigen::VectorXd t = terms_.col(n);
    const Eigen::MatrixXd square = t * t.transpose();
    for (Eigen::Index i = 0; i < 3; ++i) {
      out.gradient.segment(i * terms, terms) += slope[i] * t;
      for (Eigen::Index j = 0; j <= i; ++j)
        out.bend.block(i * terms, j * terms, terms, terms) += product(i, j) * square;
      out.bend.block(3 * terms, i * terms, middles, terms) += mixed.row(i).transpose() * t.transpose();
    }
  }
  out.gradient /= total;
  out.bend = ((out.bend / total - out.gradient * out.gradient.transpose()) / smoothing).eval();
  out.bend.diagonal().head(3 * terms) += stiffness_;
  out.gradient.head(3 * terms) += stiffness_.cwiseProduct(unknowns_.head(3 * terms));
  return out;
}

/// What the damping of a step is measured by: shifts of O at the places, and of the middles.
Eigen::MatrixXd MinimaxFit::metric() const {
  const Eigen::Index terms = terms_.rows();
  Eigen::MatrixXd spread = Eigen::MatrixXd::Zero(terms, terms);
  for (const auto& t : terms_.colwise()) spread += t * t.transpose() / static_cast<double>(terms_.cols());
  spread.diagonal().array() += ridge * spread.trace() / static_cast<double>(terms);
  Eigen::MatrixXd out = middle_metric * Eigen::MatrixXd::Identity(unknowns_.size(), unknowns_.size());
  for (Eigen::Index i = 0; i < 3; ++i) out.block(i * terms, i * terms, terms, terms) = spread;
  return out;
}

}  // namespace ninedof
