#pragma once
/// How certificates are written: numbers in one spelling, and a checksum.

#include <charconv>
#include <cstdint>
#include <initializer_list>
#include <istream>
#include <string>
#include <vector>

#include "proof/checker/ranges.hpp"

namespace ninedof::checker {

/// Throws std::runtime_error: the certificate is not accepted.
[[noreturn]] void refuse(const std::string& why);

template <class Number, class... Format>
std::string digits(Number x, Format... format) {
  char text[64];
  return {text, std::to_chars(text, text + sizeof text, x, format...).ptr};
}
std::string hexadecimal(double x);
/// " rad (5.72958 deg)" after angles.
std::string in_degrees(std::initializer_list<double> angles);
/// The number of this name, " 2" or " from 2 to 10"; angles in degrees too.
std::string said(const std::string& name, Range range);
/// Fifteen digits, never more than x > 1.
std::string rounded_down(double x);
std::string quoted(const std::string& text);
/// Throws where a word is no hexadecimal number.
double number(const std::string& word);

/// The two lines before the rest of a file: what it is, and the CRC-32 of the rest (ISO 3309, as zlib has it).
std::string sealed(const std::string& kind, const std::string& body);

/// The CRC-32 of bytes that come one after another.
class Checksum {
 public:
  void add(char byte);
  std::string spelled() const;

 private:
  std::uint32_t crc_ = 0xFFFFFFFFU;
};

constexpr const char* damaged = "the checksum does not agree: the file is damaged or was changed";

/// A file that is read once, in pieces: lines of text, then perhaps bytes. What it says counts once `finish` returned.
class Stream {
 public:
  /// Reads the two lines of `sealed`.
  explicit Stream(std::istream& in);
  const std::string& kind() const { return kind_; }
  /// The next line, printable text without its end; false where the file ends.
  bool line(std::string& out);
  unsigned char byte();
  /// Refuses a file that goes on, and one that is not that of its checksum.
  void finish();
  /// Whether the checksum is that of the file, all of which is read.
  bool intact();

 private:
  bool next(char& out);

  std::istream& in_;
  std::vector<char> block_;
  std::size_t at_ = 0, size_ = 0;
  Checksum sum_;
  std::string kind_, checksum_;
};

}  // namespace ninedof::checker
