#include "proof/region/rule.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

#include "ninedof/math/error.hpp"

namespace ninedof {
namespace {

constexpr int highest_degree = 6;
constexpr std::size_t most_terms = 1000;  // there are 924 up to that degree

}  // namespace

void PointRule::validate() const {
  for (const double x : scale)
    if (!(x >= 1e-100 && x <= 1e100)) throw InvalidArgument("rule.scale", format_number(x), "positive numbers");
  if (powers.empty() || powers.size() > most_terms || powers.size() != coefficients.size())
    throw InvalidArgument("rule.coefficients", std::to_string(coefficients.size()) + " rows",
                          "one for each of the " + std::to_string(powers.size()) + " terms, at most 1000");
  for (const auto& term : powers)
    if (std::ranges::min(term) < 0 || std::ranges::max(term) > highest_degree ||
        std::accumulate(term.begin(), term.end(), 0) > highest_degree)
      throw InvalidArgument("rule.powers", "a term of degree " + std::to_string(std::ranges::max(term)) + " or more",
                            "whole numbers of a sum from 0 to 6");
  std::vector<std::array<int, 6>> sorted = powers;
  std::ranges::sort(sorted);
  if (std::ranges::adjacent_find(sorted) != sorted.end())
    throw InvalidArgument("rule.powers", "a term twice", "each term once");
  for (const Vec3& c : coefficients)
    if (!c.allFinite() || c.cwiseAbs().maxCoeff() > 1e100)
      throw InvalidArgument("rule.coefficients", "a number that is not finite", "lengths");
}

namespace over_region {
namespace {

constexpr double unit_rounding = 0x1p-53;

/// A sum of multiples of forms: its rounding is added at the end, at once.
template <class T>
class FormSum {
 public:
  void add(double k, const T& x) {
    sum_.c += k * x.c;
    for (std::size_t i = 0; i < T::size; ++i) sum_.a[i] += k * x.a[i];
    for (std::size_t i = 0; i < x.q.size(); ++i) sum_.q[i] += k * x.q[i];
    sum_.r += std::abs(k) * x.r;
    size_ += std::abs(k) * (std::abs(x.c) + spread(x));
    ++terms_;
  }
  /// A sum of n products errs by at most n + 1 units of the sum of their moduli, which itself was rounded as often.
  /// `more`: what the terms left out are at most.
  T total(double more) const {
    T out = sum_;
    const double part = forms::grain + 4.0 * terms_ * unit_rounding;
    out.r = (out.r + more) * (1.0 + part) + part * size_ + terms_ * forms::tiny;
    return out;
  }

 private:
  T sum_;
  double size_ = 0.0, terms_ = 0.0;
};

int degree(const std::array<int, PoseForm::size>& term) {
  return std::accumulate(term.begin(), term.end(), 0);
}

}  // namespace

RuleForms::RuleForms(const PointRule& rule) {
  std::copy(rule.scale.begin(), rule.scale.end(), scale_.begin());
  for (std::size_t n = 0; n < rule.powers.size(); ++n) {
    auto& into = coefficients_[index_of(rule.powers[n])];
    for (std::size_t i = 0; i < 3; ++i) into[i] = rule.coefficients[n][static_cast<Eigen::Index>(i)];
  }
  for (std::size_t n = 0; n < terms_.size(); ++n)  // grows
    for (std::size_t k = 0; k < PoseForm::size; ++k)
      if (Powers lower = terms_[n]; lower[k]-- > 0) index_of(lower);
  for (std::size_t k = 0; k < PoseForm::size; ++k)
    for (std::size_t n = 0, count = terms_.size(); n < count; ++n) {
      if (terms_[n][k] != 0) continue;
      std::vector<std::size_t> line{n};  // of rising powers of coordinate k
      for (Powers next = terms_[n];; line.push_back(index_of(next))) {
        ++next[k];
        if (std::ranges::find(terms_, next) == terms_.end()) break;
      }
      for (std::size_t first = 0; first + 1 < line.size(); ++first)
        for (std::size_t j = line.size() - 1; j-- > first;) steps_.push_back({line[j], line[j + 1], k});
    }
}

std::size_t RuleForms::index_of(const Powers& term) {
  const auto found = std::ranges::find(terms_, term);
  const auto out = static_cast<std::size_t>(found - terms_.begin());
  if (found == terms_.end()) {
    terms_.push_back(term);
    coefficients_.push_back({});
  }
  return out;
}

template <class T>
Xyz<T> RuleForms::shift(const std::array<T, T::size>& at) const {
  std::array<T, T::size> away;  // of the coordinates from the middle
  std::array<double, PoseForm::size> middle{};
  std::array<std::array<double, highest_degree + 1>, PoseForm::size> reach{},
      most{};  // powers of |away|, of |coordinate|
  for (std::size_t k = 0; k < PoseForm::size; ++k) {
    away[k] = (1.0 / scale_[k]) * at[k];
    middle[k] = away[k].c;
    away[k].c = 0.0;
    reach[k][0] = most[k][0] = 1.0;
    const double r = radius(away[k]), m = std::abs(middle[k]) + r;
    for (std::size_t n = 1; n <= highest_degree; ++n) {
      reach[k][n] = reach[k][n - 1] * r;
      most[k][n] = most[k][n - 1] * m;
    }
  }
  const auto product = [](const auto& powers, const Powers& term) {
    double out = 1.0;
    for (std::size_t k = 0; k < PoseForm::size; ++k) out *= powers[k][static_cast<std::size_t>(term[k])];
    return out;
  };
  // A coefficient is the end of at most 6 * 21 additions of products, so that it errs by less than 512 units of the sum
  // of the moduli; all coefficients times the powers of `reach` together by as much of the same sum times `most`.
  std::array<double, 3> size{}, rest{};
  for (std::size_t n = 0; n < terms_.size(); ++n) {
    const double factor = product(most, terms_[n]);
    for (std::size_t i = 0; i < 3; ++i) size[i] += std::abs(coefficients_[n][i]) * factor;
  }
  auto c = coefficients_;
  for (const Step& step : steps_)
    if (middle[step.k] != 0.0)
      for (std::size_t i = 0; i < 3; ++i) c[step.to][i] += middle[step.k] * c[step.from][i];
  std::array<FormSum<T>, 3> sum;
  for (std::size_t n = 0; n < terms_.size(); ++n) {
    const Powers& term = terms_[n];
    const int total = degree(term);
    if (total > 2) {
      const double factor = product(reach, term);
      for (std::size_t i = 0; i < 3; ++i) rest[i] += std::abs(c[n][i]) * factor;
      continue;
    }
    T x = 1.0;
    if (total > 0) {
      const auto first =
          static_cast<std::size_t>(std::ranges::find_if(term, [](int p) { return p > 0; }) - term.begin());
      const auto last = PoseForm::size - 1 -
                        static_cast<std::size_t>(std::find_if(term.rbegin(), term.rend(), [](int p) { return p > 0; }) -
                                                 term.rbegin());
      x = total == 1 ? away[first] : away[first] * away[last];
    }
    for (std::size_t i = 0; i < 3; ++i) sum[i].add(c[n][i], x);
  }
  const auto n = static_cast<double>(terms_.size());
  double far = 1.0;  // what underflow may be multiplied by
  for (const auto& powers : most) far *= std::max(1.0, powers.back());
  for (std::size_t i = 0; i < 3; ++i) {
    rest[i] = rest[i] * (1.0 + 8.0 * n * unit_rounding + forms::grain) + n * forms::tiny;
    rest[i] += (1024.0 + 16.0 * n) * unit_rounding * size[i] + forms::tiny * far;
  }
  return {sum[0].total(rest[0]), sum[1].total(rest[1]), sum[2].total(rest[2])};
}

template Xyz<PoseForm> RuleForms::shift(const std::array<PoseForm, PoseForm::size>&) const;
template Xyz<CurvedForm> RuleForms::shift(const std::array<CurvedForm, CurvedForm::size>&) const;

}  // namespace over_region
}  // namespace ninedof
