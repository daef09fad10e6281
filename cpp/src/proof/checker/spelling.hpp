#pragma once
/// How certificates are written: numbers in one spelling, and a checksum.

#include <charconv>
#include <string>

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
std::string quoted(const std::string& text);
/// Throws where a word is no hexadecimal number.
double number(const std::string& word);

/// The two lines before the rest of a file: what it is, and the CRC-32 of the rest (ISO 3309, as zlib has it).
std::string sealed(const std::string& kind, const std::string& body);
/// What follows these two lines, if they are right and the lines before `last` are printable text.
std::string unsealed(const std::string& kind, const std::string& bytes, std::size_t last);

}  // namespace ninedof::checker
