#pragma once
/// A rule for O as forms over a box of poses.

#include <array>
#include <vector>

#include "math/form.hpp"
#include "ninedof/math/xyz.hpp"
#include "ninedof/proof/point_rule.hpp"

namespace ninedof::over_region {

/// A polynomial, expanded about the middle of each box: terms that cancel each other there leave no error behind.
class RuleForms {
 public:
  explicit RuleForms(const PointRule& rule);

  /// s less its neutral position, of the six coordinates of the rule over a box.
  template <class T>
  Xyz<T> shift(const std::array<T, T::size>& at) const;

 private:
  using Powers = std::array<int, PoseForm::size>;
  /// Of Horner's scheme: the coefficient `to` grows by that of `from` times coordinate k of the middle.
  struct Step {
    std::size_t to, from, k;
  };

  std::size_t index_of(const Powers& term);

  std::array<double, PoseForm::size> scale_{};
  std::vector<Powers> terms_;  ///< with each also all that have lower powers
  std::vector<std::array<double, 3>> coefficients_;
  std::vector<Step> steps_;
};

}  // namespace ninedof::over_region
