/// The extreme values of numbers over all poses, by branch and bound. Declared in ninedof/proof/machine.hpp.

#include <algorithm>
#include <chrono>
#include <cmath>
#include <queue>

#include "math/numbers.hpp"
#include "ninedof/math/error.hpp"
#include "ninedof/math/parallel.hpp"
#include "proof/region/quantity.hpp"

namespace ninedof {
namespace over_region {
namespace {

using Clock = std::chrono::steady_clock;

struct Open {
  double bound;
  Box box;
  int divide;
  bool operator<(const Open& other) const { return bound < other.bound; }
};

/// Maximizes one quantity: always the box of the greatest bound next, until no bound is above what was met.
class Climb {
 public:
  Climb(const Domain& domain, const PoseQuantity& wanted, const ProofSettings& settings)
      : domain_(domain),
        wanted_(wanted),
        made_(make_quantity(domain.machine(), wanted)),
        quantity_(*made_),
        settings_(settings) {}

  template <class Stop>
  Extreme run(const Stop& stopped) {
    at_ = middle_of(domain_.roots().front());  // to name where nothing is known of any pose: beyond the doubles
    for (const Box& root : domain_.roots()) look(root);
    long boxes = static_cast<long>(domain_.roots().size());
    double done = -infinity;  // the greatest bound of boxes that were given up
    while (!open_.empty()) {
      const Open top = open_.top();
      const bool near = contains(quantity_.number({met_, top.bound}), wanted_.limit);
      if (top.bound <= met_ + (near ? settings_.relative : wanted_.relative) * std::abs(met_)) break;
      if (boxes >= settings_.boxes || (boxes % 256 == 0 && stopped())) break;
      open_.pop();
      if (top.divide < 0) {
        done = std::max(done, top.bound);
        continue;
      }
      for (const Box& half : halves(top.box, top.divide)) look(half);
      ++boxes;
    }
    const double most = std::max({met_, done, open_.empty() ? -infinity : open_.top().bound});
    const Interval number = quantity_.number({met_, most});
    return {number.lo, number.hi, domain_.met(at_), boxes};
  }

 private:
  void look(const Box& box) {
    if (domain_.outside(box)) return;
    Slopes slopes;
    const double bound = quantity_.bound(domain_, box, slopes);
    if (!(bound > met_)) return;
    const Box point = domain_.towards(slopes.slope, box);
    const double value = quantity_.attained(domain_.pose(point));
    if (value > met_) {
      met_ = value;
      at_ = point;
    }
    open_.push({bound, box, divided_coordinate(box, slopes.moves.along)});
  }

  const Domain& domain_;
  const PoseQuantity& wanted_;
  std::unique_ptr<Quantity> made_;
  const Quantity& quantity_;
  const ProofSettings& settings_;
  std::priority_queue<Open> open_;
  double met_ = -infinity;
  Box at_;
};

}  // namespace
}  // namespace over_region

std::vector<Extreme> pose_extremes(const PosedRobot& machine, const std::vector<PoseQuantity>& quantities,
                                   const ProofSettings& settings, const Control& control) {
  using namespace over_region;
  const Domain domain(machine);
  const Clock::time_point start = Clock::now();
  const auto stopped = [&] {
    return control.stop.stop_requested() ||
           std::chrono::duration<double>(Clock::now() - start).count() > settings.seconds;
  };
  std::vector<Extreme> out(quantities.size());
  parallel_for(static_cast<long>(quantities.size()), 1, settings.threads, [&](long k, long) {
    const auto n = static_cast<std::size_t>(k);
    out[n] = Climb(domain, quantities[n], settings).run(stopped);
  });
  return out;
}

}  // namespace ninedof
