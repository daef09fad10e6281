#pragma once
/// Design families: named variables on one side, a Geometry and a Configuration on the other.
///
/// A family answers with `quantities`, all an optimizer asks of a design, and their exact gradients. Lengths and singular
/// values are given as logarithms: ratios become differences, and every scale looks alike.

#include <span>
#include <string>
#include <vector>

#include "ninedof/configuration.hpp"
#include "ninedof/geometry.hpp"

namespace ninedof {

/// Rows of DesignPoint.
enum Quantity : int {
  log_axial_max,       ///< singular values of M on the axis (reciprocals of those of J')
  log_axial_min,
  log_transverse_max,
  log_transverse_min,
  log_l,               ///< leg lengths
  log_q,
  log_r,
  log_base_radius,     ///< largest distance of a joint from z, base and platform
  log_platform_radius,
  log_zp,
  log_zs,
  quantity_count
};

/// More than any family has; keeps DesignPoint off the heap.
constexpr int max_variables = 40;

/// Rows of the largest and the smallest singular value; of two equal ones the axial.
struct Extremes {
  int max, min;
};

/// Quantities of one design and their partial derivatives, one column a variable.
struct DesignPoint {
  Eigen::Matrix<double, quantity_count, 1> value;
  Eigen::Matrix<double, quantity_count, Eigen::Dynamic, Eigen::ColMajor, quantity_count, max_variables> gradient;

  Extremes extremes() const;

  /// log of the condition number: largest minus smallest log singular value.
  double log_condition_number() const;

  /// Its gradient; where two singular values tie, that of the axial one.
  Eigen::VectorXd log_condition_number_gradient() const;
};

/// One variable of a family.
struct VariableInfo {
  std::string name;
  bool is_angle;     ///< radians if so, else a length
  double low, high;  ///< default bounds, in characteristic lengths or radians
};

/// The interface of a family. Variables come in the order of `variables()`.
class DesignFamily {
 public:
  virtual ~DesignFamily() = default;
  virtual const std::string& name() const = 0;
  virtual const std::vector<VariableInfo>& variables() const = 0;

  /// The robot. Throws InvalidArgument where the variables describe none (a plate of zero size, say).
  virtual Geometry geometry(std::span<const double> x) const = 0;
  virtual Configuration configuration(std::span<const double> x) const = 0;

  /// Quantities and gradients. A vanishing quantity is given as 1e-300 with zero gradient, so that logs stay finite; a largest
  /// singular value as 1, so that the design has an enormous condition number and not none.
  virtual void evaluate(std::span<const double> x, double characteristic_length, DesignPoint& out) const = 0;
};

/// "hexagonal". Throws InvalidArgument for an unknown name, listing the known ones.
const DesignFamily& design_family(const std::string& name);

/// Names of all families.
std::vector<std::string> design_family_names();

}  // namespace ninedof
