#include "limits/margins.hpp"

#include <algorithm>
#include <cmath>

#include "math/numbers.hpp"

namespace ninedof {
namespace {

double room(Side side, double limit, double value) {
  return side == Side::high ? limit - value : value - limit;
}
double sign_of(Side side) {
  return side == Side::high ? 1.0 : -1.0;
}

}  // namespace

double margin(LimitKind kind, Side side, double limit, double value) {
  if (kind == LimitKind::sign) return room(side, limit, value);
  return limit <= 0.0 || limit == infinity ? infinity : room(side, limit, value) / limit;
}

double cell_margin(LimitKind kind, Side side, double limit, double value) {
  using enum LimitKind;
  if (kind == length || kind == angle || kind == sign) return room(side, limit, value);
  return sign_of(side) * (limit / value - 1.0);
}

double solver_margin(SolverMargin form, Side side, double limit, double value) {
  switch (form) {
    case SolverMargin::logarithm: return sign_of(side) * std::log(limit / value);
    case SolverMargin::linear: return sign_of(side) * (1.0 - value / limit);
    case SolverMargin::plain: return value - limit;
    case SolverMargin::mixed: return value > limit ? std::log(limit / value) : 1.0 - value / limit;
  }
  return 0.0;
}

double solver_slope(SolverMargin form, Side side, double limit, double value) {
  switch (form) {
    case SolverMargin::logarithm: return value > 0.0 ? -sign_of(side) / value : 0.0;
    case SolverMargin::linear: return -sign_of(side) / limit;
    case SolverMargin::plain: return 1.0;
    case SolverMargin::mixed: return -1.0 / std::max(value, limit);
  }
  return 0.0;
}

double value_at_margin(SolverMargin form, Side side, double limit, double margin) {
  const double away = -sign_of(side) * margin;
  switch (form) {
    case SolverMargin::logarithm: return limit * std::exp(away);
    case SolverMargin::linear: return limit * (1.0 + away);
    case SolverMargin::plain: return limit + margin;
    case SolverMargin::mixed: return limit * (margin < 0.0 ? std::exp(-margin) : 1.0 - margin);
  }
  return 0.0;
}

ShownMargin share_of_limit(SolverMargin form, Side side, double margin) {
  const bool logarithm = form == SolverMargin::logarithm || (form == SolverMargin::mixed && margin < 0.0);
  if (!logarithm) return {margin, 1.0};
  const double sign = -sign_of(side);
  return {sign * std::expm1(sign * margin), std::exp(sign * margin)};
}

}  // namespace ninedof
