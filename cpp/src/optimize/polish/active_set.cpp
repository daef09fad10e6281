#include "optimize/polish/active_set.hpp"

#include <algorithm>

namespace ninedof {
namespace {

constexpr double close = 1e-6, wide = 1e-5;  // of objective rows that count as equal, of a margin that counts as zero
constexpr double near_bound = 1e-7;  // of a coordinate that may be on its way to its bound
constexpr double order_contact = 1e-9;  // of the logarithm of zp / zs; large robots come close to 0

void add_once(std::vector<std::string>& list, const std::string& name) {
  if (std::find(list.begin(), list.end(), name) == list.end()) list.push_back(name);
}

}  // namespace

ActiveSet active_set(const PreparedProblem& p, const DesignEvaluation& design, const Eigen::VectorXd& y,
                     Contact contact) {
  const double tie = contact == Contact::wide ? wide : close;
  const double bound_contact = contact == Contact::exact ? 1e-12 : near_bound;
  const Coordinates& c = p.coordinates;
  ActiveSet a;
  for (std::size_t k = 0; k < p.row_levels.size(); ++k)
    if (design.levels[p.row_levels[k].level] - design.objective_rows[p.row_levels[k].row] <= tie)
      a.row_levels.push_back(static_cast<int>(k));
  for (Eigen::Index k = 0; k < design.margins.size(); ++k)
    if (design.margins[k] <= tie) a.margins.push_back(static_cast<int>(k));
  for (int k = 0; k < c.size(); ++k) {
    if (y[k] - c.low()[k] <= bound_contact) a.at_low.push_back(k);
    if (c.high()[k] - y[k] <= bound_contact) a.at_high.push_back(k);
  }
  a.order = c.order_margin(y) <= order_contact;
  return a;
}

ActiveSet evaluate_active(const PreparedProblem& p, const Eigen::VectorXd& y, Contact contact,
                          DesignEvaluation& design) {
  const RowSelection none = selection_of(p);
  evaluate_design(p, y, design, &none);
  ActiveSet out = active_set(p, design, y, contact);
  differentiate_rows(p, design, selection_of(p, out.row_levels, out.margins));
  return out;
}

std::vector<std::string> names(const PreparedProblem& p, const ActiveSet& a) {
  std::vector<std::string> out;
  // Internal bounds are not reported, except for that of the offset of O.
  const auto report = [&](int k, bool internal) {
    if (!internal || p.coordinates.info(k).kind == VariableKind::fraction) add_once(out, p.coordinates.info(k).name);
  };
  for (const int k : a.at_low) report(k, p.coordinates.internal_low(k));
  for (const int k : a.at_high) report(k, p.coordinates.internal_high(k));
  for (const int k : a.margins)
    if (!p.margin_name(k).empty()) add_once(out, p.margin_name(k));
  if (a.order) add_once(out, "zp > zs");
  return out;
}

}  // namespace ninedof
