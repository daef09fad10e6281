#pragma once
/// Checks a certificate of the optimum, of a set of admissible designs, or of a workspace. Shares no source with the
/// search that wrote it: its own numbers, its own formulas, from docs/certificate.md alone.

#include <cstddef>
#include <functional>
#include <istream>
#include <string>
#include <string_view>
#include <vector>

namespace ninedof::checker {

struct Verdict {
  bool proved = false;
  bool incomplete = false;  ///< nothing in it is wrong as far as was seen, and not all of it was confirmed
  std::string words;  ///< what is proved, or why the certificate is refused
  std::vector<std::string> study;  ///< of a proof: the designs or the robot that it is about, as the checker read them
  long leaves = 0;  ///< boxes looked at
  long recut = 0;  ///< of these, boxes that were cut further to see it
};

/// Called now and then with the bytes of the tree that are read, and all of them. What it throws ends the check, unless
/// it is a std::exception: then the certificate counts as refused.
using Reading = std::function<void(std::size_t done, std::size_t total)>;

/// `certificate`: the file, read once in pieces. Of a tree nothing is kept, of a set its boxes.
Verdict check(std::istream& certificate, const Reading& reading = {});
/// The bytes of the file.
Verdict check(std::string_view certificate, const Reading& reading = {});

}  // namespace ninedof::checker
