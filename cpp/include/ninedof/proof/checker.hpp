#pragma once
/// Checks a certificate of the optimum. Shares no source with the search that wrote it: its own intervals, its own
/// formulas, from docs/certificate.md alone.

#include <string>

namespace ninedof::checker {

struct Verdict {
  bool proved = false;
  std::string words;  ///< what is proved, or why the certificate is refused
  long leaves = 0;    ///< boxes looked at
  long recut = 0;     ///< of these, boxes that were cut further to see it
};

/// `certificate`: the bytes of the file.
Verdict check(const std::string& certificate);

}  // namespace ninedof::checker
