#include "ninedof/proof/checker.hpp"

#include <array>
#include <bit>
#include <cfenv>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <map>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <vector>

#include "proof/checker/ranges.hpp"

namespace ninedof::checker {
namespace {

[[noreturn]] void refuse(const std::string& why) {
  throw std::runtime_error(why);
}

// --- the file ---------------------------------------------------------------------------------------------------------

struct Certificate {
  std::string family;
  double target = 0.0, length = 0.0;
  std::vector<std::pair<std::string, Range>> variables;
  std::map<std::string, Range> limits;
  std::string tree;
};

double number(const std::string& word) {
  char* end = nullptr;
  const double x = std::strtod(word.c_str(), &end);
  if (word.empty() || end != word.c_str() + word.size() || std::isnan(x)) refuse("\"" + word + "\" is not a number");
  return x;
}

/// CRC-32 of ISO 3309, as zlib has it.
std::uint32_t checksum(const std::string& bytes) {
  std::uint32_t crc = 0xFFFFFFFFU;
  for (const char c : bytes) {
    crc ^= static_cast<unsigned char>(c);
    for (int k = 0; k < 8; ++k) crc = crc >> 1U ^ ((crc & 1U) != 0U ? 0xEDB88320U : 0U);
  }
  return ~crc;
}

Certificate read(const std::string& bytes) {
  const std::string first = "ninedof certificate 1\nchecksum ";
  if (bytes.compare(0, first.size(), first) != 0) refuse("this is not a certificate of version 1");
  const std::size_t line_end = bytes.find('\n', first.size());
  if (line_end == std::string::npos) refuse("the file ends in its second line");
  const std::string body = bytes.substr(line_end + 1);
  if (number("0x" + bytes.substr(first.size(), line_end - first.size())) != static_cast<double>(checksum(body)))
    refuse("the checksum does not agree: the file is damaged or was changed");

  Certificate out;
  std::size_t at = 0;
  while (true) {
    const std::size_t end = body.find('\n', at);
    if (end == std::string::npos) refuse("the file has no tree");
    std::istringstream line(body.substr(at, end - at));
    at = end + 1;
    std::string key, a, b, c, more;
    line >> key;
    const auto words = [&](std::string* x, std::string* y, std::string* z) {
      for (std::string* word : {x, y, z})
        if (word != nullptr && !(line >> *word)) refuse("a value of " + key + " is missing");
      if (line >> more) refuse("too many values of " + key);
    };
    if (key == "family") {
      words(&out.family, nullptr, nullptr);
    } else if (key == "target") {
      words(&a, nullptr, nullptr);
      out.target = number(a);
    } else if (key == "characteristic_length") {
      words(&a, nullptr, nullptr);
      out.length = number(a);
    } else if (key == "variable" || key == "limit") {
      words(&a, &b, &c);
      const Range range{number(b), number(c)};
      if (!range.sound()) refuse("the bounds of " + a + " are inverted");
      if (key == "variable") out.variables.emplace_back(a, range);
      else if (const auto [old, first_one] = out.limits.emplace(a, range); !first_one)
        old->second = meet(old->second, range);
    } else if (key == "left_out") {
      // A limit of the study that the proof does without.
    } else if (key == "tree") {
      words(&a, nullptr, nullptr);
      out.tree = body.substr(at);
      if (number(a) != static_cast<double>(out.tree.size())) refuse("the tree is not as long as the file says");
      return out;
    } else {
      refuse("\"" + key + "\" means nothing");
    }
  }
}

// --- the designs ------------------------------------------------------------------------------------------------------

/// Coordinates: U, x = R/U, eta = zp/U, o = zs/(zp - zs), tan(theta/2), y, z.
using Box = std::array<Range, coordinates>;

struct Domain {
  int dimension = 5;
  Box box;
  Range R, R_internal, U, U_internal, zp, zs, fraction{0.0, 1.0}, radius_ratio{0.0, inf};
  double target = 0.0, leg_ratio = inf;
};

constexpr double pi = 3.14159265358979323846;

/// A little more than rounding can do to an angle of a few radians.
Range blurred(double a, double b) {
  return {a - 1e-14, b + 1e-14};
}

/// Radius of a hexagon with sides s1 and s2, and the angle of its first joint below the x axis.
Range radius(Range s1, Range s2) {
  return root((square(s1) + s1 * s2 + square(s2)) / 3.0);
}
Range below_x(Range s1, Range s2) {
  const auto angle = [](double a, double b) { return std::atan2(std::sqrt(3.0) * (a + 2.0 * b), 3.0 * a); };
  return blurred(s1.b > 0.0 ? angle(s1.b, s2.a) : pi / 2.0, s2.b > 0.0 ? angle(s1.a, s2.b) : pi / 6.0);
}

/// tan(theta/2) of an angle that may be turned back, doubled over and counted from either side.
Range half_tangent(Range theta) {
  if (!(theta.b - theta.a < 2.0 * pi)) return {0.0, inf};
  double low = inf, high = 0.0;
  for (int turn = -40; turn <= 40; ++turn) {
    const double a = theta.a - 2.0 * pi * turn, b = theta.b - 2.0 * pi * turn;
    if (b < -pi - 1e-9 || a > pi + 1e-9) continue;
    const bool through_zero = a <= 0.0 && b >= 0.0, through_pi = b >= pi - 1e-12 || a <= -pi + 1e-12;
    const double near = through_zero ? 0.0 : std::min(std::abs(a), std::abs(b));
    const double far = through_pi ? pi : std::max(std::abs(a), std::abs(b));
    low = std::min(low, std::tan(std::max(near - 1e-13, 0.0) / 2.0));
    high = far > pi - 1e-9 ? inf : std::max(high, std::tan((far + 1e-13) / 2.0));
    if (high == inf) break;
  }
  if (low == inf) return {0.0, inf};  // an angle of more than forty turns
  return {std::max(low * (1.0 - 1e-14), 0.0), high * (1.0 + 1e-14)};
}

Range variable(const Certificate& c, std::size_t k, const char* name) {
  if (k >= c.variables.size() || c.variables[k].first != name) refuse(std::string("variable ") + name + " is missing");
  return c.variables[k].second;
}

Range positive(Range x, const char* name) {
  if (!(x.a > 0.0) || !(x.b < inf)) refuse(std::string("the bounds of ") + name + " are not positive and finite");
  return x;
}

Domain domain_of(const Certificate& c) {
  if (!(c.target > 1.0) || !(c.target < inf)) refuse("the target is not a finite number above 1");
  if (!(c.length > 0.0) || !(c.length < inf)) refuse("the characteristic length is not positive and finite");
  Domain d;
  d.target = c.target;
  Range angle;
  const auto size_of = [&](Range x) { return meet(x / c.length, {0.0, inf}); };
  if (c.family == "hexagonal") {
    const Range a1 = variable(c, 0, "a1"), a2 = variable(c, 1, "a2"), b1 = variable(c, 2, "b1"),
                b2 = variable(c, 3, "b2");
    for (const Range side : {a1, a2, b1, b2})
      if (!(side.a >= 0.0) || !(side.b < inf)) refuse("the bounds of a side are negative or infinite");
    d.R = d.R_internal = size_of(radius(a1, a2));
    d.U = d.U_internal = size_of(radius(b1, b2));
    d.zp = variable(c, 4, "zp");
    d.zs = variable(c, 5, "zs");
    angle = variable(c, 6, "theta_z") + below_x(a1, a2) - below_x(b1, b2);
  } else if (c.family == "symmetric") {
    d.dimension = 7;
    d.R = size_of(positive(variable(c, 0, "base_external_radius"), "base_external_radius"));
    d.R_internal = size_of(positive(variable(c, 1, "base_internal_radius"), "base_internal_radius"));
    d.U = size_of(positive(variable(c, 3, "platform_external_radius"), "platform_external_radius"));
    d.U_internal = size_of(positive(variable(c, 5, "platform_internal_radius"), "platform_internal_radius"));
    angle = variable(c, 4, "platform_external_angle");
    d.zp = variable(c, 7, "zp");
    d.zs = variable(c, 8, "zs");
  } else {
    refuse("the family is neither hexagonal nor symmetric");
  }
  d.zp = size_of(positive(d.zp, "zp"));
  if (!(d.zs.a >= 0.0)) refuse("the bounds of zs are negative");
  d.zs = size_of(d.zs);
  for (const auto& [name, range] : c.limits) {
    if (name == "zs_fraction") d.fraction = meet(d.fraction, range);
    else if (name == "radius_ratio") d.radius_ratio = meet(d.radius_ratio, range);
    else if (name == "leg_ratio") d.leg_ratio = range.b;
    else refuse("the proof knows no limit " + name);
  }

  // Below the target: R U sin(theta) >= zp / target, and 1/q and y/t at most target * sqrt(N).
  const bool hexagonal = d.dimension == 5;
  const Range area = Range(d.zp.a) / d.target;
  Range& U = d.box[0];
  U = meet(d.U, {(area / d.R.b).a, inf});
  const Range R = meet(d.R, {(area / U.b).a, inf});
  d.box[6] = hexagonal ? Range(1.0) : d.U_internal / U;
  d.box[1] = R / U;
  if (d.radius_ratio.b < inf) d.box[1].b = std::min(d.box[1].b, (d.radius_ratio * std::max(1.0, d.box[6].b)).b);
  if (hexagonal) d.box[1].a = std::max(d.box[1].a, d.radius_ratio.a);
  d.box[5] = hexagonal ? d.box[1] : d.R_internal / U;
  d.box[2] = d.zp / U;
  const double sine = (area / (Range(R.b) * U.b)).a;
  d.box[4] = meet(half_tangent(angle), {0.5 * sine, (2.0 / Range(sine)).b});
  const Range room = Range(d.target) * root(square(1.0 + Range(d.box[1].b)) + square(d.box[2].b));
  Range t = meet(d.fraction, d.zs / d.zp);
  t = meet(t, {(d.box[5].a / room).a, (1.0 - d.box[6].a / room).b});
  d.box[3] = {(Range(t.a) / (1.0 - Range(t.a))).a, (Range(t.b) / (1.0 - Range(t.b))).b};
  return d;
}

bool empty(const Box& box) {
  for (const Range& r : box)
    if (r.a > r.b) return true;
  return false;
}

bool disjoint(Range x, Range y) {
  return x.b < y.a || y.b < x.a;
}

bool outside(const Domain& d, const Box& b) {
  const Range height = b[0] * b[2], t = 1.0 / (1.0 + 1.0 / b[3]);
  if (disjoint(b[0] * b[1], d.R) || disjoint(height, d.zp) || disjoint(height * t, d.zs) || disjoint(t, d.fraction))
    return true;
  if (d.dimension == 5) return false;
  if (disjoint(b[0] * b[5], d.R_internal) || disjoint(b[0] * b[6], d.U_internal)) return true;
  const Range base{std::max(b[1].a, b[5].a), std::max(b[1].b, b[5].b)};
  return disjoint(base / Range(std::max(1.0, b[6].a), std::max(1.0, b[6].b)), d.radius_ratio);
}

/// The part of a box outside of which no design keeps the bounds; empty if none does. Boxes that touch the bounds at a
/// corner, up to rounding, shrink to that corner.
Box narrowed(const Domain& d, Box b) {
  const bool seven = d.dimension == 7;
  for (int turn = 0; turn < 2; ++turn) {
    Range& U = b[0];
    const auto product = [&](Range& x, Range bounds) {  // U x is within the bounds
      x = meet(x, bounds / U);
      if (x.sound()) U = meet(U, bounds / x);
      return x.sound() && U.sound();
    };
    if (!product(b[1], d.R) || !product(b[2], d.zp)) return b;
    if (seven && (!product(b[5], d.R_internal) || !product(b[6], d.U_internal))) return b;
    const Range t = meet(meet(1.0 / (1.0 + 1.0 / b[3]), d.fraction), d.zs / (U * b[2]));
    if (!t.sound()) {
      U = {1.0, 0.0};
      return b;
    }
    if (!product(b[2], d.zs / t)) return b;
    const double most = t.b < 1.0 ? (Range(t.b) / (1.0 - Range(t.b))).b : inf;
    b[3] = meet(b[3], {(Range(std::max(t.a, 0.0)) / (1.0 - Range(t.a))).a, most});
    if (!b[3].sound()) return b;
  }
  if (!seven) b[5] = b[1];
  return b;
}

// --- the singular values ----------------------------------------------------------------------------------------------

struct Block {
  Positive g2, f2, w2;
};
struct Pieces {
  Block axial, transverse;
  Positive external2, upper2, lower2;
};

Positive coordinate(const Box& b, std::size_t k) {
  Positive out{b[k], {}};
  out.log_slope[k] = 1.0;
  return out;
}

Pieces pieces(const Box& b, int dimension) {
  const Positive U = coordinate(b, 0), x = coordinate(b, 1), eta = coordinate(b, 2), o = coordinate(b, 3);
  const Positive tau = coordinate(b, 4), y = dimension == 5 ? x : coordinate(b, 5);
  const Positive z2 = dimension == 5 ? Positive{1.0, {}} : squared(coordinate(b, 6));
  const Positive U2 = squared(U), eta2 = squared(eta);
  const Positive versed = 2.0 * inverse(plus(1.0, inverse(squared(tau))));  // 1 - cos theta
  const Signed cosine = plus(1.0, -plain(versed));
  Positive sine2 = 4.0 * squared(inverse(tau + inverse(tau)));  // sin theta = 2 / (tau + 1/tau)
  sine2.log_slope[4] = 2.0 * cosine.value;
  const Positive q = inverse(plus(1.0, o)), t = inverse(plus(1.0, inverse(o)));
  const Signed n = squared(plus(-1.0, plain(x))) + plain(2.0 * (x * versed));
  const Positive N = n + eta2;
  const Positive up2 = squared(q * eta), low2 = squared(t * eta);
  const Positive Z = z2 * inverse(up2), Y = squared(y) * inverse(low2);
  const Positive stretch2 = plus(1.0, up2 * U2);
  const Positive arm2 = squared(plain(t) + cosine * (q * x)) + squared(q * x) * sine2;
  const Positive slant2 = squared(plus(1.0, plain(q * (eta2 * U2)) + -(cosine * x))) + squared(x) * sine2;
  Pieces p;
  p.axial.g2 = 3.0 * (U2 * squared(x) * sine2 * inverse(N));
  p.axial.f2 = 3.0 * (eta2 * inverse(N));
  p.axial.w2 = 3.0 * inverse(plus(2.0, Z + Y));
  p.transverse.g2 = 1.5 * (arm2 * eta2 * U2 * inverse(N) * inverse(stretch2));
  p.transverse.f2 = 1.5 * (slant2 * inverse(N) * inverse(stretch2));
  p.transverse.w2 = 1.5 * (stretch2 * inverse(plus(2.0, inverse(Z) + inverse(Y))));
  p.axial.f2.value = 3.0 / (1.0 + n.value / eta2.value);  // each of eta, U and their like once: a narrower range
  p.axial.g2.value = 3.0 * U2.value * sine2.value /
                     (square(1.0 - cosine.value / x.value) + (sine2.value + eta2.value) / square(x.value));
  p.transverse.g2.value = 1.5 * (arm2.value / ((1.0 + n.value / eta2.value) * (1.0 / U2.value + up2.value)));
  p.external2 = N;
  p.upper2 = z2 + up2;
  p.lower2 = squared(y) + low2;
  return p;
}

/// sigma_max of [[g, f], [0, w]].
Range greatest(double g, double f2, double w) {
  return (root(square(Range(g) + w) + f2) + root(square(Range(g) - w) + f2)) / 2.0;
}

struct Values {
  Range max, min;
};
Values values(const Block& b) {
  const Range g = root(b.g2.value), f2 = meet(b.f2.value, {0.0, inf}), w = root(b.w2.value);
  return {{greatest(g.a, f2.a, w.a).a, greatest(g.b, f2.b, w.b).b},
          {(Range(g.a) * w.a / greatest(g.a, f2.b, w.a)).a, (Range(g.b) * w.b / greatest(g.b, f2.a, w.b)).b}};
}

bool by_ranges(const Pieces& p, const Domain& d) {
  if (d.leg_ratio < inf) {
    const double most = std::max({p.external2.value.a, p.upper2.value.a, p.lower2.value.a});
    const double least = std::min({p.external2.value.b, p.upper2.value.b, p.lower2.value.b});
    if ((Range(most) / least).a > square(Range(d.leg_ratio)).b) return true;
  }
  const Range K = d.target;
  for (const Block* b : {&p.axial, &p.transverse}) {
    // kappa + 1/kappa = g/w + w/g + f^2 / (g w)
    const Range g = root(b->g2.value), w = root(b->w2.value), r = g / w;
    const double nearest = r.a > 1.0 ? r.a : r.b < 1.0 ? r.b : 1.0;
    if (!(nearest > 0.0)) continue;
    const Range sum = Range(nearest) + 1.0 / Range(nearest) + Range(std::max(b->f2.value.a, 0.0)) / (Range(g.b) * w.b);
    if (sum.a >= (K + 1.0 / K).b) return true;
  }
  const Values a = values(p.axial), t = values(p.transverse);
  return (Range(a.max.a) / t.min.b).a >= d.target || (Range(t.max.a) / a.min.b).a >= d.target;
}

/// Slopes of the logarithms of sigma_max and sigma_min, which weigh those of g, f and w.
void slopes(const Block& b, Range max[], Range min[]) {
  const Range g = root(b.g2.value), w = root(b.w2.value), f2 = meet(b.f2.value, {0.0, inf});
  const Range unit{0.0, 1.0};
  // p = f^2 / (A B) and d = (g^2 - w^2) / (A B) at the corners where they are least and greatest.
  const Range sum2 = square(g + w), difference2 = square(g - w);
  const auto share = [](double f, double s, double t) {
    return f > 0.0 ? 1.0 / root((1.0 + Range(s) / f) * (1.0 + Range(t) / f)) : Range(0.0);
  };
  const Range p = meet({share(f2.a, sum2.b, difference2.b).a, share(f2.b, sum2.a, difference2.a).b}, unit);
  const auto balance = [&](double x, double y) {
    const Range s = Range(x) + y, t = Range(x) - y;
    const auto at = [&](double f) { return s * t / (root(square(s) + f) * root(square(t) + f)); };
    return cover(at(f2.a), at(f2.b));
  };
  const Range d = meet({balance(g.a, w.b).a, balance(g.b, w.a).b}, {-1.0, 1.0});
  const Range up_g = meet((1.0 - p + d) / 2.0, unit), up_w = meet((1.0 - p - d) / 2.0, unit);
  const Range low_g = meet((1.0 + p - d) / 2.0, unit), low_w = meet((1.0 + p + d) / 2.0, unit);
  for (int k = 0; k < coordinates; ++k) {
    const Range log_g = b.g2.log_slope[k] / 2.0, log_w = b.w2.log_slope[k] / 2.0, log_f = b.f2.log_slope[k] / 2.0;
    max[k] = up_g * log_g + up_w * log_w + p * log_f;
    min[k] = low_g * log_g + low_w * log_w - p * log_f;
  }
}

struct Weights {
  float max = 0.0F, min = 0.0F, external = 0.0F, upper = 0.0F;
};

bool by_combination(const Pieces& p, const Box& box, const Domain& d, const Weights& by) {
  Box middle = box;
  std::array<double, coordinates> reach{};
  for (std::size_t k = 0; k < static_cast<std::size_t>(d.dimension); ++k) {
    const double m = std::clamp(std::sqrt(box[k].a) * std::sqrt(box[k].b), box[k].a, box[k].b);
    middle[k] = m;
    reach[k] = std::max(logarithm(Range(box[k].b) / m).b, logarithm(m / Range(box[k].a)).b);
  }
  if (d.dimension == 5) middle[5] = middle[1];
  const Range a = double(by.max), b = double(by.min), e = double(by.external), u = double(by.upper), l = -(e + u);
  const Pieces at = pieces(middle, d.dimension);
  const Values axial = values(at.axial), transverse = values(at.transverse);
  Range sum = (1.0 - a) * logarithm(axial.max) + a * logarithm(transverse.max) - (1.0 - b) * logarithm(axial.min) -
              b * logarithm(transverse.min);
  const bool legs = by.external != 0.0F || by.upper != 0.0F;
  if (legs) {
    const auto plus = [](Range x) { return Range(std::max(x.a, 0.0), std::max(x.b, 0.0)); };
    sum = sum +
          (e * logarithm(at.external2.value) + u * logarithm(at.upper2.value) + l * logarithm(at.lower2.value)) / 2.0 -
          (plus(e) + plus(u) + plus(l)) * logarithm(d.leg_ratio);
  }
  Range axial_max[coordinates], axial_min[coordinates], transverse_max[coordinates], transverse_min[coordinates];
  slopes(p.axial, axial_max, axial_min);
  slopes(p.transverse, transverse_max, transverse_min);
  for (int k = 0; k < d.dimension; ++k) {
    Range slope = (1.0 - a) * axial_max[k] + a * transverse_max[k] - (1.0 - b) * axial_min[k] - b * transverse_min[k];
    if (legs)
      slope = slope + (e * p.external2.log_slope[k] + u * p.upper2.log_slope[k] + l * p.lower2.log_slope[k]) / 2.0;
    sum = sum - Range(0.0, (Range(size(slope)) * reach[static_cast<std::size_t>(k)]).b);
  }
  return sum.a >= logarithm(d.target).b;
}

// --- the tree ---------------------------------------------------------------------------------------------------------

std::pair<Box, Box> halves(const Box& box, std::size_t k, int dimension) {
  std::pair out(box, box);
  const double m = std::clamp(std::sqrt(box[k].a) * std::sqrt(box[k].b), box[k].a, box[k].b);
  out.first[k].b = out.second[k].a = m;
  if (dimension == 5) out.first[5] = out.first[1], out.second[5] = out.second[1];
  return out;
}

class Walk {
 public:
  Walk(const Domain& domain, const std::string& tree, Verdict& verdict) : d_(domain), tree_(tree), verdict_(verdict) {}

  void run() {
    std::vector<Box> ahead{d_.box};
    while (!ahead.empty()) {
      const Box box = ahead.back();
      ahead.pop_back();
      const int code = byte();
      if (code < d_.dimension) {
        auto [low, high] = halves(box, static_cast<std::size_t>(code), d_.dimension);
        ahead.push_back(high);
        ahead.push_back(low);
        continue;
      }
      leaf(box, code);
    }
    if (at_ != tree_.size()) refuse("the tree goes on after its last box");
  }

 private:
  int byte() {
    if (at_ == tree_.size()) refuse("the tree ends too early");
    return static_cast<unsigned char>(tree_[at_++]);
  }
  float weight() {
    std::uint32_t bits = 0;
    for (int shift : {0, 8, 16, 24}) bits |= static_cast<std::uint32_t>(byte()) << shift;
    return std::bit_cast<float>(bits);
  }

  void leaf(const Box& box, int code) {
    std::optional<Weights> by;
    if (code == 18 || code == 19) {
      by = Weights{weight(), weight(), 0.0F, 0.0F};
      if (code == 19) by->external = weight(), by->upper = weight();
      if (!(by->max >= 0.0F && by->max <= 1.0F && by->min >= 0.0F && by->min <= 1.0F))
        refuse("a weight is not from 0 to 1");
      if (!std::isfinite(by->external) || !std::isfinite(by->upper)) refuse("a weight is not finite");
      if (code == 19 && !(d_.leg_ratio < inf)) refuse("a weight of a limit that the study does not have");
    } else if (code != 16 && code != 17) {
      refuse("byte " + std::to_string(code) + " of the tree means nothing");
    }
    ++verdict_.leaves;
    if (!closed(box, by, 0)) refuse("a box is not proved to hold no design below the target");
  }

  /// Whatever the tree says, all that excludes a box counts; where rounding or a wider formula leaves a doubt, its
  /// parts are looked at.
  bool closed(const Box& box, const std::optional<Weights>& by, int depth) {
    for (const Range& r : box)
      if (!r.sound()) return false;
    if (outside(d_, box)) return true;
    const Pieces p = pieces(box, d_.dimension);
    if (by_ranges(p, d_) || (by && by_combination(p, box, d_, *by))) return true;
    if (depth == 0) {
      const Box part = narrowed(d_, box);
      if (empty(part)) return true;
      if (part != box) return closed(part, by, 1);
    }
    constexpr int deepest = 12;
    constexpr long to_begin_with = 10'000;  // a sound certificate needs one for each four boxes
    if (depth == deepest || verdict_.recut >= to_begin_with + verdict_.leaves) return false;
    ++verdict_.recut;
    std::size_t widest = 0;
    double width = -1.0;
    for (std::size_t k = 0; k < static_cast<std::size_t>(d_.dimension); ++k) {
      const double w = std::log(box[k].b / box[k].a);
      if (w > width) width = w, widest = k;
    }
    const auto [low, high] = halves(box, widest, d_.dimension);
    return closed(low, by, depth + 1) && closed(high, by, depth + 1);
  }

  const Domain& d_;
  const std::string& tree_;
  Verdict& verdict_;
  std::size_t at_ = 0;
};

/// Fifteen digits, never more than x > 1: a double has at most 52 binary places, which 52 decimal ones hold exactly.
std::string rounded_down(double x) {
  std::array<char, 400> exact{};
  std::snprintf(exact.data(), exact.size(), "%.52f", x);
  std::string text(exact.data());
  const std::size_t point = text.find('.');
  text.resize(point + 1 + (point < 15 ? 15 - point : 0));
  while (text.back() == '0') text.pop_back();
  if (text.back() == '.') text.pop_back();
  return text;
}

}  // namespace

Verdict check(const std::string& certificate) {
  Verdict out;
  try {
    volatile double least = std::numeric_limits<double>::min(), half = 0.5;
    if (std::fegetround() != FE_TONEAREST || !(least * half > 0.0))
      refuse("numbers are not rounded as they must be here: to nearest, with gradual underflow");
    const Certificate c = read(certificate);
    const Domain d = domain_of(c);
    if (empty(d.box)) {
      if (c.tree != "\x10") refuse("the domain holds no design, and the tree is more than one box");
      out.leaves = 1;
    } else {
      for (const Range& r : d.box)
        if (!r.sound() || !(r.a > 0.0) || !(r.b < inf)) refuse("the domain has no bounds");
      Walk(d, c.tree, out).run();
    }
    out.words = "no design of this study has a condition number below " + rounded_down(c.target);
    out.proved = true;
  } catch (const std::exception& error) {
    out.words = error.what();
  }
  return out;
}

}  // namespace ninedof::checker
