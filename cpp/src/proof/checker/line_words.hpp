#pragma once
/// How a line of a certificate is read.

#include <array>
#include <charconv>
#include <cmath>
#include <string>

#include "proof/checker/designs_file.hpp"

namespace ninedof::checker::sets {

/// The words of a line, one after another.
class LineWords {
 public:
  explicit LineWords(const std::string& line) : line_(line) {}
  bool done() const { return at_ > line_.size(); }
  std::string word() {
    if (done()) refuse(quoted(line_) + " ends too early");
    const std::size_t end = std::min(line_.find(' ', at_), line_.size());
    std::string out = line_.substr(at_, end - at_);
    at_ = end + 1;
    return out;
  }
  /// Each number has one spelling. Products of larger ones overflow, and what is not known is divided for minutes.
  double real(bool finite = true) {
    const std::string text = word();
    const double out = number(text);
    if (finite && !(std::abs(out) <= 1e100)) refuse(quoted(line_) + " has a number above 1e100");
    if (hexadecimal(out) != text) refuse(quoted(text) + " is not spelled as " + quoted(hexadecimal(out)));
    return out;
  }
  int whole() {
    const std::string text = word();
    int out = 0;
    std::from_chars(text.data(), text.data() + text.size(), out);
    if (digits(out) != text) refuse(quoted(text) + " is not a whole number");
    return out;
  }
  template <std::size_t N>
  std::array<double, N> reals() {
    std::array<double, N> out{};
    for (double& x : out) x = real();
    return out;
  }
  Range range() {
    const Range out{real(false), real(false)};
    if (!out.sound()) refuse("the bounds of " + quoted(line_) + " are inverted");
    return out;
  }
  /// Whether the first of two words stands there.
  bool either(const char* yes, const char* no) {
    const std::string text = word();
    if (text != yes && text != no) refuse(quoted(text) + " is neither " + quoted(yes) + " nor " + quoted(no));
    return text == yes;
  }
  Patch pose() {
    Patch out;
    out.piece = whole();
    out.low = out.high = reals<pose_symbols>();
    return out;
  }

 private:
  const std::string& line_;
  std::size_t at_ = 0;
};

}  // namespace ninedof::checker::sets
