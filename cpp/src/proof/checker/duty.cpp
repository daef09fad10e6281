/// Forces and rates of the legs of a machine at rest over a box. Declared in proof/checker/wants.hpp.

#include <cmath>

#include "proof/checker/wants.hpp"

namespace ninedof::checker::sets {
namespace {

double most_of(const Linear& x) {
  return std::max(upper_end(x), -lower_end(x));
}

/// N linear equations A x = b. With any C, any y and E = 1 - C A
///     x = y + C (b - A y) + E (x - y).
/// C and C b are those of the middle; where |E| < 1 there is one x, and the last term is of second order.
template <std::size_t N>
class Equations {
 public:
  using Column = std::array<Linear, N>;
  explicit Equations(const std::array<Column, N>& a) : a_(a) {
    invert_middle();
    for (std::size_t i = 0; i < N; ++i) {
      for (std::size_t j = 0; j < N; ++j) {
        Linear e = i == j ? 1.0 : 0.0;
        for (std::size_t k = 0; k < N; ++k) e = e - c_[i][k] * a_[k][j];
        e_[i] += most_of(e) * grain::up;
      }
      regular_ = regular_ && e_[i] < 1.0;
      shrinks_ = std::max(shrinks_, e_[i]);
    }
  }

  Column solve(const Column& b) const {
    Column left = b, out;
    if (!regular_) {
      out.fill(unknown_number());
      return out;
    }
    std::array<double, N> y{};
    double most = 0.0;
    for (std::size_t i = 0; i < N; ++i)
      for (std::size_t k = 0; k < N; ++k) y[i] += c_[i][k] * b[k].c;
    for (std::size_t i = 0; i < N; ++i)
      for (std::size_t k = 0; k < N; ++k) left[i] = left[i] - y[k] * a_[i][k];
    for (std::size_t i = 0; i < N; ++i) {
      for (std::size_t k = 0; k < N; ++k) out[i] = out[i] + c_[i][k] * left[k];
      const double size = most_of(out[i]);
      if (!(size < inf)) {  // of numbers that overflow nothing is known, of the others neither
        out.fill(unknown_number());
        return out;
      }
      most = std::max(most, size);
    }
    most /= 1.0 - shrinks_;
    for (std::size_t i = 0; i < N; ++i) out[i] = y[i] + out[i] + Linear(0.0, e_[i] * most * grain::up);
    return out;
  }

 private:
  /// By elimination: nothing of it is believed.
  void invert_middle() {
    std::array<std::array<double, N>, N> m;
    for (std::size_t i = 0; i < N; ++i)
      for (std::size_t j = 0; j < N; ++j) {
        m[i][j] = a_[i][j].c;
        c_[i][j] = i == j ? 1.0 : 0.0;
      }
    for (std::size_t k = 0; k < N; ++k) {
      std::size_t best = k;
      for (std::size_t i = k; i < N; ++i)
        if (std::abs(m[i][k]) > std::abs(m[best][k])) best = i;
      std::swap(m[k], m[best]);
      std::swap(c_[k], c_[best]);
      const double pivot = m[k][k];
      for (std::size_t j = 0; j < N; ++j) m[k][j] /= pivot, c_[k][j] /= pivot;
      for (std::size_t i = 0; i < N; ++i) {
        const double by = i == k ? 0.0 : m[i][k];
        for (std::size_t j = 0; j < N; ++j) m[i][j] -= by * m[k][j], c_[i][j] -= by * c_[k][j];
      }
    }
  }

  std::array<Column, N> a_;
  std::array<std::array<double, N>, N> c_;
  std::array<double, N> e_{};  ///< the sum of each row of |E| is at most this
  bool regular_ = true;
  double shrinks_ = 0.0;
};

Arrow steady(const Triple& v) {
  return {v[0], v[1], v[2]};
}

/// What acts on the platform, about p, and on O. Of a unit force of a leg it is also what moves the leg: its rate is
/// moment.omega + force.pdot + at_o.sdot.
struct Acting {
  Arrow moment, force, at_o;
  std::array<Linear, 9> column() const {
    return {moment.x, moment.y, moment.z, force.x, force.y, force.z, at_o.x, at_o.y, at_o.z};
  }
};

/// The legs l stand on the base and carry the platform, q stand on it and r on the base, and both carry O.
void push(const Stand& at, int leg, const LegLine& line, bool at_end, const Arrow& f, Acting& out) {
  if (leg > 2 && at_end) out.at_o = out.at_o + f;
  if (leg > 5 || at_end != (leg < 3)) return;
  out.force = out.force + f;
  out.moment = out.moment + cross((at_end ? line.to : line.from) - at.p, f);
}

class Machine {
 public:
  Machine(const DutyLines& duty, const Mount& m, const Stand& at) : duty_(duty), at_(at) {
    for (int leg = 0; leg < 9; ++leg) {
      const LegLine& line = line_[static_cast<std::size_t>(leg)] = leg_line(m, at, leg);
      const Arrow e = unit(line.along());
      push(at, leg, line, true, e, of_unit_[static_cast<std::size_t>(leg)]);
      push(at, leg, line, false, Linear(-1.0) * e, of_unit_[static_cast<std::size_t>(leg)]);
    }
  }

  /// Of all legs for each load: what they and the load do adds up to nothing.
  std::vector<std::array<Linear, 9>> forces() const {
    std::array<std::array<Linear, 9>, 9> a;
    for (std::size_t k = 0; k < 9; ++k) {
      const std::array<Linear, 9> column = of_unit_[k].column();
      for (std::size_t i = 0; i < 9; ++i) a[i][k] = column[i];
    }
    const Equations<9> balance(a);
    const Acting own = weight();
    std::vector<std::array<Linear, 9>> out;
    for (const auto& [moment, force, at_o] : duty_.loads) {
      const Arrow none;
      const Acting all{none - own.moment - steady(moment), none - own.force - steady(force),
                       none - own.at_o - steady(at_o)};
      out.push_back(balance.solve(all.column()));
    }
    return out;
  }

  /// The greatest for both speeds in any direction.
  Linear rate(std::size_t leg) const {
    const Acting& own = of_unit_[leg];
    Arrow a = own.force, b = own.moment;
    if (duty_.internal == "least" && leg > 2) {
      // sum of u (u.sdot + rates with O held) = 0 over the internal legs, whose unit forces at O are u.
      std::array<std::array<Linear, 3>, 3> n;
      for (std::size_t k = 3; k < 9; ++k) {
        const std::array u{of_unit_[k].at_o.x, of_unit_[k].at_o.y, of_unit_[k].at_o.z};
        for (std::size_t i = 0; i < 3; ++i)
          for (std::size_t j = 0; j < 3; ++j) n[i][j] = n[i][j] + u[i] * u[j];
      }
      const auto [x, y, z] = Equations<3>(n).solve({own.at_o.x, own.at_o.y, own.at_o.z});
      for (std::size_t k = 3; k < 6; ++k) {
        const Linear share = dot({x, y, z}, of_unit_[k].at_o);
        a = a - share * of_unit_[k].force;
        b = b - share * of_unit_[k].moment;
      }
    } else if (duty_.internal != "held") {
      a = a + own.at_o;
      if (duty_.internal == "carried") b = b + cross(at_.s - at_.p, own.at_o);
    }
    Linear out;
    if (duty_.linear > 0.0) out = out + duty_.linear * norm_of(a);
    if (duty_.angular > 0.0) out = out + duty_.angular * norm_of(b);
    return out;
  }

 private:
  /// The weight of a cylinder rests on the start of its leg, that of a rod on the end, but for what turns the leg.
  Acting weight() const {
    const Arrow g = steady(duty_.gravity), platform = Linear(duty_.platform) * g;
    Acting out{cross(carried(at_, steady(duty_.centre)), platform), platform, Linear(duty_.internal_point) * g};
    for (int leg = 0; leg < 9; ++leg) {
      const LegLine& line = line_[static_cast<std::size_t>(leg)];
      const auto& [cylinder, cylinder_centre, rod, rod_centre] = duty_.legs[static_cast<std::size_t>(leg)];
      const Arrow v = line.along(), e = unit(v);
      const Linear arm = Linear(cylinder) * cylinder_centre - Linear(rod) * rod_centre;
      const Arrow turning = arm * inverse_root(dot(v, v)) * (g - dot(e, g) * e);
      push(at_, leg, line, false, Linear(cylinder) * g - turning, out);
      push(at_, leg, line, true, Linear(rod) * g + turning, out);
    }
    return out;
  }
  /// From 0 on where the vector may vanish.
  static Linear norm_of(const Arrow& v) {
    const Linear square = dot(v, v);
    if (lower_end(square) > 0.0) return square_root(square);
    const double half = 0.5 * std::sqrt(std::max(upper_end(square), 0.0)) * grain::up;
    return {half, half};
  }

  const DutyLines& duty_;
  const Stand& at_;
  std::array<LegLine, 9> line_;
  std::array<Acting, 9> of_unit_;
};

}  // namespace

std::vector<Linear> leg_duties(const DutyLines& duty, const Mount& m, const Stand& at, const LegDuties& of) {
  const Machine machine(duty, m, at);
  std::vector<std::array<Linear, 9>> forces(1);
  if (of.force) forces = machine.forces();
  std::vector<Linear> out;
  for (auto k = static_cast<std::size_t>(of.first); k < static_cast<std::size_t>(of.first + of.count); ++k) {
    const Linear rate = of.rate ? machine.rate(k) : 1.0;
    for (const std::array<Linear, 9>& one : forces) out.push_back(of.force ? one[k] * rate : rate);
  }
  return out;
}

}  // namespace ninedof::checker::sets
