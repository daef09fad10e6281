#pragma once
/// Design families: named variables on one side; joints, neutral configuration and their derivatives on the other.

#include <span>
#include <string>
#include <vector>

#include "ninedof/families/blueprint.hpp"
#include "ninedof/robot/configuration.hpp"
#include "ninedof/robot/geometry.hpp"

namespace ninedof {

/// What a variable measures: a length is never negative, a coordinate may be; an angle is in radians, a fraction in zp.
enum class VariableKind { length, coordinate, angle, fraction };

/// "length", "coordinate", "angle" or "fraction".
const char* to_string(VariableKind kind);

/// One variable of a family.
struct VariableInfo {
  std::string name;
  VariableKind kind;
  double low, high;  ///< default bounds, in characteristic lengths or radians; equal where fixed by default
};

/// A pose on the symmetry axis: displacements along and about z from the neutral configuration.
struct AxisShift {
  double p = 0.0, s = 0.0;              ///< lengths
  double p_in_zp = 0.0, s_in_zp = 0.0;  ///< fractions of zp
  double turn = 0.0;                    ///< radians
  double tool = 0.0;                    ///< height of the tool's point in the platform's frame: p is there
};

/// Logarithms of the four distinct singular values of a C3 design on the axis, and their derivatives with respect to
/// the family's variables and, in one more column, the characteristic length.
struct AxisPoint {
  enum Row : int { axial_max, axial_min, transverse_max, transverse_min, rows };
  static constexpr double vanished = 1e-300;  ///< stands for a smallest singular value of zero, which has no logarithm
  Eigen::Matrix<double, rows, 1> value;
  Eigen::Matrix<double, rows, Eigen::Dynamic, Eigen::RowMajor, rows, max_variables + 1> gradient;
};

/// Which robot an AxisPoint describes.
enum class Machine { nine_legged, six_legged };

/// The interface of a family. Variables come in the order of `variables()`; spans have one value for each.
class DesignFamily {
 public:
  virtual ~DesignFamily() = default;
  virtual const std::string& name() const = 0;
  virtual const std::vector<VariableInfo>& variables() const = 0;

  /// Joints and neutral configuration with derivatives, not checked: a blueprint need not be a robot.
  virtual void blueprint(std::span<const double> x, Blueprint& out) const = 0;

  /// Whether every design is symmetric about z, as `axis` requires.
  virtual bool symmetric() const { return false; }

  /// The closed form on the axis. A vanishing singular value is replaced by 1e-300 with zero gradient, so that
  /// logarithms stay finite; a vanishing largest one by 1, so that the condition number is large.
  virtual void axis(std::span<const double> x, double characteristic_length, const AxisShift& shift, Machine machine,
                    AxisPoint& out) const;

  /// The robot. Throws InvalidArgument where the variables describe none, for example a plate of zero size.
  virtual Geometry geometry(std::span<const double> x) const;
  Configuration configuration(std::span<const double> x) const;

  /// Index of a variable. Throws InvalidArgument for an unknown name.
  int index(const std::string& variable) const;
};

/// "hexagonal", "symmetric", "symmetric_nonplanar" or "general". Throws InvalidArgument for an unknown name, listing
/// the known ones.
const DesignFamily& design_family(const std::string& name);

/// Names of all families.
std::vector<std::string> design_family_names();

}  // namespace ninedof
