#include "proof/checker/certificate_file.hpp"

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <sstream>
#include <stdexcept>

namespace ninedof::checker {

void refuse(const std::string& why) {
  throw std::runtime_error(why);
}

namespace {

double number(const std::string& word) {
  char* end = nullptr;
  const double x = std::strtod(word.c_str(), &end);
  if (word.empty() || end != word.c_str() + word.size() || std::isnan(x)) refuse("\"" + word + "\" is not a number");
  return x;
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

}  // namespace

Certificate read(const std::string& bytes) {
  const std::string first = "ninedof certificate 1\nchecksum ";
  if (bytes.compare(0, first.size(), first) != 0) refuse("this is not a certificate of version 1");
  const std::size_t line_end = bytes.find('\n', first.size());
  if (line_end == std::string::npos) refuse("the file ends in its second line");
  const std::string body = bytes.substr(line_end + 1);
  if (number("0x" + bytes.substr(first.size(), line_end - first.size())) != static_cast<double>(checksum(body)))
    refuse("the checksum does not agree: the file is damaged or was changed");

  Certificate out;
  std::size_t at = 0;
  while (true) {
    const std::size_t end = body.find('\n', at);
    if (end == std::string::npos) refuse("the file has no tree");
    std::istringstream line(body.substr(at, end - at));
    at = end + 1;
    std::string key, a, b, c, more;
    line >> key;
    const auto words = [&](std::string* x, std::string* y, std::string* z) {
      for (std::string* word : {x, y, z})
        if (word != nullptr && !(line >> *word)) refuse("a value of " + key + " is missing");
      if (line >> more) refuse("too many values of " + key);
    };
    if (key == "family") {
      words(&out.family, nullptr, nullptr);
    } else if (key == "target") {
      words(&a, nullptr, nullptr);
      out.target = number(a);
    } else if (key == "characteristic_length") {
      words(&a, nullptr, nullptr);
      out.length = number(a);
    } else if (key == "variable" || key == "limit") {
      words(&a, &b, &c);
      const Range range{number(b), number(c)};
      if (!range.sound()) refuse("the bounds of " + a + " are inverted");
      if (key == "variable") out.variables.emplace_back(a, range);
      else if (const auto [old, first_one] = out.limits.emplace(a, range); !first_one)
        old->second = meet(old->second, range);
    } else if (key == "left_out") {
      // A limit of the study that the proof does without.
    } else if (key == "tree") {
      words(&a, nullptr, nullptr);
      out.tree = body.substr(at);
      if (number(a) != static_cast<double>(out.tree.size())) refuse("the tree is not as long as the file says");
      return out;
    } else {
      refuse("\"" + key + "\" means nothing");
    }
  }
}

}  // namespace ninedof::checker
