#pragma once
/// What a box of designs has to keep, item after item: a number over boxes of poses, as planes over the designs.

#include <map>
#include <memory>
#include <string>
#include <tuple>
#include <vector>

#include "limits/leg_clearance.hpp"
#include "limits/table.hpp"
#include "proof/admissible/designs.hpp"
#include "proof/region/pose.hpp"

namespace ninedof::admissible {

using over_region::Box;
using over_region::Domain;

/// c + a . t, where the coordinates t of a box of designs go from -1 to 1.
struct Plane {
  double c = 0.0;
  std::array<double, most_varied> a{};
};
double slopes_of(const Plane& p);
inline double least_of(const Plane& p) {
  return p.c - slopes_of(p);
}
inline double most_of(const Plane& p) {
  return p.c + slopes_of(p);
}
/// x + k y, its level moved by what rounding may take.
Plane below_sum(const Plane& x, double k, const Plane& y);

/// The poses of a study: those of its region or its list, the neutral one first among the listed.
class Poses {
 public:
  explicit Poses(const DesignQuestion& question);
  Poses(const Poses&) = delete;  // the domain refers to the machine beside it
  Poses& operator=(const Poses&) = delete;
  const Domain& domain() const { return domain_; }
  /// Where limits at poses hold; the neutral pose alone.
  const std::vector<Box>& all() const { return all_; }
  const std::vector<Box>& neutral() const { return neutral_; }
  template <class T>
  PoseOf<T> pose(const Box& box, const DesignsOf<T>& designs) const;

 private:
  const DesignQuestion& question_;
  PosedRobot machine_;
  Domain domain_;
  std::vector<Box> all_, neutral_;
};

/// A number over a box of poses, positive where a limit is kept.
struct Seen {
  bool known = false;
  Plane kept;  ///< at every pose of the box the number is at least this
  std::array<double, PoseForm::size> slope{};
  Moves moves;
};

/// The number at one pose: at most this, and by how much that may be too high.
struct Met {
  bool known = false;
  Plane most;
  double open = 0.0;
};

/// A demand's item at poses.
struct Item {
  enum class Kind { number, pair, condition } kind = Kind::number;
  const PoseRow* row = nullptr;
  int item = 0;
  int demand = 0;        ///< place in the list of demands
  int limit = 0;         ///< place among the limits, for its axes
  Side side = Side::high;
  double bound = 0.0;    ///< a number as people read it; zero of a determinant
  bool of_zp = false;    ///< the bound is a share of zp
  bool at_neutral = false, with_neutral = false;  ///< at the neutral pose alone, or there too
  int locked = -1;       ///< of the condition number
};

/// One leg's length over all poses: l, or less l.
struct Length {
  int leg;
  double sign;
};

/// A box of designs with all that items share.
class DesignsAt {
 public:
  DesignsAt(const DesignQuestion& question, const Poses& poses, const DesignBox& box);
  bool known() const { return known_; }
  const DesignForms& forms() const { return forms_; }
  const Poses& poses() const { return poses_; }
  /// How much the designs move the legs at the neutral pose, as parts of their lengths.
  double moves() const { return moves_; }
  Seen look(const Item& item, const Box& box) const;
  Met meet(const Item& item, const Box& point) const;
  /// As `meet`, of a condition number by forms of second degree: what they leave open falls with the third power of the
  /// box.
  Met meet_closely(const Item& item, const Box& point) const;
  Seen look(const Length& length, const Box& box) const;
  Met meet(const Length& length, const Box& point) const;

 private:
  DesignForm number(const Item& item, const DesignForm& u) const;
  /// What the number is of, over a box of poses: all items of a row at once, where that is less work.
  DesignForm form_over(const Item& item, const DesignLook& look, const Box& box) const;
  Seen pair_apart(const Item& item, const DesignLook& look, const Box& box) const;
  Seen apart_along(const Item& item, const LegPairOf<DesignForm>& legs, const DesignVector& direction,
                   const Box& box) const;
  Seen seen(const DesignForm& f, const Box& box) const;
  template <class T>
  Met condition(const DesignsOf<T>& designs, const Item& item, const Box& point) const;

  const DesignQuestion& question_;
  const Poses& poses_;
  DesignForms forms_;
  DesignsOf<CurvedForm> curved_;
  std::vector<HomeOf<DesignForm>> homes_;
  bool known_ = true;
  double moves_ = 0.0;
  std::array<bool, 3> side_known_{};  ///< of each determinant: of one sign at home, in all designs
  /// For the other items of the row and of the same duty.
  mutable std::map<std::tuple<const PoseRow*, const Duty*, Box>, std::array<DesignForm, 9>> of_rows_;
};

}  // namespace ninedof::admissible
