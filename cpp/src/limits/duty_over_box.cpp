#include "limits/duty_over_box.hpp"

#include <cmath>

#include "conditioning/forms/gram.hpp"

namespace ninedof {
namespace {

/// The greater of two forms, at every pose: the one that is so in the middle and what the other may be above it.
template <class T>
T greater(const T& x, const T& y) {
  if (y.c > x.c) return greater(y, x);
  const double above = upper(y - x);
  return above > 0.0 ? x + T::of({0.0, above}) : x;
}

/// From 0 on where the vector may vanish.
template <class T>
T norm(const Xyz<T>& v) {
  const T square = dot(v, v);
  if (lower(square) > 0.0) return square * inverse_root(square);
  return T::of({0.0, detail::above(std::sqrt(upper(square)))});
}

}  // namespace

template <class Look>
KnownForms<Look>::KnownForms(const Look& look) : look_(look) {
  for (int k = 0; k < point_count; ++k) at_[at_index(k)] = look.at(k);
  for (int leg = 0; leg < 9; ++leg) {
    const LegEnds ends = leg_ends(leg);
    direction_[at_index(leg)] = forms::direction_of(at(ends.to) - at(ends.from));
  }
}

template <class Look>
auto DutyOverBox<Look>::balance() const -> Balance {
  double length = 0.0;
  for (int k = point_u; k < point_p; ++k) length = std::max(length, centre(look_.at(k) - look_.at(point_p)).norm());
  const double per_length = length > 0.0 ? 1.0 / length : 1.0;
  Nine<Nine<T>> h;
  for (int k = 0; k < 9; ++k) h[at_index(k)] = row_of(unit_force(look_, k), per_length);
  Balance out{BoxSystem(h), {}};
  const Wrench<T> own = weights(look_, centre_of_mass(look_));
  for (const Load& load : duty_.loads) {
    const Wrench<T> given{constant<T>(load.moment), constant<T>(load.force), constant<T>(load.force_at_o)};
    out.wanted.push_back(row_of(-1.0 * (given + own), per_length));
  }
  return out;
}

template <class Look>
auto DutyOverBox<Look>::force(int leg) -> T {
  if (!balance_) balance_ = balance();
  std::optional<T> most;
  for (const Nine<T>& wanted : balance_->wanted) {
    const T f = balance_->system.component(leg, wanted), size = greater(f, -f);
    most = most ? greater(*most, size) : size;
  }
  return *most;
}

template <class Look>
auto DutyOverBox<Look>::rate(int leg) -> T {
  const PlatformMotion& m = duty_.motion;
  const auto [a, b] = m.internal == InternalMotion::least && leg >= 3
                          ? settled(leg)
                          : rate_by_rule(unit_force(look_, leg), m.internal, look_.at(point_s) - look_.at(point_p));
  T out;
  if (m.linear_speed > 0.0) out = out + m.linear_speed * norm(a);
  if (m.angular_speed > 0.0) out = out + m.angular_speed * norm(b);
  return out;
}

/// Rates r of internal legs and sdot: r - K sdot = y, K^T r = 0.
template <class Look>
auto DutyOverBox<Look>::settling() const -> Settling {
  std::array<Wrench<T>, 6> unit;
  Nine<Nine<T>> h;
  for (std::size_t k = 0; k < 6; ++k) {
    unit[k] = unit_force(look_, static_cast<int>(k) + 3);
    const Xyz<T>& row = unit[k].at_o;
    const std::array<const T*, 3> of_row{&row.x, &row.y, &row.z};
    h[k][k] = 1.0;
    for (std::size_t j = 0; j < 3; ++j) {
      h[k][j + 6] = *of_row[j];
      h[j + 6][k] = -*of_row[j];
    }
  }
  return {BoxSystem(h), unit};
}

template <class Look>
auto DutyOverBox<Look>::settled(int leg) -> RateOf<T> {
  if (!settling_) settling_ = settling();
  const auto rates = [&](const Xyz<T> Wrench<T>::* part) {
    const auto along_one = [&](T Xyz<T>::* coordinate) {
      Nine<T> y;
      for (std::size_t k = 0; k < 6; ++k) y[k] = settling_->unit[k].*part.*coordinate;
      return settling_->system.component(leg - 3, y);
    };
    return Xyz<T>{along_one(&Xyz<T>::x), along_one(&Xyz<T>::y), along_one(&Xyz<T>::z)};
  };
  return {rates(&Wrench<T>::force), rates(&Wrench<T>::moment)};
}

template class KnownForms<FormLook>;
template class DutyOverBox<FormLook>;
template class DutyOverBox<DesignLook>;

}  // namespace ninedof
