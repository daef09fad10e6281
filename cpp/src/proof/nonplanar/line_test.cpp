#include "proof/nonplanar/line_test.hpp"

#include "proof/nonplanar/line_reason.hpp"
#include "proof/optimum/mixture_simplex.hpp"

namespace ninedof::proof {
namespace {

constexpr std::size_t vectors = 8, most_columns_of_line = 64;
using LineColumns = std::array<MixtureColumn<line::coordinates>, most_columns_of_line>;

/// v = (a, b + i c) with |v| about 1. Of v* M v, |v|^2 is divided out.
struct LineDirection {
  double a, b, c;
};

double length(double x, double y) {
  return std::sqrt(x * x + y * y);
}

/// The eigenvectors of [[m11, conj(z)], [z, m22]] in doubles, and their sums and differences.
std::array<LineDirection, 4> directions(double m11, double re, double im, double m22) {
  const double modulus = length(re, im), half = 0.5 * (m11 - m22), away = length(half, modulus);
  const double part = away > 0.0 ? half / away : 1.0, root = std::sqrt(0.5);
  const double c = std::sqrt(0.5 * (1.0 + part)), s = std::sqrt(0.5 * (1.0 - part));  // of half the angle
  const double phase_re = modulus > 0.0 ? re / modulus : 1.0, phase_im = modulus > 0.0 ? im / modulus : 0.0;
  std::array<LineDirection, 4> out{};
  const std::array<std::pair<double, double>, 4> parts{
      {{c, s}, {-s, c}, {root * (c - s), root * (s + c)}, {root * (c + s), root * (s - c)}}};
  for (std::size_t i = 0; i < 4; ++i) out[i] = {parts[i].first, parts[i].second * phase_re, parts[i].second * phase_im};
  return out;
}

/// v* M v / |v|^2 of the eight directions. Their coefficients are rounded: the error counts.
std::array<DesignForm, vectors> quotients(const LineBlocks<DesignForm>& m) {
  std::array<DesignForm, vectors> out;
  const auto put = [&](std::size_t at, const std::array<LineDirection, 4>& all, const DesignForm& m11,
                       const DesignForm& re, const DesignForm* im, const DesignForm& m22) {
    for (std::size_t i = 0; i < 4; ++i) {
      const auto& [a, b, c] = all[i];
      const double scale = 1.0 / (a * a + b * b + c * c);
      DesignForm& q = out[at + i];
      q = (scale * a * a) * m11 + (scale * (b * b + c * c)) * m22 + (2.0 * scale * a * b) * re;
      if (im) q = q + (2.0 * scale * a * c) * *im;
      const auto most = [](const DesignForm& x) { return std::abs(x.c) + radius(x); };
      q.r += forms::grain * (most(m11) + most(m22) + 2.0 * most(re) + (im ? 2.0 * most(*im) : 0.0));
    }
  };
  put(0, directions(m.axial_11.c, m.axial_12.c, 0.0, m.axial_22.c), m.axial_11, m.axial_12, nullptr, m.axial_22);
  put(4, directions(m.across_11.c, m.across_re.c, m.across_im.c, m.across_22.c), m.across_11, m.across_re, &m.across_im,
      m.across_22);
  return out;
}

/// Parts of the coordinates' ranges, each from -1 to 1, that are left of a box.
class KeptPart {
 public:
  KeptPart() { left_.fill({-1.0, 1.0}); }
  const Interval& operator[](std::size_t k) const { return left_[k]; }

  /// Keeps where a form may be at most 0. False where it is positive in all of the box.
  bool keep(const DesignForm& x) {
    if (!is_known(x)) return true;
    const double least = lower(x);
    if (least > 0.0) return false;
    for (std::size_t k = 0; k < line::coordinates; ++k) {
      const double slope = std::abs(x.a[k]);
      if (!(slope > 0.0)) continue;
      constexpr double slack = 1e-9;  // of roundings that add to the form by some 1e-13
      const double most = (-least / slope - 1.0) + slack * (1.0 + -least / slope);
      if (!(most < 1.0)) continue;
      if (x.a[k] > 0.0) left_[k].hi = std::min(left_[k].hi, most);
      else left_[k].lo = std::max(left_[k].lo, -most);
      if (left_[k].lo > left_[k].hi) return false;
    }
    return true;
  }

  /// Of the volume of the box.
  double share() const {
    double out = 1.0;
    for (const Interval& x : left_) out *= 0.5 * width(x);
    return out;
  }

  void apply(LineBox& box) const {
    for (std::size_t k = 0; k < line::coordinates; ++k) {
      const double middle = 0.5 * (box[k].lo + box[k].hi), half = 0.5 * (box[k].hi - box[k].lo);
      const double slack = 0x1p-48 * magnitude(box[k]);
      if (left_[k].hi < 1.0) box[k].hi = std::min(box[k].hi, middle + half * left_[k].hi + slack);
      if (left_[k].lo > -1.0) box[k].lo = std::max(box[k].lo, middle + half * left_[k].lo - slack);
    }
  }

 private:
  LinePoint<Interval> left_;
};

MixtureColumn<line::coordinates> column_of(const DesignForm& x, double scale) {
  MixtureColumn<line::coordinates> out{scale * (x.c - x.r)};
  for (std::size_t k = 0; k < line::coordinates; ++k) out.slope[k] = scale * x.a[k];
  return out;
}

/// Of the design in the middle of a box, where it keeps the limits; else infinite.
double condition_number_at_middle(const LineBox& box, const LineLimits& limits, const SidesOfO& sides) {
  LinePoint<double> at;
  for (std::size_t k = 0; k < line::coordinates; ++k) at[k] = middle(box[k]);
  const LineDesign<double> design(at);
  for (const double rule : design.rules(limits, sides))
    if (!(rule <= 0.0)) return infinity;
  const LineBlocks<double> m = design.blocks();
  const auto roots = [](double m11, double off, double m22) {
    const double half = 0.5 * (m11 + m22), away = length(0.5 * (m11 - m22), off);
    return std::pair(half - away, half + away);
  };
  const auto axial = roots(m.axial_11, m.axial_12, m.axial_22);
  const auto across = roots(m.across_11, length(m.across_re, m.across_im), m.across_22);
  return std::sqrt(std::max(axial.second, across.second) / std::min(axial.first, across.first)) * (1.0 + 1e-12);
}

/// Of a form x that is at most 0 in a design that is sought. A scale in which boxes of any size count alike.
double scale_of(const DesignForm& x) {
  return 1.0 / (std::abs(x.c) + radius(x));
}

bool geometric(const LineBox& box, std::size_t k) {
  return box[k].lo > 0.0 && k != line::elevation && k != line::base && k != line::platform && k != line::moment;
}

/// The coordinate along which the entries change most, and the rules that may be broken: these count less. Where it is
/// narrow already beside another, that one: of what a wide box hides slopes tell little.
std::size_t widest_change(const LineBox& box, const LineBlocks<DesignForm>& m, const std::vector<DesignForm>& rules,
                          const KeptPart& part) {
  constexpr double of_rules = 0.03, narrow = 0.1, typical_length = 5.0;
  const auto relative = [&](std::size_t k) {
    return geometric(box, k) ? width(box[k]) / (box[k].lo + box[k].hi) : width(box[k]) / typical_length;
  };
  if (!is_known(m.across_22)) return relative(line::upper) > relative(line::lower) ? line::upper : line::lower;
  std::size_t cut = 0, wide = 0;
  double most = -1.0;
  for (std::size_t k = 0; k < line::coordinates; ++k) {
    double change = 0.0;
    for (const DesignForm* x :
         {&m.axial_11, &m.axial_12, &m.axial_22, &m.across_11, &m.across_re, &m.across_im, &m.across_22})
      change = std::max(change, std::abs(x->a[k]));
    for (const DesignForm& x : rules) change = std::max(change, of_rules * std::abs(x.a[k]));
    change *= width(part[k]);
    if (change > most) most = change, cut = k;
    if (relative(k) > relative(wide)) wide = k;
  }
  return relative(cut) < narrow * relative(wide) ? wide : cut;
}

/// One look at a box: closes it, or makes it smaller.
class LineLook {
 public:
  LineLook(const LineBox& box, const LineLimits& limits, const SidesOfO& sides, double target)
      : blocks_(), square_((square(Interval(target)) * (1.0 + 0x1p-34)).hi) {
    LinePoint<DesignForm> at;
    for (std::size_t k = 0; k < line::coordinates; ++k) at[k] = DesignForm::coordinate(box[k].lo, box[k].hi, k);
    const LineDesign<DesignForm> design(at);
    blocks_ = design.blocks();
    rules_ = design.rules(limits, sides);
  }

  /// `reason`, unless null: gets what closes the box or makes it smaller.
  bool closes(Bytes* reason) {
    std::size_t open = 0;
    for (std::size_t k = 0; k < rules_.size(); ++k) {
      if (!part_.keep(rules_[k])) {
        if (reason) reason->push_back(reasons::by_limits);
        return true;
      }
      if (!is_known(rules_[k]) || !(upper(rules_[k]) > 0.0)) continue;
      rules_[open] = rules_[k];
      number_[open++] = k;
    }
    rules_.resize(open);
    const double by_limits = part_.share();
    const bool closed = by_mixture();
    if (reason && (closed || part_.share() < by_limits)) {
      reason->push_back(closed ? reasons::closed_by_mixture : reasons::cut_by_mixture);
      append_weights(*reason);
    } else if (reason && by_limits < 1.0) {
      reason->push_back(reasons::cut_by_limits);
    }
    return closed;
  }
  const KeptPart& part() const { return part_; }
  std::size_t cut(const LineBox& box) const { return widest_change(box, blocks_, rules_, part_); }

 private:
  /// kappa^2 is at least the quotient of any mixtures of v* M v, and no rule is positive in a design that is sought.
  bool by_mixture() {
    const std::array<DesignForm, vectors> q = quotients(blocks_);
    double greatest = 0.0, least = infinity;
    std::size_t most = 0, fewest = 0;
    bool known = true;
    for (std::size_t i = 0; i < vectors; ++i) {
      known = known && is_known(q[i]);
      if (!is_known(q[i])) continue;
      if (lower(q[i]) > greatest) greatest = lower(q[i]), most = i;
      if (upper(q[i]) < least) least = upper(q[i]), fewest = i;
    }
    if (greatest > (Interval(square_) * least).hi) {
      weights_[most] = weights_[vectors + fewest] = 1.0;
      return true;
    }
    if (!known) return false;

    LineColumns columns;
    std::size_t count = 2 * vectors;
    for (std::size_t i = 0; i < vectors; ++i) {
      columns[i] = column_of(q[i], 1.0);
      columns[vectors + i] = column_of(-square_ * q[i], 1.0);
    }
    rules_.resize(std::min(rules_.size(), columns.size() - count));
    for (const DesignForm& x : rules_) columns[count++] = column_of(x, scale_of(x));
    std::array<double, line::coordinates> whole;
    whole.fill(1.0);
    constexpr double enough = 1e-9;
    weights_ =
        MixtureSimplex<vectors, most_columns_of_line, line::coordinates>(columns, count, whole, line::coordinates)
            .solve(enough);
    const auto& x = weights_;
    // What counts: the mixture with its errors. The weights of both kinds add to 1 but for rounding, for which
    // `square_` has room.
    DesignForm sum;
    Interval above(0.0), below(0.0);
    for (std::size_t i = 0; i < vectors; ++i) {
      if (x[i] > 0.0) sum = sum + x[i] * q[i];
      if (x[vectors + i] > 0.0) sum = sum - (x[vectors + i] * square_) * q[i];
      above += Interval(x[i]);
      below += Interval(x[vectors + i]);
    }
    if (!(above.hi <= (below * (1.0 + 0x1p-35)).lo)) return false;
    for (std::size_t j = 0; j < rules_.size(); ++j)
      if (const double weight = x[2 * vectors + j]; weight > 0.0)
        sum = sum + (weight * scale_of(rules_[j])) * rules_[j];
    return !part_.keep(sum);
  }
  /// The weights of `by_mixture`, of the vectors as sums.
  void append_weights(Bytes& out) const {
    const LineBlocks<DesignForm>& m = blocks_;
    const std::array all{directions(m.axial_11.c, m.axial_12.c, 0.0, m.axial_22.c),
                         directions(m.across_11.c, m.across_re.c, m.across_im.c, m.across_22.c)};
    std::array<HermitianSum, 4> sums;
    for (std::size_t i = 0; i < 2 * vectors; ++i) {
      const auto& [a, b, c] = all[i / 4 % 2][i % 4];
      const double weight = weights_[i] / (a * a + b * b + c * c);
      HermitianSum& sum = sums[i / 4];
      sum.m11 += weight * a * a;
      sum.re += weight * a * b;
      sum.im += weight * a * c;
      sum.m22 += weight * (b * b + c * c);
    }
    std::vector<std::pair<std::size_t, double>> limits;
    for (std::size_t j = 0; j < rules_.size() && 2 * vectors + j < weights_.size(); ++j)
      if (const double weight = weights_[2 * vectors + j]; weight > 0.0)
        limits.emplace_back(number_[j], weight * scale_of(rules_[j]));
    append_mixture(out, sums, limits);
  }

  LineBlocks<DesignForm> blocks_;
  std::vector<DesignForm> rules_;
  std::array<std::size_t, most_columns_of_line> number_{};  ///< of rules that are not known to be kept, among all
  std::array<double, most_columns_of_line> weights_{};
  double square_;  ///< above the square of the target by more than weights are rounded
  KeptPart part_;
};

}  // namespace

double cut_at(const LineBox& box, std::size_t k) {
  return geometric(box, k) ? std::clamp(std::sqrt(box[k].lo * box[k].hi), box[k].lo, box[k].hi) : middle(box[k]);
}

LineVerdict test_box(LineBox& box, const LineLimits& limits, const SidesOfO& sides, double target, bool keep) {
  LineVerdict out;
  constexpr int most_looks = 4;
  constexpr double much = 0.5, smallest = 1e-11;
  for (int i = 1;; ++i) {
    LineLook look(box, limits, sides, target);
    if (look.closes(keep ? &out.reasons : nullptr)) {
      out.empty = true;
      return out;
    }
    look.part().apply(box);
    if (look.part().share() < much && i < most_looks) continue;
    out.cut = look.cut(box);
    break;
  }
  out.at_middle = condition_number_at_middle(box, limits, sides);
  out.divisible = width(box[out.cut]) > smallest * (1.0 + magnitude(box[out.cut]));
  return out;
}

}  // namespace ninedof::proof
