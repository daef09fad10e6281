/// Limits of a study as statements about extremes over all poses. Declared in ninedof/proof/machine.hpp.

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "math/numbers.hpp"
#include "ninedof/limits/numbers.hpp"
#include "proof/region/questions.hpp"
#include "proof/region/worst_machine.hpp"
#include "robot/joint_cones.hpp"

namespace ninedof {
namespace {

using over_region::Questions;

class Statements {
 public:
  Statements(const PosedRobot& machine, const std::array<bool, 21>& exempt, double slack, const ProofSettings& settings,
             const Control& control)
      : machine_(machine),
        exempt_(pairs_sharing_a_joint(machine.geometry, exempt)),
        slack_(slack),
        control_(control),
        questions_(machine, settings, control) {
    // In the frames of the plates, which limits of the design alone are about.
    const Points at = points(machine.geometry, {Vec3::Zero(), Mat3::Identity(), Vec3::Zero()});
    std::copy_n(at.begin(), joints_.size(), joints_.begin());
    const Mat3 axes = machine.tool.axes();
    for (std::size_t k = point_u; k < joints_.size(); ++k) {
      exact_[k - point_u] = own_point(axes, joints_[k]);
      joints_[k] = axes * joints_[k] + machine.tool.position;
    }
  }

  LimitsOverPoses prove(const std::vector<Limit>& limits) {
    std::array<std::pair<std::size_t, std::size_t>, 9> ends;
    for (int leg = 0; leg < 9; ++leg) ends[at_index(leg)] = questions_.ends_of_leg(leg, false);
    for (const LimitRow& row : limit_rows())
      if (row.info.kind == LimitKind::sign) add_pose_limit("no singularity", row, Side::low, 0.0, {}, false);
    for (const Limit& limit : limits) {
      limit.validate();
      add(limit);
    }
    questions_.search();
    answer();
    const auto open = [this](const Stroke& s) {
      return out_.limits[s.limit].answer == LimitOverPoses::Answer::undecided;
    };
    if (slack_ > 0.0 && !control_.stop.stop_requested() && std::ranges::any_of(strokes_, open)) {
      questions_.search_lengths_again();
      answer();
    }
    for (std::size_t leg = 0; leg < 9; ++leg)
      out_.lengths[leg] = {questions_[ends[leg].first].low, questions_[ends[leg].second].high};
    out_.met = questions_.met_in_region();
    return std::move(out_);
  }

 private:
  struct Group {
    std::size_t limit;
    std::vector<std::pair<std::size_t, std::string>> of;  ///< what is asked for each item, and its name
  };
  struct Stroke {
    std::size_t limit;
    const SpreadRow* row;
    std::array<std::pair<std::size_t, std::size_t>, 9> ends;
    /// How far each leg turns at its joint on the base and on the platform, where that may be off.
    std::array<std::array<std::optional<std::size_t>, 2>, 9> turns{};
  };

  LimitOverPoses& put(const std::string& name, const LimitRow& row, Side side, double limit, bool at_neutral) {
    LimitOverPoses one;
    one.name = name;
    one.kind = row.info.kind;
    one.side = side;
    one.limit = limit;
    one.at_neutral = at_neutral;
    out_.limits.push_back(one);
    return out_.limits.back();
  }
  double edge(Side side, double limit) const { return limit * (side == Side::high ? 1.0 + slack_ : 1.0 - slack_); }
  LimitOverPoses::Answer answer_of(const LimitOverPoses& one) const {
    using enum LimitOverPoses::Answer;
    const double end = edge(one.side, one.limit);
    if (one.side == Side::high) return one.value.hi <= end ? proved : one.value.lo > end ? violated : undecided;
    // A determinant of zero is a singularity.
    if (one.limit == 0.0) return one.value.lo > 0.0 ? proved : one.value.hi <= 0.0 ? violated : undecided;
    return one.value.lo >= end ? proved : one.value.hi < end ? violated : undecided;
  }

  void add(const Limit& limit) {
    const LimitRow& row = limit_row(limit.name);
    for (const Side side : {Side::low, Side::high}) {
      const double given = side == Side::low ? limit.low : limit.high;
      if (!(given > 0.0) || !std::isfinite(given)) continue;
      const double bound = limit.of == Unit::zp ? given * zp() : given;
      const bool at_neutral = limit.at == LimitAt::neutral;
      if (row.pose != nullptr) add_pose_limit(limit.label(), row, side, bound, limit.options(), at_neutral);
      else if (row.design != nullptr) add_design_limit(limit, row, side);
      else add_stroke(limit.label(), row, side, bound, at_neutral);
    }
  }
  void add_pose_limit(const std::string& label, const LimitRow& row, Side side, double bound,
                      const LimitOptions& options, bool at_neutral) {
    Group group{out_.limits.size(), {}};
    for (int item = 0; item < row.pose->items; ++item) {
      if (row.pose->pairs && exempt_[at_index(item)]) continue;
      const std::size_t asked = questions_.ask(row, item, {side == Side::high, at_neutral, edge(side, bound), options});
      group.of.emplace_back(asked, row.pose->part(item));
    }
    if (group.of.empty()) return;
    put(label, row, side, bound, at_neutral);
    groups_.push_back(std::move(group));
  }
  void add_stroke(const std::string& label, const LimitRow& row, Side side, double bound, bool at_neutral) {
    Stroke stroke{out_.limits.size(), row.spread, {}, {}};
    for (int leg = 0; leg < 9; ++leg) stroke.ends[at_index(leg)] = questions_.ends_of_leg(leg, at_neutral);
    for (const bool platform : {false, true})
      for (int k = 0; k < legs_at_body; ++k) {
        if (machine_.tolerances.joints[at_index(joint_at(platform, leg_at(platform, k)))] == 0.0) continue;
        stroke.turns[at_index(leg_at(platform, k))][platform] =
            questions_.ask(joint_cone_limit(platform), k, {true, at_neutral, not_a_number, {}});
      }
    put(label, row, side, bound, at_neutral);
    strokes_.push_back(stroke);
  }

  /// The value of a limit of the design over its items, and its last unit; joints may be off by `loose`.
  std::pair<Interval, Interval> design_number(const Limit& limit, const LimitRow& row, Side side, double loose) const {
    Interval value = side == Side::high ? Interval(-infinity) : Interval(infinity), unit(1.0);
    for (int item = 0; item < row.design->items(side); ++item) {
      const bool radial = row.design->picks_widest;
      Interval here = row.design->enclosure(touched(row.design->joints(joints_, side, item), loose, radial), item);
      if (radial) here = here * widest_share();
      unit = unit_of(limit.of, row.design->body(item), loose);
      if (row.design->body(item) >= 0) here = here / unit;
      value = side == Side::high ? max(value, here) : min(value, here);
    }
    return {value, unit};
  }
  /// `radial`: what is asked is a distance from z alone, so that it is enough to move joints from and to it.
  Touched<Interval> touched(std::pair<int, int> joints, double loose = 0.0, bool radial = false) const {
    const auto exact = [&](int joint) {
      const Vec3& x = joints_[at_index(joint)];
      Xyz<Interval> out = joint < point_u ? Xyz<Interval>{x.x(), x.y(), x.z()} : exact_[at_index(joint - point_u)];
      if (loose == 0.0) return out;
      const Interval ball(-loose, loose), radius = sqrt(square(out.x) + square(out.y));
      if (radial && radius.lo > loose) {
        const Interval scale = Interval(1.0) + ball / radius;
        return Xyz<Interval>{scale * out.x, scale * out.y, out.z};
      }
      return Xyz<Interval>{out.x + ball, out.y + ball, out.z + ball};
    };
    return {exact(joints.first), exact(joints.second), exact_zp(), machine_.neutral.internal_point.z()};
  }
  /// A point of the tool's frame in that of the platform.
  Xyz<Interval> own_point(const Mat3& axes, const Vec3& x) const {
    const auto along = [&](Eigen::Index k) {
      const double t = machine_.tool.position[k];
      if (!machine_.tool.turned()) return plus_exact(x[k], t);
      return Interval(axes(k, 0)) * x.x() + Interval(axes(k, 1)) * x.y() + Interval(axes(k, 2)) * x.z() + t;
    };
    return {along(0), along(1), along(2)};
  }
  static Interval plus_exact(double x, double t) { return t == 0.0 ? Interval(x) : Interval(x) + t; }
  Interval exact_zp() const { return plus_exact(machine_.neutral.position.z(), -machine_.tool.position.z()); }
  double zp() const { return machine_.neutral.position.z() - machine_.tool.position.z(); }
  void add_design_limit(const Limit& limit, const LimitRow& row, Side side) {
    const double given = side == Side::low ? limit.low : limit.high;
    const auto [drawn, unit] = design_number(limit, row, side, 0.0);
    Interval value = drawn;
    if (const double loose = std::ranges::max(machine_.tolerances.joints); loose > 0.0) {
      const Interval built = design_number(limit, row, side, loose).first;  // the drawing has the end that is met
      value = side == Side::high ? Interval(drawn.lo, built.hi) : Interval(built.lo, drawn.hi);
    }
    // What has the whole robot as its unit is shown as a length.
    const bool whole = row.design->body(0) < 0;
    const double bound = whole && limit.of != Unit::length ? given * (side == Side::high ? unit.lo : unit.hi) : given;
    put(limit.label(), row, side, bound, false).value = value;
  }
  /// Which joint is farthest from z was decided in doubles. Of joints that may be off by `loose` another one may be, at
  /// most so much beyond or short of the one of the drawing.
  Interval widest_share() const {
    const double arm = machine_.tool.position.norm();
    const double far = arm == 0.0 ? 0.0 : arm / joints_[at_index(widest_joint(joints_, point_u))].head<2>().norm();
    return {1.0 - 0x1p-49 * (1.0 + far), 1.0 + 0x1p-49 * (1.0 + far)};
  }
  Interval unit_of(Unit of, int body, double loose) const {
    if (of == Unit::zp) return exact_zp();
    if (of == Unit::length) return 1.0;
    const Xyz<Interval> widest = touched({widest_joint(joints_, body), 0}, loose, true).a;
    return sqrt(square(widest.x) + square(widest.y)) * widest_share();
  }

  void answer() {
    for (const Group& group : groups_) {
      LimitOverPoses& limit = out_.limits[group.limit];
      const bool most = limit.side == Side::high;
      const std::pair<std::size_t, std::string>* worst = nullptr;
      limit.boxes = 0;
      double beyond = most ? -infinity : infinity;  // the end of the enclosure that was not met
      const auto met = [&](const auto& item) {
        return most ? questions_[item.first].low : questions_[item.first].high;
      };
      for (const auto& item : group.of) {
        const Extreme& e = questions_[item.first];
        limit.boxes += e.boxes;
        beyond = most ? std::max(beyond, e.high) : std::min(beyond, e.low);
        if (worst == nullptr || (most ? met(item) > met(*worst) : met(item) < met(*worst))) worst = &item;
      }
      limit.value = most ? Interval(met(*worst), beyond) : Interval(beyond, met(*worst));
      limit.part = worst->second;
      limit.at = {questions_[worst->first].at};
    }
    for (const Stroke& stroke : strokes_) answer(stroke);
    for (LimitOverPoses& limit : out_.limits) limit.answer = answer_of(limit);
  }
  /// At most the difference of the errors of a leg's length at two poses: an error of a joint counts along the leg,
  /// whose direction in the joint's body stays within an angle of that at home, up to what is of second order.
  double apart(const Stroke& stroke, int leg, double shortest) const {
    const Tolerances& t = machine_.tolerances;
    Interval sum = Interval(2.0) * Interval(t.legs[leg]);
    double joints = 0.0;
    for (const bool platform : {false, true})
      if (const auto asked = stroke.turns[at_index(leg)][platform]) {
        const double r = t.joints[at_index(joint_at(platform, leg))];
        const double angle = questions_[*asked].high;
        sum = sum + Interval(r) * (angle < 1.57 ? 2.0 * sin(Interval(angle)) : Interval(2.0));
        joints += r * (1.0 + 0x1p-40);
      }
    if (!(shortest > 0.0)) return infinity;  // of the machines that are built: no leg of the drawing is shorter
    return (sum + square(Interval(joints)) / (Interval(2.0) * Interval(shortest))).hi;
  }
  void answer(const Stroke& stroke) {
    LimitOverPoses& limit = out_.limits[stroke.limit];
    struct Leg {
      Interval shortest, longest;
      MetAt shortest_at, longest_at;
      std::string name;
      double reading;  ///< by which its length may be off
      double apart;    ///< by which errors at its two ends may differ
    };
    std::vector<Leg> legs;
    limit.boxes = 0;
    limit.part.clear();
    for (int k = 0; k < 9; ++k) {
      const auto& [first, second] = stroke.ends[at_index(k)];
      const Extreme &a = questions_[first], &b = questions_[second];
      limit.boxes += a.boxes + b.boxes;
      const double reading = over_region::reading_error(machine_.tolerances, k);
      legs.push_back({{a.low, a.high}, {b.low, b.high}, a.at, b.at, leg_name(k), reading, apart(stroke, k, a.low)});
    }
    if (!stroke.row->each_leg) {
      Leg all = legs.front();
      for (const Leg& leg : legs) {
        if (leg.shortest.hi < all.shortest.hi) all.shortest_at = leg.shortest_at;
        if (leg.longest.lo > all.longest.lo) all.longest_at = leg.longest_at;
        all.shortest = min(all.shortest, leg.shortest);
        all.longest = max(all.longest, leg.longest);
        all.reading = std::max(all.reading, leg.reading);
        all.apart = infinity;
      }
      all.name = "all legs";
      legs = {all};
    }
    Interval value(-infinity);
    for (const Leg& leg : legs) {
      Interval one = stroke.row->of(leg.longest, leg.shortest);
      if (leg.reading > 0.0) {
        // The machine of the drawing has the lower end.
        const Interval reading(leg.reading), longest = leg.longest - reading, shortest = leg.shortest + reading;
        one.lo = std::max(stroke.row->of(longest, shortest).lo, 0.0);
        const Interval travel = Interval((longest - shortest).hi) + Interval(leg.apart), least(leg.shortest.lo);
        if (!stroke.row->ratio) one.hi = std::min(one.hi, travel.hi);
        else if (least.lo > 0.0) one.hi = std::min(one.hi, (Interval(1.0) + travel / least).hi);
      }
      if (one.lo > value.lo || limit.part.empty()) {
        limit.part = leg.name;
        limit.at = {leg.longest_at, leg.shortest_at};
      }
      value = max(value, one);
    }
    limit.value = value;
  }

  const PosedRobot& machine_;
  std::array<bool, 21> exempt_;
  double slack_;
  const Control& control_;
  std::array<Vec3, 12> joints_;
  std::array<Xyz<Interval>, 6> exact_;  ///< those of the platform
  Questions questions_;
  std::vector<Group> groups_;
  std::vector<Stroke> strokes_;
  LimitsOverPoses out_;
};

}  // namespace

LimitsOverPoses limits_over_poses(const PosedRobot& machine, const std::vector<Limit>& limits,
                                  const std::array<bool, 21>& exempt, double slack, const ProofSettings& settings,
                                  const Control& control) {
  return Statements(machine, exempt, slack, settings, control).prove(limits);
}

}  // namespace ninedof
