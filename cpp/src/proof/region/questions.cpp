#include "proof/region/questions.hpp"

#include <algorithm>
#include <cmath>

#include "math/numbers.hpp"

namespace ninedof::over_region {
namespace {

// Widths of enclosures, relative.
constexpr double narrow = 1e-7;    // of lengths that decide on a stroke
constexpr double any_case = 1e-6;  // of a number with two limits

}  // namespace

Questions::Questions(const PosedRobot& machine, const ProofSettings& settings, const Control& control)
    : machine_(machine),
      at_neutral_{machine.geometry,  machine.neutral, machine.characteristic_length, {}, {machine.neutral}, {}, {},
                  machine.tolerances},
      settings_(settings),
      control_(control) {
  if (machine_.region.empty() && machine_.poses.empty()) machine_.poses.push_back(machine_.neutral);
}

std::size_t Questions::ask(const LimitRow& given, int item, const Question& question) {
  const bool of_length = given.pose->first_leg >= 0;
  const LimitRow& row = of_length ? leg_length_limit() : given;
  const auto [greatest, at_neutral, limit, options] = question;
  // Of legs that bear or do little it is enough that they are far from the limit.
  const double scale = *row.info.needs == '\0' ? 0.0 : limit;
  const PoseQuantity quantity{
      row.info.name, of_length ? given.pose->first_leg + item : item, options, greatest, row.pose->width, limit, scale};
  for (std::size_t k = 0; k < asked_.size(); ++k) {
    PoseQuantity& old = asked_[k].quantity;
    if (old.limit_name != quantity.limit_name || old.item != quantity.item || old.greatest != greatest ||
        asked_[k].at_neutral != at_neutral || old.options != options)
      continue;
    if (std::isnan(old.limit)) old.limit = limit;
    else if (!std::isnan(limit)) old.relative = any_case;  // narrow in any case
    return k;
  }
  asked_.push_back({quantity, at_neutral, of_length});
  return asked_.size() - 1;
}

std::pair<std::size_t, std::size_t> Questions::ends_of_leg(int leg, bool at_neutral) {
  const LimitRow& row = leg_length_limit();
  const std::size_t shortest = ask(row, leg, {false, at_neutral, not_a_number});
  return {shortest, ask(row, leg, {true, at_neutral, not_a_number})};
}

template <class Wanted, class Take>
void Questions::search(const Wanted& wanted, const Take& take) {
  for (const bool at_neutral : {false, true}) {
    std::vector<PoseQuantity> quantities;
    std::vector<Asked*> of;
    for (Asked& one : asked_) {
      if (one.at_neutral != at_neutral || !wanted(one)) continue;
      quantities.push_back(one.quantity);
      of.push_back(&one);
    }
    if (of.empty()) continue;
    const std::vector<Extreme> found =
        pose_extremes(at_neutral ? at_neutral_ : machine_, quantities, settings_, control_);
    for (std::size_t k = 0; k < found.size(); ++k) take(*of[k], found[k]);
  }
}

void Questions::search() {
  search([](const Asked&) { return true; }, [](Asked& one, const Extreme& found) { one.found = found; });
}

void Questions::search_lengths_again() {
  for (Asked& one : asked_)
    if (one.of_length) one.quantity.relative = narrow;
  search([](const Asked& one) { return one.of_length; },
         [](Asked& one, const Extreme& now) {
           Extreme& old = one.found;
           if (one.quantity.greatest ? now.low > old.low : now.high < old.high) old.at = now.at;
           old = {std::max(old.low, now.low), std::min(old.high, now.high), old.at, old.boxes + now.boxes};
         });
}

std::vector<MetAt> Questions::met_in_region() const {
  std::vector<MetAt> out;
  for (const Asked& one : asked_)
    if (!one.at_neutral && one.found.at.pose < 0) out.push_back(one.found.at);
  return out;
}

}  // namespace ninedof::over_region
