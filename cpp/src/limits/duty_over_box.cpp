#include "limits/duty_over_box.hpp"

#include <cmath>
#include <optional>

#include "limits/box_system.hpp"

namespace ninedof {
namespace {

/// The greater of two forms, at every pose: the one that is so in the middle and what the other may be above it.
PoseForm greater(const PoseForm& x, const PoseForm& y) {
  if (y.c > x.c) return greater(y, x);
  const double above = upper(y - x);
  return above > 0.0 ? x + PoseForm::of({0.0, above}) : x;
}

/// From 0 on where the vector may vanish.
PoseForm norm(const FormVector& v) {
  const PoseForm square = dot(v, v);
  if (lower(square) > 0.0) return square * inverse_root(square);
  return PoseForm::of({0.0, detail::above(std::sqrt(upper(square)))});
}

}  // namespace

KnownForms::KnownForms(const FormLook& look) : look_(look) {
  for (int k = 0; k < point_count; ++k) at_[at_index(k)] = look.at(k);
  for (int leg = 0; leg < 9; ++leg) {
    const LegEnds ends = leg_ends(leg);
    direction_[at_index(leg)] = unit(at(ends.to) - at(ends.from));
  }
}

PoseForm DutyOverBox::force(int leg) const {
  double length = 0.0;
  for (int k = point_u; k < point_p; ++k) length = std::max(length, centre(look_.at(k) - look_.at(point_p)).norm());
  const double per_length = length > 0.0 ? 1.0 / length : 1.0;
  const auto row = [per_length](const Wrench<PoseForm>& w) {
    const FormVector m = per_length * w.moment;
    return NineForms{m.x, m.y, m.z, w.force.x, w.force.y, w.force.z, w.at_o.x, w.at_o.y, w.at_o.z};
  };
  std::array<NineForms, 9> h;
  for (int k = 0; k < 9; ++k) h[at_index(k)] = row(unit_force(look_, k));
  const BoxSystem system(h);
  const Wrench<PoseForm> own = weights(look_, centre_of_mass(look_));
  std::optional<PoseForm> most;
  for (const Load& load : duty_.loads) {
    const Wrench<PoseForm> given{constant<PoseForm>(load.moment), constant<PoseForm>(load.force),
                                 constant<PoseForm>(load.force_at_o)};
    const PoseForm f = system.component(leg, row(-1.0 * (given + own))), size = greater(f, -f);
    most = most ? greater(*most, size) : size;
  }
  return *most;
}

PoseForm DutyOverBox::rate(int leg) const {
  const PlatformMotion& m = duty_.motion;
  const auto [a, b] = m.internal == InternalMotion::least && leg >= 3
                          ? settled(leg)
                          : rate_by_rule(unit_force(look_, leg), m.internal, look_.at(point_s) - look_.at(point_p));
  PoseForm out;
  if (m.linear_speed > 0.0) out = out + m.linear_speed * norm(a);
  if (m.angular_speed > 0.0) out = out + m.angular_speed * norm(b);
  return out;
}

/// Rates r of internal legs and sdot that makes their squares least, for each unit twist: r - K sdot = y, K^T r = 0.
RateOf<PoseForm> DutyOverBox::settled(int leg) const {
  std::array<Wrench<PoseForm>, 6> unit;
  std::array<NineForms, 9> h;
  for (std::size_t k = 0; k < 6; ++k) {
    unit[k] = unit_force(look_, static_cast<int>(k) + 3);
    const FormVector& row = unit[k].at_o;
    const std::array<const PoseForm*, 3> of_row{&row.x, &row.y, &row.z};
    h[k][k] = 1.0;
    for (std::size_t j = 0; j < 3; ++j) {
      h[k][j + 6] = *of_row[j];
      h[j + 6][k] = -*of_row[j];
    }
  }
  const BoxSystem system(h);
  const auto rates = [&](const FormVector Wrench<PoseForm>::* part) {
    const auto along_one = [&](PoseForm FormVector::* coordinate) {
      NineForms y;
      for (std::size_t k = 0; k < 6; ++k) y[k] = unit[k].*part.*coordinate;
      return system.component(leg - 3, y);
    };
    return FormVector{along_one(&FormVector::x), along_one(&FormVector::y), along_one(&FormVector::z)};
  };
  return {rates(&Wrench<PoseForm>::force), rates(&Wrench<PoseForm>::moment)};
}

}  // namespace ninedof
