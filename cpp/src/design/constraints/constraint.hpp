#pragma once
/// One limit as margins. A constraint says what it measures; this base makes signed, relative margins of it.

#include <memory>
#include <string>

#include "design/design_state.hpp"
#include "math/numbers.hpp"
#include "ninedof/design/constraints.hpp"

namespace ninedof {

/// Which limit a margin keeps.
enum class Side { high, low };

class Constraint {
 public:
  explicit Constraint(const Limit& limit) : limit_(limit) {}
  virtual ~Constraint() = default;

  const Limit& limit() const { return limit_; }
  int rows() const { return (has_high() ? items(Side::high) : 0) + (has_low() ? items(Side::low) : 0); }
  double margin(const DesignState& v, int row) const;
  void add_gradient(const DesignState& v, int row, Row out) const;

  /// Whether margins that agree at a few unrelated designs are one function: not so where they are made of pieces.
  virtual bool analytic() const { return true; }

  /// How much more is missing than a violated row says: twice, where a auxiliary variable shares it between two rows.
  virtual double violation_factor(int) const { return 1.0; }

  /// Told of a few unrelated designs within the study's bounds: what holds in all of them holds by construction.
  virtual void learn(const std::vector<DesignState>&) {}

  /// How the margin of a row moves with the logarithm of its limit, at the limit: 1, or 0 for a row that only helps another.
  virtual double price_factor(int row) const;

  /// Variables of its own that make a margin smooth, see spread.hpp: how many, and the first one's place among full variables
  /// and free coordinates.
  virtual int auxiliary_count() const { return 0; }
  void set_auxiliary(int variable, int coordinate) {
    auxiliary_variable_ = variable;
    auxiliary_coordinate_ = coordinate;
  }
  int auxiliary_variable() const { return auxiliary_variable_; }
  /// Their best values for a design.
  virtual double auxiliary_value(const DesignState&, int) const { return 0.0; }

 protected:
  enum class Form {
    logarithm,  ///< log(high / value), log(value / low): for what has no zero
    linear,     ///< 1 - value / high, value / low - 1
    plain       ///< value - low
  };
  virtual Form form() const { return Form::logarithm; }
  /// How many margins a side has.
  virtual int items(Side side) const = 0;
  /// The value limited, and `scale` times its derivatives.
  virtual double value(const DesignState&, Side, int) const { return 0.0; }
  virtual void add_value_gradient(const DesignState&, Side, int, double, Row) const {}
  /// The margin of an item: made of its value, unless a constraint knows better.
  virtual double item_margin(const DesignState& v, Side side, int item) const;
  virtual void add_item_gradient(const DesignState& v, Side side, int item, Row out) const;

  bool has_high() const { return limit_.high < infinity; }
  bool has_low() const;
  double bound(Side side) const { return side == Side::high ? limit_.high : limit_.low; }
  std::pair<Side, int> item_of(int row) const;
  /// What lengths are fractions of, and its derivatives.
  double unit(const DesignState& v) const;
  void add_unit_gradient(const DesignState& v, double scale, Row out) const;
  int auxiliary_coordinate() const { return auxiliary_coordinate_; }

 private:
  Limit limit_;
  int auxiliary_variable_ = -1, auxiliary_coordinate_ = -1;
};

/// What rows are for: the solver, which needs them smooth, or a look at one design, which needs the one that matters.
enum class Purpose { solve, evaluate };

/// The constraint of a limit, for `poses` displaced poses (0: the neutral one alone). Valid limits only.
std::unique_ptr<Constraint> make_constraint(const Limit& limit, int poses, Purpose purpose);

// One a file.
std::unique_ptr<Constraint> make_radius_ratio(const Limit& limit, int poses, Purpose purpose);
std::unique_ptr<Constraint> make_leg_ratio(const Limit& limit, int poses, Purpose purpose);
std::unique_ptr<Constraint> make_stroke(const Limit& limit, int poses, Purpose purpose);
std::unique_ptr<Constraint> make_leg_length(const Limit& limit, int poses, Purpose purpose);
std::unique_ptr<Constraint> make_height(const Limit& limit, int poses, Purpose purpose);
std::unique_ptr<Constraint> make_footprint(const Limit& limit, int poses, Purpose purpose);
std::unique_ptr<Constraint> make_joint_height(const Limit& limit, int poses, Purpose purpose);
std::unique_ptr<Constraint> make_joint_spacing(const Limit& limit, int poses, Purpose purpose);
std::unique_ptr<Constraint> make_leg_clearance(const Limit& limit, int poses, Purpose purpose);
std::unique_ptr<Constraint> make_joint_cone(const Limit& limit, int poses, Purpose purpose);
std::unique_ptr<Constraint> make_zs_fraction(const Limit& limit, int poses, Purpose purpose);
std::unique_ptr<Constraint> make_between_plates(std::vector<int> poses);
std::unique_ptr<Constraint> make_singularity_free(const Limit& limit, int poses, Purpose purpose);

/// Distance of a joint from z in its body's frame, and the joint of a body (0 base, 6 platform, six joints each; -1 for both)
/// that is farthest.
double joint_radius(const DesignState& v, int joint);
int widest_joint(const DesignState& v, int body);
void add_joint_radius(const DesignState& v, int joint, double scale, Row out);

}  // namespace ninedof
