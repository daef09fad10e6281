#include "proof/checker/spelling.hpp"

#include <cmath>
#include <cstdint>
#include <stdexcept>

namespace ninedof::checker {

void refuse(const std::string& why) {
  throw std::runtime_error(why);
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

namespace {

std::uint32_t checksum(const std::string& bytes) {
  std::uint32_t crc = 0xFFFFFFFFU;
  for (const char c : bytes) {
    crc ^= static_cast<unsigned char>(c);
    for (int k = 0; k < 8; ++k) crc = crc >> 1U ^ ((crc & 1U) != 0U ? 0xEDB88320U : 0U);
  }
  return ~crc;
}

}  // namespace

std::string sealed(const std::string& kind, const std::string& body) {
  return kind + "\nchecksum " + digits(checksum(body), 16) + "\n" + body;
}

std::string unsealed(const std::string& kind, const std::string& bytes, std::size_t last) {
  const std::string first = kind + "\nchecksum ";
  if (!bytes.starts_with(first)) refuse("this is no file that begins with " + quoted(kind));
  for (std::size_t k = 0; k < last; ++k)
    if (bytes[k] != '\n' && (bytes[k] < ' ' || bytes[k] > '~')) refuse("its lines hold bytes that are no text");
  const std::string body = bytes.substr(bytes.find('\n', first.size()) + 1);
  if (bytes != sealed(kind, body)) refuse("the checksum does not agree: the file is damaged or was changed");
  return body;
}

}  // namespace ninedof::checker
