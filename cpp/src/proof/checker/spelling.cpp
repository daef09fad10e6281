#include "proof/checker/spelling.hpp"

#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <stdexcept>

namespace ninedof::checker {

void refuse(const std::string& why) {
  throw std::runtime_error(why);
}

std::string in_degrees(std::initializer_list<double> angles) {
  std::string out;
  for (const double angle : angles) {
    if (!out.empty()) out += ", ";
    out += digits(angle * 57.29577951308232, std::chars_format::general, 6);
  }
  return " rad (" + out + " deg)";
}

std::string said(const std::string& name, Range range) {
  const bool angle = name == "theta_z" || name.ends_with("_angle"), one = range.a == range.b;
  std::string out = name + (one ? " " + digits(range.a) : " from " + digits(range.a) + " to " + digits(range.b));
  if (angle) out += one ? in_degrees({range.a}) : in_degrees({range.a, range.b});
  return out;
}

std::string hexadecimal(double x) {
  if (std::isinf(x)) return x > 0.0 ? "inf" : "-inf";
  return (std::signbit(x) ? "-0x" : "0x") + digits(std::abs(x), std::chars_format::hex);
}

std::string rounded_down(double x) {
  std::array<char, 400> exact{};  // of at most 52 binary places, which 52 decimal ones hold
  std::snprintf(exact.data(), exact.size(), "%.52f", x);
  std::string text(exact.data());
  const std::size_t point = text.find('.');
  text.resize(point + 1 + (point < 15 ? 15 - point : 0));
  while (text.back() == '0') text.pop_back();
  if (text.back() == '.') text.pop_back();
  return text;
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

namespace {

constexpr std::array<std::uint32_t, 256> remainders = [] {
  std::array<std::uint32_t, 256> out{};
  for (std::uint32_t n = 0; n < 256; ++n) {
    out[n] = n;
    for (int k = 0; k < 8; ++k) out[n] = out[n] >> 1U ^ ((out[n] & 1U) != 0U ? 0xEDB88320U : 0U);
  }
  return out;
}();

}  // namespace

void Checksum::add(char byte) {
  crc_ = crc_ >> 8U ^ remainders[(crc_ ^ static_cast<unsigned char>(byte)) & 0xFFU];
}
std::string Checksum::spelled() const {
  return digits(~crc_, 16);
}

std::string sealed(const std::string& kind, const std::string& body) {
  Checksum sum;
  for (const char c : body) sum.add(c);
  return kind + "\nchecksum " + sum.spelled() + "\n" + body;
}

Stream::Stream(std::istream& in) : in_(in), block_(std::size_t{1} << 16U) {
  const std::string key = "checksum ";
  const auto read = [this](std::string& out) {
    try {
      return line(out);
    } catch (const std::runtime_error&) {  // no lines of text
      return false;
    }
  };
  if (!read(kind_) || !read(checksum_) || !checksum_.starts_with(key)) refuse("this is no certificate");
  checksum_.erase(0, key.size());
  sum_ = {};
}

bool Stream::next(char& out) {
  if (at_ == size_) {
    in_.read(block_.data(), std::ssize(block_));
    at_ = 0;
    size_ = static_cast<std::size_t>(in_.gcount());
    if (size_ == 0) return false;
  }
  out = block_[at_++];
  sum_.add(out);
  return true;
}

bool Stream::line(std::string& out) {
  constexpr std::size_t longest = 10'000;
  out.clear();
  for (char c = 0; next(c);) {
    if (c == '\n') return true;
    if (c < ' ' || c > '~' || out.size() == longest) refuse("its lines hold bytes that are no text");
    out += c;
  }
  if (!out.empty()) refuse("the last line has no end");
  return false;
}

unsigned char Stream::byte() {
  char c = 0;
  if (!next(c)) refuse("the tree ends too early");
  return static_cast<unsigned char>(c);
}

void Stream::finish() {
  char c = 0;
  if (next(c)) refuse("the file goes on after its end");
  if (!intact()) refuse(damaged);
}

bool Stream::intact() {
  for (char c = 0; next(c);) {
  }
  return sum_.spelled() == checksum_;
}

}  // namespace ninedof::checker
