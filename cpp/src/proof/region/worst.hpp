#pragma once
/// The greatest value of an index over all poses: a pose where it is met, and a bound proved box after box.

#include "ninedof/math/control.hpp"
#include "proof/region/pose.hpp"

namespace ninedof::over_region {

/// A number of machine and pose that has no form over a box, but bounds there.
class IndexOverPoses {
 public:
  explicit IndexOverPoses(const Domain& domain) : domain_(domain) {}
  virtual ~IndexOverPoses() = default;
  const Domain& domain() const { return domain_; }
  /// At most the index of one machine at a box of one pose.
  virtual double at(const Geometry& g, const Box& point) const = 0;
  /// Whether it is proved to be at most `bound` in all of a box, of every machine within tolerances. `moves` is what an
  /// open box is divided by.
  virtual bool bounded(const Box& box, double bound, Moves& moves) const = 0;

 private:
  const Domain& domain_;
};

struct Met {
  double value = 0.0;
  Box at;
};
/// Where the index is large: local maxima are many, one about each corner of a region. The value is of a machine within
/// tolerances. `roughly`: from fewer starts and without the last digits.
Met searched(const IndexOverPoses& index, int threads, const std::stop_token& stop, bool roughly = false);

/// The whole domain: a search from it has one bound, another one comes to it by wider ones.
PoseBoxes all_boxes(const Domain& domain);

/// As worst_condition, of any index, from where it was met.
WorstOverPoses worst(const IndexOverPoses& index, Met met, const ProofSettings& settings, const PoseBoxes& from,
                     const Control& control);

}  // namespace ninedof::over_region
