#pragma once
/// What a certificate says, before anything of it is believed.

#include <bit>
#include <cmath>
#include <string>
#include <vector>

#include "ninedof/proof/checker.hpp"
#include "proof/checker/spelling.hpp"

namespace ninedof::checker {

/// A variable or a limit, in the unit of the study.
struct Bound {
  std::string name;
  Range range;
  std::string of = {};  ///< what a limit of non-planar designs is a fraction of: zp, radius, or nothing
};

struct Certificate {
  std::string family;
  double target = 0.0;
  std::string length_kind;  ///< empty where the characteristic length is a number or free
  Range length;
  std::vector<Bound> variables, limits;
  std::vector<std::string> left_out;  ///< limits of the study that the proof does without
  std::size_t tree = 0;             ///< bytes that follow the lines
};

/// The limits that every kind of optimum knows.
struct RatioLimits {
  Range fraction{0.0, 1.0}, radius_ratio{0.0, inf};  ///< fraction: zs / zp
  double leg_ratio = inf;
  /// False for another limit.
  bool take(const Bound& limit);
};

/// Accepts one spelling of each certificate: that in which its lines are written anew from what was read.
Certificate read(Stream& file);

constexpr const char* kind_of_optimum = "ninedof certificate 1";

/// Of what a certificate may have: 0, infinite, or such that squares and most products stay among the doubles.
inline bool ordinary(double x) {
  constexpr double smallest = 1e-100, largest = 1e100;
  return x == 0.0 || std::isinf(x) || (std::abs(x) >= smallest && std::abs(x) <= largest);
}

/// The study for people, one line each: what was read is what is checked and what is printed.
std::vector<std::string> study_of(const Certificate& c);

/// The bytes of a tree, as they come.
class TreeBytes {
 public:
  TreeBytes(Stream& file, std::size_t size) : file_(file), size_(size) {}

  std::size_t read() const { return at_; }
  std::size_t size() const { return size_; }

  unsigned byte() {
    if (at_++ == size_) refuse("the tree ends too early");
    return file_.byte();
  }
  /// The lowest byte first.
  unsigned pair() {
    const unsigned low = byte();
    return low | byte() << 8U;
  }
  float real() { return std::bit_cast<float>(four()); }
  double long_real() {
    const std::uint64_t low = four();
    return std::bit_cast<double>(low | static_cast<std::uint64_t>(four()) << 32U);
  }
  void finish() const {
    if (at_ != size_) refuse("the tree goes on after its last box");
  }

 private:
  std::uint32_t four() {
    const std::uint32_t low = pair();
    return low | static_cast<std::uint32_t>(pair()) << 16U;
  }

  Stream& file_;
  std::size_t size_, at_ = 0;
};

/// Boxes that wait are halves of one another: more than these are no search's.
constexpr std::size_t most_waiting = 5000;

/// Counts a closed box, and tells now and then how much is read.
inline void count_leaf(const TreeBytes& tree, const Reading& reading, Verdict& out) {
  constexpr long between_reports = 256;
  if (reading && out.leaves % between_reports == 0) reading(tree.read(), tree.size());
  ++out.leaves;
}

/// Whether a box may be cut further than the tree has it; counts that. A sound certificate needs one for each four
/// boxes.
inline bool may_recut(int depth, Verdict& out) {
  constexpr int deepest = 12;
  constexpr long to_begin_with = 10'000;
  if (depth == deepest || out.recut >= to_begin_with + out.leaves) return false;
  ++out.recut;
  return true;
}

}  // namespace ninedof::checker
