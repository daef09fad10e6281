#pragma once
/// Whether solutions of the rotation problem form a family: a self-motion.

#include "position/polish_rotation.hpp"

namespace ninedof {

/// Distinct solutions that are not simple. Isolated solutions are at most eight: with nine there is a family.
class RotationFamily {
 public:
  /// `error` is that of the equations. The problem must live as long as this object.
  RotationFamily(const RotationProblem& problem, double error) : problem_(problem), error_(error) {}

  /// Adds a rotation if it is a solution, not simple, and not yet known.
  void add(const PolishedRotation& polished);
  /// Adds members along the family from the first one, to both sides.
  void follow();
  bool proved() const { return count_ == member_.size(); }

 private:
  const RotationProblem& problem_;
  double error_;
  std::array<Mat3, 9> member_;
  std::size_t count_ = 0;
};

}  // namespace ninedof
