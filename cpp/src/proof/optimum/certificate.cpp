#include "proof/optimum/certificate.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "ninedof/families/design_family.hpp"

namespace ninedof::proof {

std::string hexadecimal(double x) {
  if (std::isinf(x)) return x > 0.0 ? "inf" : "-inf";
  std::array<char, 40> text{};
  const auto end = std::to_chars(text.data(), text.data() + text.size(), std::abs(x), std::chars_format::hex).ptr;
  return (std::signbit(x) ? "-0x" : "0x") + std::string(text.data(), end);
}

namespace {

/// CRC-32 of ISO 3309, as zlib has it: against damage, not against malice, for which the tree itself is checked.
std::uint32_t checksum(const std::string& bytes) {
  std::uint32_t crc = 0xFFFFFFFFU;
  for (const char c : bytes) {
    crc ^= static_cast<unsigned char>(c);
    for (int k = 0; k < 8; ++k) crc = (crc >> 1U) ^ ((crc & 1U) != 0U ? 0xEDB88320U : 0U);
  }
  return ~crc;
}

}  // namespace

std::string sealed(const std::string& kind, const std::string& body) {
  std::array<char, 9> sum{};
  std::to_chars(sum.data(), sum.data() + 8, checksum(body), 16);
  return kind + "\nchecksum " + std::string(sum.data()) + "\n" + body;
}

namespace {

const char* word_of(LengthKind kind) {
  switch (kind) {
    case LengthKind::mean_leg: return "mean_leg";
    case LengthKind::platform_radius: return "platform_radius";
    case LengthKind::natural: return "natural";
    case LengthKind::optimal: break;
  }
  return "optimal";
}

std::string length_line(const StudyLength& length) {
  using Choice = StudyLength::Choice;
  if (length.choice == Choice::number) return hexadecimal(length.value);
  if (length.choice == Choice::kind) return word_of(length.kind);
  const auto [low, high] = length.bounds;
  return hexadecimal(low) + (low == high ? "" : " " + hexadecimal(high));
}

}  // namespace

std::string certificate(const Problem& study, double target, const std::vector<std::string>& left_out,
                        const std::vector<std::uint8_t>& tree) {
  std::string body = "family " + study.family + "\ntarget " + hexadecimal(target) + "\ncharacteristic_length " +
                     length_line(study.characteristic_length) + "\n";
  const auto range = [&](const std::string& kind, const std::string& name, double low, double high) {
    body += kind + " " + name + " " + hexadecimal(low) + " " + hexadecimal(high) + "\n";
  };
  const std::vector<VariableInfo>& names = design_family(study.family).variables();
  for (std::size_t k = 0; k < names.size(); ++k)
    range("variable", names[k].name, study.variables[k].low, study.variables[k].high);
  for (const Limit& limit : study.limits) {
    if (std::ranges::find(left_out, limit.label()) != left_out.end()) continue;
    range("limit", limit.name, std::max(limit.low, 0.0), limit.high);
    if (limit.of != Unit::length) body.insert(body.size() - 1, std::string(" ") + to_string(limit.of));
  }
  for (const std::string& limit : left_out) body += "left_out " + limit + "\n";
  body += "tree " + std::to_string(tree.size()) + "\n";
  body.append(tree.begin(), tree.end());
  return sealed("ninedof certificate 1", body);
}

}  // namespace ninedof::proof
