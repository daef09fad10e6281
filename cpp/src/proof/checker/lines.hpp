#pragma once
/// Certificates of the family "symmetric_nonplanar": docs/certificate.md and docs/theory/proof.md, lemmas 13 and 14.

#include "ninedof/proof/checker.hpp"
#include "proof/checker/certificate_file.hpp"
#include "proof/checker/linear.hpp"

namespace ninedof::checker::lines {

/// Of a design, in characteristic lengths: the line of its external leg, zp - zs, the slopes of an upper and a lower
/// leg, where on the line the joints are, zp, and the vertical parts of an upper and a lower leg.
constexpr std::size_t delta = 0, eta = 1, epsilon = 2, drop = 3, upper = 4, lower = 5, x_b = 6, x_a = 7, zp = 8,
                      upper_up = 9, lower_up = 10, coordinates = 11;
using Box = std::array<Range, coordinates>;
static_assert(coordinates <= symbols);
inline bool empty(const Box& box) {
  return std::ranges::any_of(box, [](Range r) { return r.a > r.b; });
}

/// Bounds in characteristic lengths; triples are external and internal of the base, then of the platform; legs
/// external, upper, lower.
struct Study : RatioLimits {
  double target = 0.0;
  std::array<Range, 4> radius, height;
  Range zp, zs;
  std::array<Range, 3> length, length_in_zp;
  double joint_height = inf, joint_height_in_radius = inf;
  Box box;  ///< holds every design below the target; where an end exceeds the other there is none
};
Study study_of_lines(const Certificate& c);

/// On which sides of O the internal joints are: 1 where the platform's are above it, the base's below it.
struct Sides {
  double upper, lower;
};

/// Of lemma 14: A / tr A - K^2 B / tr B, whose entries belong to axial 11, 12, 22, then transverse 11, Re 12, Im 12,
/// 22; and limits with their weights, in the order of docs/certificate.md.
struct Mixture {
  std::array<Linear, 7> entry;  ///< numbers with an error
  std::vector<std::pair<std::size_t, double>> limits;
};

/// Cuts off what breaks a limit or, by the mixture, has a condition number above the target. False where nothing is
/// left.
bool narrow(const Study& study, Box& box, Sides sides, const Mixture* by);

/// Throws where the tree is refused.
void replay(const Study& study, TreeBytes& tree, const Reading& reading, Verdict& out);

}  // namespace ninedof::checker::lines
