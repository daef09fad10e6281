#pragma once
/// What a certificate says, before anything of it is believed.

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "proof/checker/ranges.hpp"

namespace ninedof::checker {

/// Throws std::runtime_error: the certificate is not accepted.
[[noreturn]] void refuse(const std::string& why);

/// Bounds are as they stand in the file, in the unit of the study.
struct Certificate {
  std::string family;
  double target = 0.0, length = 0.0;
  std::vector<std::pair<std::string, Range>> variables;
  std::map<std::string, Range> limits;
  std::string tree;
};

Certificate read(const std::string& bytes);

}  // namespace ninedof::checker
