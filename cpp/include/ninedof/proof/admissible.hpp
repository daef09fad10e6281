#pragma once
/// Sets of admissible designs: a box of some variables of a study divided into what keeps every limit at every pose,
/// proved, what breaks one, proved, and the rest (docs/theory/admissible.md).
///
/// Assumed: the arithmetic of interval.hpp.

#include <array>
#include <limits>
#include <string>
#include <vector>

#include "ninedof/math/control.hpp"
#include "ninedof/problem/problem.hpp"
#include "ninedof/proof/machine.hpp"

namespace ninedof {

inline constexpr std::size_t most_varied = 6;

/// Which designs, and what they have to keep.
struct DesignQuestion {
  Problem problem;  ///< its limits, and those of the condition number, at its poses or over the region
  std::vector<Region> region = {};  ///< none or one
  std::vector<double> at = {};      ///< a value for each variable of the family
  std::vector<int> varied = {};     ///< indices of the variables that vary, one to six
  std::vector<double> low = {}, high = {};  ///< of each
  double condition = std::numeric_limits<double>::infinity();  ///< greatest condition number besides those of the study

  /// Throws InvalidArgument naming what is wrong, or what has no bounds over boxes of designs.
  /// `machine`: nothing varies.
  void validate(bool machine = false) const;
};

/// A number that a limit is about: what a part breaks.
struct Demand {
  std::string limit;  ///< its label; "no singularity", "condition_number"
  std::string part;  ///< the leg, pair of legs or determinant; empty where there is none
};

enum class Membership { inside, outside, undecided };

/// A box of designs, its ends in the order of `varied`.
struct DesignPiece {
  std::array<double, most_varied> low{}, high{};
  Membership state = Membership::undecided;
  int demand = -1;  ///< of those outside: which is broken by all of them
  MetAt at;  ///< and at which pose; of limits without a pose that of the neutral one
  MetAt other = {};  ///< of a spread of lengths where the leg is shortest; `at` is where it is longest
};

struct DesignSettings {
  int threads = 0;  ///< 0: one per processor
  double seconds = 60.0;  ///< of wall time
  double resolution = 0.0;  ///< boxes are not divided below this part of each range
  double undecided = 0.0;  ///< the search ends where no more of the volume is left
  bool keep_outside = false;  ///< of any_admissible: the boxes outside, for a certificate
};

struct DesignSet {
  std::vector<Demand> demands;
  std::vector<DesignPiece> pieces;  ///< a partition of the box
  double inside = 0.0, outside = 0.0, undecided = 1.0;  ///< shares of the volume
  long looked_at = 0;  ///< boxes of designs
  long boxes = 0;  ///< of poses, with a box of designs each
  bool interrupted = false;
};

/// Divides the box until the settings end it; anytime. `from`: the undecided pieces of a run of the same question.
DesignSet admissible_designs(const DesignQuestion& question, const DesignSettings& settings,
                             const std::vector<DesignPiece>& from = {}, const Control& control = {});

/// Whether any design of the box is inside.
struct DesignExistence {
  enum class State { exists, none, undecided } state = State::undecided;  ///< the first two are proved
  std::array<double, most_varied> design{};  ///< that is inside, in the order of `varied`
  long open = 0;  ///< boxes of designs that are left
  long looked_at = 0;  ///< boxes of designs
  bool interrupted = false;
  DesignSet refuted;  ///< of `none`, where they are kept: all designs, in boxes outside
};
/// Poses are not covered but met: of each box those where designs near it broke a limit. Where a middle breaks none,
/// its own worst poses join them, and where there are none, the middle is a design that is inside. Of the settings
/// `undecided` has no meaning.
DesignExistence any_admissible(const DesignQuestion& question, const DesignSettings& settings,
                               const Control& control = {});

/// A file that ninedof_check replays: the question, and the pieces with their reasons (docs/certificate.md).
std::string design_certificate(const DesignQuestion& question, const DesignSet& set);

/// The file of a machine that keeps its limits, up to a slack as in `limits_over_poses`: a set of one design, `at`,
/// inside.
std::string machine_certificate(DesignQuestion question, double slack);

/// A box around a design, all of which is inside.
struct DesignRoom {
  bool found = false;  ///< not where the design breaks a limit, or where nothing could be proved
  std::array<double, most_varied> low{}, high{};
  int demand = -1;  ///< which the design breaks, proved; -1: none is known
  /// What designs just beyond a side break, proved, and at which pose; -1: none is known.
  struct Beyond {
    int demand = -1;
    MetAt at;
  };
  std::array<std::array<Beyond, 2>, most_varied> beyond{};  ///< of each variable below and above
  long boxes = 0;
};

/// The largest box around a design, within the ends of the question: its half widths are in the given proportions, or
/// without them the product of the room to all sides is greatest, so that there is room to each. A local search of
/// boxes each of which is proved; it ends after `most_boxes` of poses.
DesignRoom room_around(const DesignQuestion& question, const std::vector<double>& design,
                       const std::vector<double>& proportions, long most_boxes, const Control& control = {});

}  // namespace ninedof
