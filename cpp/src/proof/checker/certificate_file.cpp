#include "proof/checker/certificate_file.hpp"

#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <stdexcept>

namespace ninedof::checker {

void refuse(const std::string& why) {
  throw std::runtime_error(why);
}

namespace {

template <class Number, class... Format>
std::string digits(Number x, Format... format) {
  std::array<char, 64> text{};
  return {text.data(), std::to_chars(text.data(), text.data() + text.size(), x, format...).ptr};
}

std::string hexadecimal(double x) {
  if (std::isinf(x)) return x > 0.0 ? "inf" : "-inf";
  return (std::signbit(x) ? "-0x" : "0x") + digits(std::abs(x), std::chars_format::hex);
}

std::string quoted(const std::string& text) {
  std::string out(1, '"');
  return out.append(text).append(1, '"');
}

double number(const std::string& word) {
  const bool minus = word.starts_with('-');
  const std::string size = word.substr(minus ? 1 : 0);
  double x = inf;
  if (size != "inf") {
    const char* const end = size.data() + size.size();
    if (!size.starts_with("0x") || std::from_chars(size.data() + 2, end, x, std::chars_format::hex).ptr != end ||
        !std::isfinite(x))
      refuse(quoted(word) + " is not a hexadecimal number");
  }
  return minus ? -x : x;
}

/// CRC-32 of ISO 3309, as zlib has it.
std::uint32_t checksum(const std::string& bytes) {
  std::uint32_t crc = 0xFFFFFFFFU;
  for (const char c : bytes) {
    crc ^= static_cast<unsigned char>(c);
    for (int k = 0; k < 8; ++k) crc = crc >> 1U ^ ((crc & 1U) != 0U ? 0xEDB88320U : 0U);
  }
  return ~crc;
}

std::string written(const Bound& b) {
  return b.name + " " + hexadecimal(b.range.a) + " " + hexadecimal(b.range.b) + "\n";
}

/// Everything before the tree, as docs/certificate.md has it.
std::string written(const Certificate& c, const std::string& body) {
  std::string out = "ninedof certificate 1\nchecksum " + digits(checksum(body), 16) + "\nfamily " + c.family +
                    "\ntarget " + hexadecimal(c.target) + "\ncharacteristic_length " + hexadecimal(c.length) + "\n";
  for (const Bound& b : c.variables) out += "variable " + written(b);
  for (const Bound& b : c.limits) out += "limit " + written(b);
  for (const std::string& limit : c.left_out) out += "left_out " + limit + "\n";
  return out + "tree " + digits(c.tree.size()) + "\n";
}

/// NAME LOW HIGH.
Bound bound(const std::string& text) {
  const std::size_t first = text.find(' '), second = text.find(' ', first + 1);
  if (first == std::string::npos || second == std::string::npos) refuse(quoted(text) + " lacks a bound");
  const Bound out{text.substr(0, first),
                  {number(text.substr(first + 1, second - first - 1)), number(text.substr(second + 1))}};
  if (!out.range.sound()) refuse("the bounds of " + out.name + " are inverted");
  return out;
}

/// The name of a limit, and perhaps where it holds: no other text is printed.
std::string limit(const std::string& text) {
  const std::string name = text.ends_with(" at neutral") ? text.substr(0, text.size() - 11) : text;
  for (const char c : name)
    if (c != '_' && (c < 'a' || c > 'z')) refuse(quoted(text) + " is no name of a limit");
  if (name.empty()) refuse("a limit that is left out has no name");
  return text;
}

}  // namespace

Certificate read(const std::string& bytes) {
  const std::string first = "ninedof certificate 1\nchecksum ";
  if (!bytes.starts_with(first)) refuse("this is not a certificate of version 1");
  const std::size_t lines = bytes.find("\ntree ");
  if (lines == std::string::npos) refuse("the file has no tree");
  for (std::size_t k = 0; k < lines; ++k)
    if (bytes[k] != '\n' && (bytes[k] < ' ' || bytes[k] > '~')) refuse("its lines hold bytes that are no text");
  std::size_t at = bytes.find('\n', first.size()) + 1;
  const std::string body = bytes.substr(at);
  if (bytes.substr(first.size(), at - 1 - first.size()) != digits(checksum(body), 16))
    refuse("the checksum does not agree: the file is damaged or was changed");

  Certificate out;
  for (std::string key; key != "tree";) {
    const std::size_t end = bytes.find('\n', at), space = bytes.find(' ', at);
    if (end == std::string::npos) refuse("the file ends before its tree");
    if (space > end) refuse(quoted(bytes.substr(at, end - at)) + " means nothing");
    key = bytes.substr(at, space - at);
    const std::string value = bytes.substr(space + 1, end - space - 1);
    at = end + 1;
    if (key == "family") out.family = value;
    else if (key == "target") out.target = number(value);
    else if (key == "characteristic_length") out.length = number(value);
    else if (key == "variable") out.variables.push_back(bound(value));
    else if (key == "limit") out.limits.push_back(bound(value));
    else if (key == "left_out") out.left_out.push_back(limit(value));
    else if (key != "tree") refuse(quoted(key) + " means nothing");
  }
  out.tree = bytes.substr(at);
  if (bytes.substr(0, at) != written(out, body))
    refuse("its lines are not written as the search writes them: in order, numbers in one spelling");
  return out;
}

std::vector<std::string> study_of(const Certificate& c) {
  std::vector<std::string> out{c.family + " designs with 0 < zs < zp", "characteristic length " + digits(c.length)};
  for (const std::vector<Bound>& bounds : {c.variables, c.limits})
    for (const auto& [name, range] : bounds) {
      const std::string low = digits(range.a), high = digits(range.b);
      out.push_back(low == high ? name + " " + low : name + " from " + low + " to " + high);
    }
  for (const std::string& limit : c.left_out) out.push_back("without the limit " + limit);
  return out;
}

}  // namespace ninedof::checker
