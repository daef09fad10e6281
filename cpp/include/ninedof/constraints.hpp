#pragma once
/// Design constraints as signed margins: positive where the design is allowed, zero on the limit, in logarithms of the
/// ratio that is left (0.01 is one per cent to spare).

#include <limits>
#include <string>
#include <vector>

#include "ninedof/design.hpp"

namespace ninedof {

/// low <= named ratio <= high; a low of 0 or less and a high of infinity leave that side open.
///
/// Names: "radius_ratio" (base / platform radius, the largest joint radius of each), "leg_ratio" (longest / shortest leg),
/// "zs_fraction" (zs / zp). zs < zp (eq. 9b) holds everywhere without being asked for.
struct Limit {
  std::string name;
  double low = 0.0;
  double high = std::numeric_limits<double>::infinity();
};

/// One margin: the largest of a few linear forms of the quantities. A limit that holds when any one of several
/// inequalities holds (a least leg ratio) has several forms; all others have one.
struct Margin {
  struct Form {
    double constant = 0.0;
    Eigen::Matrix<double, quantity_count, 1> coefficients = Eigen::Matrix<double, quantity_count, 1>::Zero();
  };
  std::string name;
  std::vector<Form> forms;

  /// The form that is largest at a design.
  const Form& governing(const DesignPoint& p) const;
  double value(const DesignPoint& p) const;
  Eigen::VectorXd gradient(const DesignPoint& p) const;
};

/// The margins a set of limits asks for. Throws InvalidArgument for an unknown name, a limit that is not a number, a
/// high that is not positive, or low > high.
std::vector<Margin> margins(const std::vector<Limit>& limits);

/// Names of all constraints.
std::vector<std::string> constraint_names();

}  // namespace ninedof
