#include "ninedof/constraints.hpp"

#include <cmath>
#include <functional>
#include <limits>
#include <utility>

#include "ninedof/error.hpp"

namespace ninedof {
namespace {

using Form = Margin::Form;

/// constant + sign * (log of quantity `over` - log of quantity `under`)
Form ratio_form(int over, int under, double sign, double constant) {
  Form f;
  f.constant = constant;
  f.coefficients[over] += sign;
  f.coefficients[under] -= sign;
  return f;
}

bool has_low(const Limit& limit) {
  return limit.low > 0.0;
}
bool has_high(const Limit& limit) {
  return std::isfinite(limit.high);
}

/// One ratio of two quantities between its limits.
std::vector<Margin> plain_ratio(const Limit& limit, int over, int under) {
  std::vector<Margin> out;
  if (has_high(limit)) out.push_back({limit.name, {ratio_form(over, under, -1.0, std::log(limit.high))}});
  if (has_low(limit)) out.push_back({limit.name, {ratio_form(over, under, 1.0, -std::log(limit.low))}});
  return out;
}

/// longest / shortest leg: at most `high` for every pair, at least `low` for some pair.
std::vector<Margin> leg_ratio(const Limit& limit) {
  std::vector<Margin> out;
  Margin some{limit.name, {}};
  for (const int a : {log_l, log_q, log_r})
    for (const int b : {log_l, log_q, log_r}) {
      if (a == b) continue;
      if (has_high(limit)) out.push_back({limit.name, {ratio_form(a, b, -1.0, std::log(limit.high))}});
      if (has_low(limit)) some.forms.push_back(ratio_form(a, b, 1.0, -std::log(limit.low)));
    }
  if (!some.forms.empty()) out.push_back(std::move(some));
  return out;
}

struct Known {
  std::string name;
  std::function<std::vector<Margin>(const Limit&)> make;
};

const std::vector<Known>& known() {
  static const std::vector<Known> all{
      {"radius_ratio", [](const Limit& l) { return plain_ratio(l, log_base_radius, log_platform_radius); }},
      {"leg_ratio", leg_ratio},
      {"zs_fraction", [](const Limit& l) { return plain_ratio(l, log_zs, log_zp); }},
  };
  return all;
}

std::vector<Margin> margins_of(const Limit& limit) {
  if (std::isnan(limit.low) || std::isnan(limit.high) || limit.low > limit.high || limit.high <= 0.0 ||
      limit.low == std::numeric_limits<double>::infinity())
    throw InvalidArgument(limit.name, format_interval(limit.low, limit.high), "low <= high, low finite and high > 0");
  std::string names;
  for (const Known& k : known()) {
    if (k.name == limit.name) return k.make(limit);
    names += (names.empty() ? "\"" : ", \"") + k.name + "\"";
  }
  throw InvalidArgument("constraints", "\"" + limit.name + "\"", "one of " + names);
}

}  // namespace

const Margin::Form& Margin::governing(const DesignPoint& p) const {
  const Form* best = &forms.front();
  double best_value = best->constant + best->coefficients.dot(p.value);
  for (const Form& f : forms) {
    const double value = f.constant + f.coefficients.dot(p.value);
    if (value > best_value) {
      best = &f;
      best_value = value;
    }
  }
  return *best;
}

double Margin::value(const DesignPoint& p) const {
  const Form& f = governing(p);
  return f.constant + f.coefficients.dot(p.value);
}

Eigen::VectorXd Margin::gradient(const DesignPoint& p) const {
  return p.gradient.transpose() * governing(p).coefficients;
}

std::vector<Margin> margins(const std::vector<Limit>& limits) {
  std::vector<Margin> out;
  for (const Limit& limit : limits)
    for (Margin& m : margins_of(limit)) out.push_back(std::move(m));
  return out;
}

std::vector<std::string> constraint_names() {
  std::vector<std::string> names;
  for (const Known& k : known()) names.push_back(k.name);
  return names;
}

}  // namespace ninedof
