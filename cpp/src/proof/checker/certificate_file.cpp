#include "proof/checker/certificate_file.hpp"

namespace ninedof::checker {

namespace {

std::string written(const Bound& b) {
  return b.name + " " + hexadecimal(b.range.a) + " " + hexadecimal(b.range.b) + (b.of.empty() ? "" : " " + b.of) + "\n";
}

std::string length(const Certificate& c) {
  if (!c.length_kind.empty()) return c.length_kind;
  return hexadecimal(c.length.a) + (c.length.a == c.length.b ? "" : " " + hexadecimal(c.length.b));
}

/// The lines that follow the checksum, as docs/certificate.md has them.
std::string written(const Certificate& c) {
  std::string out =
      "family " + c.family + "\ntarget " + hexadecimal(c.target) + "\ncharacteristic_length " + length(c) + "\n";
  for (const Bound& b : c.variables) out += "variable " + written(b);
  for (const Bound& b : c.limits) out += "limit " + written(b);
  for (const std::string& limit : c.left_out) out += "left_out " + limit + "\n";
  return out + "tree " + digits(c.tree) + "\n";
}

/// NAME LOW HIGH, perhaps with a unit.
Bound bound(const std::string& text) {
  const std::size_t first = text.find(' '), second = text.find(' ', first + 1);
  if (first == std::string::npos || second == std::string::npos) refuse(quoted(text) + " lacks a bound");
  const std::size_t third = std::min(text.find(' ', second + 1), text.size());
  const Bound out{
      text.substr(0, first),
      {number(text.substr(first + 1, second - first - 1)), number(text.substr(second + 1, third - second - 1))},
      text.substr(std::min(third + 1, text.size()))};
  if (third < text.size() && out.of != "zp" && out.of != "radius") refuse(quoted(text) + " has no unit");
  if (!out.range.sound()) refuse("the bounds of " + out.name + " are inverted");
  return out;
}

/// L, LOW HIGH or a word.
void read_length(const std::string& text, Certificate& c) {
  for (const char* kind : {"optimal", "natural", "mean_leg", "platform_radius"})
    if (text == kind) c.length_kind = text;
  if (!c.length_kind.empty()) return;
  const std::size_t space = text.find(' ');
  c.length = number(text.substr(0, space));
  if (space != std::string::npos) c.length.b = number(text.substr(space + 1));
}

/// The name of a limit, perhaps where it holds and which side of it: no other text is printed.
std::string limit(const std::string& text) {
  std::string name = text;
  for (const std::string_view end : {".min", " at neutral"})
    if (name.ends_with(end)) name.resize(name.size() - end.size());
  for (const char c : name)
    if (c != '_' && (c < 'a' || c > 'z')) refuse(quoted(text) + " is no name of a limit");
  if (name.empty()) refuse("a limit that is left out has no name");
  return text;
}

}  // namespace

bool RatioLimits::take(const Bound& limit) {
  if (limit.name == "zs_fraction") fraction = meet(fraction, limit.range);
  else if (limit.name == "radius_ratio") radius_ratio = meet(radius_ratio, limit.range);
  else if (limit.name == "leg_ratio") leg_ratio = std::min(leg_ratio, limit.range.b);
  else return false;
  return true;
}

Certificate read(Stream& file) {
  Certificate out;
  std::string lines, text, key;
  while (key != "tree") {
    if (!file.line(text)) refuse("the file ends before its tree");
    lines += text + "\n";
    const std::size_t space = text.find(' ');
    if (space == std::string::npos) refuse(quoted(text) + " means nothing");
    key = text.substr(0, space);
    const std::string value = text.substr(space + 1);
    if (key == "family") out.family = value;
    else if (key == "target") out.target = number(value);
    else if (key == "characteristic_length") read_length(value, out);
    else if (key == "variable") out.variables.push_back(bound(value));
    else if (key == "limit") out.limits.push_back(bound(value));
    else if (key == "left_out") out.left_out.push_back(limit(value));
    else if (key == "tree") std::from_chars(value.data(), value.data() + value.size(), out.tree);
    else refuse(quoted(key) + " means nothing");
  }
  if (lines != written(out))
    refuse("its lines are not written as the search writes them: in order, numbers in one spelling");
  return out;
}

std::vector<std::string> study_of(const Certificate& c) {
  const std::string length = c.length_kind.empty() ? said("characteristic length", c.length)
                                                   : "characteristic length \"" + c.length_kind + "\"";
  std::vector<std::string> out{c.family + " designs with 0 < zs < zp", length};
  for (const std::vector<Bound>& bounds : {c.variables, c.limits})
    for (const auto& [name, range, of] : bounds) out.push_back(said(name, range) + (of.empty() ? "" : " of " + of));
  for (const std::string& limit : c.left_out) out.push_back("without the limit " + limit);
  return out;
}

}  // namespace ninedof::checker
