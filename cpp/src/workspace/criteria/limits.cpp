#include "workspace/criteria/limits.hpp"

#include <algorithm>

#include "math/numbers.hpp"

namespace ninedof {
namespace {

bool is_condition_number(const LimitRow& row) {
  return row.pose == nullptr && row.info.kind == LimitKind::ratio;
}

/// Each leg has a name for its low and for its high limit.
int names_of(const LimitRow& row) {
  return row.pose != nullptr ? row.pose->items : is_condition_number(row) ? 1 : 18;
}

/// "l1 low", "leg_clearance l1 q2"; a determinant has a name of its own.
std::string item_name(const LimitRow& row, int item) {
  if (is_condition_number(row)) return row.info.name;
  if (row.pose == nullptr) return std::string(leg_name(item % 9)) + (item < limit::leg_high ? " low" : " high");
  std::string part = row.pose->part(item);
  if (row.info.kind == LimitKind::sign) return part;
  std::ranges::replace(part, '-', ' ');
  return std::string(row.info.name) + " " + part;
}

std::vector<std::string> all_names() {
  std::vector<std::string> out;
  for (const LimitRow& row : limit_rows())
    for (int item = 0; row.is_criterion() && item < names_of(row); ++item) out.push_back(item_name(row, item));
  for (const char* name : {"region", "box", "internal_point"}) out.emplace_back(name);
  return out;
}

/// A determinant has to be positive where no other limit is given.
double low_of(const Limit& limit, LimitKind kind) {
  if (kind == LimitKind::sign) return std::max(limit.low, 0.0);
  return limit.low > 0.0 ? limit.low : -infinity;
}

}  // namespace

const std::vector<std::string>& limit_names() {
  static const std::vector<std::string> names = all_names();
  return names;
}

std::vector<PoseCriterion> criteria_besides_legs(const WorkspaceCriteria& criteria) {
  std::vector<PoseCriterion> out;
  int name = 0;
  for (const LimitRow& row : limit_rows()) {
    if (!row.is_criterion()) continue;
    for (const Limit& limit : criteria.limits)
      if (limit.name == row.info.name)
        out.push_back({&row, low_of(limit, row.info.kind), limit.high, limit.options(), name});
    if (is_condition_number(row) && criteria.condition_number)
      out.push_back({&row, -infinity, *criteria.condition_number, {}, name});
    name += names_of(row);
  }
  return out;
}

bool asks_for_connection(const WorkspaceCriteria& criteria) {
  return std::ranges::any_of(criteria.limits, [](const Limit& limit) { return limit_row(limit.name).on_the_way(); });
}

}  // namespace ninedof
