/// Sets of designs as files that a checker replays. Declared in ninedof/proof/admissible.hpp.

#include <algorithm>
#include <cmath>

#include "ninedof/math/error.hpp"
#include "proof/admissible/demands.hpp"
#include "proof/optimum/certificate_lines.hpp"

namespace ninedof {
namespace admissible {
namespace {

/// The lines of a file.
class DesignLines : proof::CertificateLines {
 public:
  DesignLines(const DesignQuestion& question, const DesignSet& set)
      : question_(question), set_(set), family_(design_family(question.problem.family)) {}

  std::string written() {
    const Problem& problem = question_.problem;
    line("family " + problem.family);
    for (std::size_t k = 0; k < question_.at.size(); ++k) {
      const auto varied = std::ranges::find(question_.varied, static_cast<int>(k)) - question_.varied.begin();
      const auto n = static_cast<std::size_t>(varied);
      const bool fixed = n == question_.varied.size();
      line("variable " + family_.variables()[k].name,
           {fixed ? question_.at[k] : question_.low[n], fixed ? question_.at[k] : question_.high[n]});
    }
    line("tool", {problem.tool.position, problem.tool.rotation});
    const StudyLength& length = problem.characteristic_length;
    line("characteristic_length", {length.choice == StudyLength::Choice::number ? length.value : 1.0});
    put_poses();
    put_duty(problem.limits);
    put_limits();
    line("shares", {set_.inside, set_.outside, set_.undecided});
    // The boxes have the ends of variables in the order of the family.
    std::vector<std::size_t> order(question_.varied.size());
    for (std::size_t k = 0; k < order.size(); ++k) order[k] = k;
    std::ranges::sort(order, {}, [&](std::size_t k) { return question_.varied[k]; });
    for (const DesignPiece& piece : set_.pieces) {
      Numbers ends;
      for (const std::size_t k : order) ends.all.insert(ends.all.end(), {piece.low[k], piece.high[k]});
      std::string state = piece.state == Membership::inside ? " inside" : " undecided";
      if (piece.state == Membership::outside)
        state = " outside " + std::to_string(limit_of(piece)) + pose(piece.at, piece) + pose(piece.other, piece);
      line("box", ends, state);
    }
    return proof::sealed("ninedof certificate of designs 1", text_);
  }

 private:
  void put_poses() {
    if (question_.region.empty()) {
      line("region none", {0.0, 0.0, 0.0, 0.0, 0.0}, " shifted length");
    } else {
      const Region& r = question_.region.front();
      const char* shape = std::array{"box", "ball", "cylinder", "path"}[static_cast<std::size_t>(r.shape)];
      line(std::string("region ") + shape, {r.size[0], r.size[1], r.size[2], r.tilt, r.yaw},
           std::string(r.shifted ? " shifted" : " held") + (r.in_zp ? " zp" : " length"));
      for (const Vec3& corner : r.corners) line("corner", {corner});
    }
    for (const Pose& one : question_.problem.objective.poses)
      line("pose", {one.position, one.rotation, one.internal}, one.in_zp ? " zp" : " length");
  }
  void put_limits() {
    const Objective& objective = question_.problem.objective;
    bool pairs = false;
    for (const Limit& one : question_.problem.limits) {
      put_limit(one.label(), one.name, one.low, one.high, to_string(one.of), one.at == LimitAt::neutral, one.axis);
      const PoseRow* row = limit_row(one.name).pose;
      pairs = pairs || (row != nullptr && row->pairs);
    }
    const double condition = std::min(objective.condition_limit, question_.condition);
    for (const bool neutral : {false, true})
      if (const double bound = neutral ? objective.neutral_condition_limit : condition; std::isfinite(bound))
        put_limit(neutral ? "condition_number at neutral" : "condition_number", "condition_number", 0.0, bound,
                  "length", neutral, Vec3::Zero());
    if (!pairs) return;
    const auto exempt = pairs_that_may_meet(question_);
    for (std::size_t k = 0; k < exempt.size(); ++k)
      if (exempt[k]) line("exempt " + std::to_string(k));
  }
  void put_limit(const std::string& label, const std::string& name, double low, double high, const char* of,
                 bool neutral, const Vec3& axis) {
    labels_.push_back(label);
    proof::CertificateLines::put_limit(name, low, high, of, neutral, axis);
  }
  int limit_of(const DesignPiece& piece) const {
    const auto n = static_cast<std::size_t>(piece.demand);
    if (n >= set_.demands.size()) throw InvalidArgument("pieces", std::to_string(piece.demand), "indices of demands");
    const std::string& label = set_.demands[n].limit;
    return static_cast<int>(std::ranges::find(labels_, label) - labels_.begin());
  }

  /// In the coordinates of the region, whose unit is zp in the middle of the piece where it is not a length.
  std::string pose(const MetAt& met, const DesignPiece& piece) const {
    if (met.pose >= 0) return " " + std::to_string(-1 - met.pose) + spelled({Vec3::Zero(), Vec3::Zero()});
    const Region& region = question_.region.at(0);
    const Vec3 shift = met.shift / (region.in_zp ? middle_zp(piece) : 1.0);
    if (region.shape != Region::Shape::path) return " 0" + spelled({shift, Vec3(met.tilt[0], met.tilt[1], met.yaw)});
    std::size_t part = 0;
    double best = std::numeric_limits<double>::infinity(), along = 0.0;
    for (std::size_t k = 0; k + 1 < region.corners.size(); ++k) {
      const Vec3 way = region.corners[k + 1] - region.corners[k], from = shift - region.corners[k];
      const double t = std::clamp(from.dot(way) / std::max(way.squaredNorm(), 1e-300), 0.0, 1.0);
      if (const double away = (from - t * way).norm(); away < best) {
        best = away;
        part = k;
        along = t;
      }
    }
    return " " + std::to_string(part) + spelled({Vec3(along, 0.0, 0.0), Vec3(met.tilt[0], met.tilt[1], met.yaw)});
  }
  double middle_zp(const DesignPiece& piece) const {
    const int zp = family_.index("zp");
    for (std::size_t k = 0; k < question_.varied.size(); ++k)
      if (question_.varied[k] == zp) return 0.5 * (piece.low[k] + piece.high[k]);
    return question_.at[static_cast<std::size_t>(zp)];
  }

  const DesignQuestion& question_;
  const DesignSet& set_;
  const DesignFamily& family_;
  std::vector<std::string> labels_{"no singularity", "zp > zs"};
};

}  // namespace
}  // namespace admissible

std::string design_certificate(const DesignQuestion& question, const DesignSet& set) {
  return admissible::DesignLines(question, set).written();
}

std::string machine_certificate(DesignQuestion question, double slack) {
  question.validate(true);
  const auto loosen = [slack](double& high) { high *= 1.0 + slack; };
  for (Limit& limit : question.problem.limits) {
    limit.low *= 1.0 - slack;
    loosen(limit.high);
  }
  loosen(question.problem.objective.condition_limit);
  loosen(question.problem.objective.neutral_condition_limit);
  DesignSet set;
  set.pieces = {{{}, {}, Membership::inside, -1, {}, {}}};
  set.inside = 1.0;
  set.undecided = 0.0;
  return design_certificate(question, set);
}

}  // namespace ninedof
