/// The extreme values of numbers over all poses, by branch and bound. Declared in ninedof/proof/machine.hpp.

#include <algorithm>
#include <cmath>

#include "domains/bound.hpp"
#include "limits/leg_clearance.hpp"
#include "limits/table.hpp"
#include "math/numbers.hpp"
#include "math/time_limit.hpp"
#include "ninedof/math/error.hpp"
#include "ninedof/math/parallel.hpp"
#include "proof/region/pose.hpp"
#include "proof/region/worst_machine.hpp"
#include "robot/joint_cones.hpp"

namespace ninedof {
namespace over_region {
namespace {

struct Open {
  double bound;
  Box box;
  int divide;
  bool operator<(const Open& other) const { return bound < other.bound; }
};

const PoseRow& checked_row(const PoseQuantity& wanted) {
  const PoseRow& row = pose_row("limit_name", wanted.limit_name);
  if (wanted.item < 0 || wanted.item >= row.items)
    throw InvalidArgument("item", std::to_string(wanted.item), "0 to " + std::to_string(row.items - 1));
  if (row.first_locked >= 0 && !wanted.greatest)
    throw InvalidArgument("greatest", "false for " + wanted.limit_name, "true: only the greatest is enclosed");
  if (row.pairs && wanted.greatest)
    throw InvalidArgument("greatest", "true for " + wanted.limit_name, "false: only the least distance is enclosed");
  return row;
}

/// A number as a function to be maximized: u of its row, or less u, or less the distance of two legs.
class Sought {
 public:
  Sought(const Domain& domain, const PoseQuantity& wanted)
      : domain_(domain),
        row_(checked_row(wanted)),
        item_(wanted.item),
        limit_(wanted.limit),
        reading_(row_.first_leg < 0 ? 0.0 : reading_error(domain.machine().tolerances, row_.first_leg + item_)),
        home_(domain.machine().geometry, domain.machine().neutral, wanted.options),
        sign_(!row_.pairs && wanted.greatest != row_.falls ? 1.0 : -1.0) {}

  /// Whether machines within tolerances differ in more than what `number` adds.
  bool loose() const { return row_.first_leg < 0 && !domain_.built().exact(); }
  /// At least every value at the poses of the domain in the box.
  double bound(const Box& box, std::array<double, PoseForm::size>& slope, Moves& moves) const {
    const FormPose pose = domain_.pose(box);
    const AsBuilt nominal{domain_.machine().geometry};
    const bool cone = row_.cone_body >= 0;
    const FormLook look(row_.first_leg < 0 && !cone ? domain_.built() : nominal, pose, home_);
    if (row_.pairs) return less_distance(look, box, slope, moves);
    const PoseForm f = sign_ * row_.form(look, item_);
    slope = f.a;
    row_.moves(look, item_, moves);
    const double most = domain_.greatest(f, box);
    return cone && loose() ? leg_turned(look, box, most) : most;
  }
  /// At most the value of one machine at a box of one pose.
  double attained(const Geometry& g, const Box& point) const {
    const FormPose pose = domain_.pose(point);
    const AsBuilt machine{g};
    const FormLook look(machine, pose, home_);
    if (!row_.pairs) return lower(sign_ * row_.form(look, item_));
    return -detail::above(std::sqrt(upper(squared_distance_above(leg_pair_forms(look, item_)))));
  }
  /// The number, where the function is within `value`.
  Interval number(const Interval& value) const {
    const Interval u = sign_ > 0.0 ? value : -value;
    const Interval number = row_.pairs ? u : row_.read(u);  // a distance is less what was sought
    return reading_ > 0.0 ? number + Interval(sign_ * reading_) : number;
  }

 private:
  /// At least every cosine, or less it, of a leg of the drawing turned by the errors of its joints, where that of the
  /// drawing is at most `most`. The errors in a cosine itself would count as if they all led away from the axis: a
  /// small angle would be several times too large.
  double leg_turned(const FormLook& look, const Box& box, double most) const {
    const int leg = leg_at(row_.cone_body == 1, row_.first_at_body + item_);
    const double error = joint_error(domain_.machine().tolerances, leg);
    if (error == 0.0) return most;
    const auto v = look.at(leg_ends(leg).to) - look.at(leg_ends(leg).from);
    const Vec3 along = centre(v).normalized() * (1.0 - 0x1p-50);
    const double shortest = -domain_.greatest(-(v.x * along[0] + v.y * along[1] + v.z * along[2]), box);
    if (!(error < shortest)) return 1.0;
    const Interval sine = Interval(error) / Interval(shortest), cosine = sqrt(Interval(1.0) - square(sine));
    if (!(most < cosine.lo)) return 1.0;
    const Interval drawn(std::max(most, -1.0));
    return (drawn * cosine + sqrt(Interval(1.0) - square(drawn)) * sine).hi;
  }
  double less_distance(const FormLook& look, const Box& box, std::array<double, PoseForm::size>& slope,
                       Moves& moves) const {
    const LegPairForms legs = leg_pair_forms(look, item_);
    if (!(legs.middle.apart.squaredNorm() > 0.0)) return 0.0;
    double least = infinity;
    for (const auto& direction : {fixed_direction<PoseForm>, turning_direction<PoseForm>}) {
      if (!(least == infinity || -least < limit_)) break;  // the second takes as long: only where it may decide
      const EndDistances ends = end_distances(legs, direction(legs));
      std::array<double, 4> most;
      for (std::size_t k = 0; k < most.size(); ++k) most[k] = domain_.greatest(-ends.along[k], box);
      const auto k = static_cast<std::size_t>(std::ranges::max_element(most) - most.begin());
      if (!(most[k] < least)) continue;
      // The ends that decide. Others count for little: a direction that moves only them need not be divided.
      least = most[k];
      slope = (-ends.along[k]).a;
      moves = {};
      moves.add(ends.between[k]);
    }
    for (const FormEnds* e : {&legs.one, &legs.two}) moves.add(e->to - e->from, 1e-3);
    return std::min(least, 0.0);
  }

  const Domain& domain_;
  const PoseRow& row_;
  int item_;
  double limit_, reading_;
  FormHome home_;
  double sign_;
};

/// Maximizes one quantity: always the box of the greatest bound next, until no bound is above what was met.
class Climb : public BoxSearch {
 public:
  Climb(const Domain& domain, const PoseQuantity& wanted, const ProofSettings& settings)
      : domain_(domain),
        wanted_(wanted),
        sought_(domain, wanted),
        settings_(settings),
        most_boxes_(settings.boxes * (domain.machine().rule.empty() ? 1 : 10)) {}

  Extreme run(const std::stop_token& stop) {
    at_ = middle_of(domain_.roots().front());  // to name where nothing is known of any pose: beyond the doubles
    for (const Box& root : domain_.roots()) add(root);
    looked = std::ssize(domain_.roots());
    ninedof::bound(*this, {stop, {}});
    const double most = std::max({reached_, done_, open.empty() ? -infinity : open.top().bound});
    if (sought_.loose())
      met_ = std::max(met_, sought_.attained(worst_machine(domain_.machine(),
                                                           [&](const Geometry& g) { return sought_.attained(g, at_); }),
                                             at_));
    const Interval number = sought_.number({met_, most});
    return {number.lo, number.hi, domain_.met(at_), looked};
  }

  OpenHeap<Open> open;
  bool enough() const {
    const double most = open.top().bound;
    if (most <= reached_) return true;
    const bool near = contains(sought_.number({reached_, most}), wanted_.limit);  // no box decides below reached_
    const double size = std::max(std::abs(met_), near ? 0.0 : wanted_.scale);
    return most <= reached_ + (near ? settings_.relative : wanted_.relative) * size || looked >= most_boxes_;
  }
  void merge(const Open& top, Nothing) {
    if (top.divide < 0) {
      done_ = std::max(done_, top.bound);
      return;
    }
    for (const Box& half : halves(top.box, top.divide)) add(half);
    ++looked;
  }

 private:
  void add(const Box& box) {
    if (domain_.outside(box)) return;
    std::array<double, PoseForm::size> slope{};
    Moves moves;
    const double bound = sought_.bound(box, slope, moves);
    if (!(bound > reached_)) return;
    const Box point = domain_.towards(slope, box);
    const double value = sought_.attained(domain_.machine().geometry, point);
    // A bound at a point takes as long as that of a box: where the drawing is far below what it met elsewhere, all
    // machines are, as a rule.
    const bool near_most = reached_ == -infinity || value > 2.0 * met_ - reached_ || looked % 16 == 0;
    if (value > met_) {
      met_ = value;
      at_ = point;
    }
    Moves unused;
    if (!sought_.loose()) reached_ = met_;
    else if (near_most) reached_ = std::max(reached_, sought_.bound(point, slope, unused));
    open.push({bound, box, divided_coordinate(box, moves.along)});
  }

  const Domain& domain_;
  const PoseQuantity& wanted_;
  Sought sought_;
  const ProofSettings& settings_;
  long most_boxes_;
  double met_ = -infinity;
  double reached_ = -infinity;  ///< no division makes bounds less: that of all machines at one pose
  double done_ = -infinity;     ///< the greatest bound of boxes that cannot be divided
  Box at_;
};

/// The condition number with a leg locked: roughly, then to the gap of the settings, then to the limit, until it is
/// decided on which side of the limit it is.
Extreme with_a_leg_locked(const PosedRobot& machine, const PoseQuantity& wanted, int leg, ProofSettings settings,
                          const Control& control) {
  constexpr double legs = 6.0, roughly = 1.0;
  settings.locked = leg;
  settings.seconds /= legs;
  Control quiet;
  quiet.stop = control.stop;
  Extreme out{0.0, infinity, {}, 0};
  const double gap = settings.gap;
  for (const auto& [to, condition] : {std::pair{roughly, 0.0}, std::pair{gap, 0.0}, std::pair{gap, wanted.limit}}) {
    settings.gap = to;
    settings.condition = condition;
    const Extreme now = worst_condition(machine, settings, {}, quiet).extreme;
    if (now.low > out.low) out.at = now.at;
    out = {std::max(out.low, now.low), std::min(out.high, now.high), out.at, out.boxes + now.boxes};
    const bool kept = to == gap && !(out.high > wanted.limit), passed = out.low >= wanted.limit;
    if (kept || passed) break;
  }
  return out;
}

}  // namespace
}  // namespace over_region

std::vector<Extreme> pose_extremes(const PosedRobot& machine, const std::vector<PoseQuantity>& quantities,
                                   const ProofSettings& settings, const Control& control) {
  using namespace over_region;
  const Domain domain(machine);
  if (domain.roots().empty()) throw InvalidArgument("machine", "no poses", "a region or listed poses");
  for (const PoseQuantity& quantity : quantities) checked_row(quantity);  // throws before threads begin
  const TimeLimit limit(settings.seconds, control.stop);
  std::vector<Extreme> out(quantities.size());
  parallel_for(static_cast<long>(quantities.size()), 1, settings.threads, [&](long k, long) {
    const auto n = static_cast<std::size_t>(k);
    if (pose_row("limit_name", quantities[n].limit_name).first_locked < 0)
      out[n] = Climb(domain, quantities[n], settings).run(limit.stop());
  });
  for (std::size_t n = 0; n < out.size(); ++n) {
    const int first = pose_row("limit_name", quantities[n].limit_name).first_locked;
    if (first >= 0) out[n] = with_a_leg_locked(machine, quantities[n], first + quantities[n].item, settings, control);
  }
  return out;
}

}  // namespace ninedof
