#pragma once
/// What a certificate says, before anything of it is believed.

#include <string>
#include <vector>

#include "proof/checker/spelling.hpp"

namespace ninedof::checker {

/// A variable or a limit, in the unit of the study.
struct Bound {
  std::string name;
  Range range;
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

/// Accepts one spelling of each certificate: that in which its lines are written anew from what was read.
Certificate read(Stream& file);

constexpr const char* kind_of_optimum = "ninedof certificate 1";

/// The study for people, one line each: what was read is what is checked and what is printed.
std::vector<std::string> study_of(const Certificate& c);

}  // namespace ninedof::checker
