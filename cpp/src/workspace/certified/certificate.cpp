/// Certified workspaces as files that a checker replays. Declared in ninedof/workspace/certified.hpp.

#include <algorithm>
#include <cmath>
#include <numbers>

#include "limits/pose_row.hpp"
#include "ninedof/math/error.hpp"
#include "proof/optimum/certificate_lines.hpp"
#include "robot/leg_pairs.hpp"
#include "workspace/certified/box_tree.hpp"
#include "workspace/certified/scale.hpp"
#include "workspace/certified/search.hpp"
#include "workspace/criteria/limits.hpp"

namespace ninedof {
namespace certified {
namespace {

constexpr char cut_at = 3, outside = 16, inside = 17, open_box = 18;
constexpr double most_share = 65535.0;
constexpr double beside = 1e-11;  ///< of all coordinates: left between the box divided and where legs are too long
constexpr double slack = 1e-9;  ///< of the volumes: for sums that are rounded in another order

class WorkspaceLines : proof::CertificateLines {
 public:
  WorkspaceLines(const Question& question, const CertifiedWorkspace& found) : question_(question), found_(found) {}

  std::string written() {
    const Geometry& g = question_.geometry;
    const Configuration& home = question_.home;
    const WorkspaceDomain& domain = question_.domain;
    for (const Triple* t : {&g.base_external(), &g.base_internal(), &g.platform_external(), &g.platform_internal()})
      for (const Vec3& joint : *t) line("joint", {joint});
    const auto rows = [](const Mat3& q) { return spelled({Vec3(q.row(0)), Vec3(q.row(1)), Vec3(q.row(2))}); };
    line("home", {home.position}, rows(home.rotation) + spelled({home.internal_point}));
    line("characteristic_length", {question_.criteria.characteristic_length});
    line("space", {domain.low, domain.high});
    const InternalPointRule& rule = question_.rule;
    if (rule.kind == InternalPointRule::Kind::best) throw InvalidArgument("internal_point", "\"best\"", "a formula");
    const char* kind = std::array{"fixed", "between", "platform"}[static_cast<std::size_t>(rule.kind)];
    line(std::string("internal_point ") + kind, {rule.point.x(), rule.point.y(), rule.point.z(), rule.fraction});
    line(domain.archetype == Archetype::reachable ? "allowed_with some" : "allowed_with all");
    for (const Mat3& q : domain.rotations) line("rotation", {}, rows(q));
    put_duty(question_.criteria.limits);
    put_limits();
    put_tree();
    line("volume", {std::max(volume_.lo, 0.0) * (1.0 - slack), volume_.hi * (1.0 + slack)});
    line("tree " + std::to_string(tree_.size()));
    return proof::sealed("ninedof certificate of a workspace 1", text_ + tree_);
  }

 private:
  void put_limits() {
    const WorkspaceCriteria& criteria = question_.criteria;
    const auto put = [&](const std::string& name, double low, double high, const Vec3& axis) {
      put_limit(name, std::max(low, 0.0), high, "length", false, axis);
    };
    if (criteria.legs)
      for (int k = 0; k < 9; ++k) put(leg_name(k), criteria.legs->low[k], criteria.legs->high[k], Vec3::Zero());
    bool pairs = false;
    for (const PoseCriterion& c : criteria_besides_legs(criteria)) {
      const bool any_angle = c.row->info.kind == LimitKind::angle && c.high >= std::numbers::pi;
      put(c.row->info.name, c.low, any_angle ? std::numeric_limits<double>::infinity() : c.high, c.options.axis);
      pairs = pairs || (c.row->pose != nullptr && c.row->pose->pairs);
    }
    const std::array<bool, leg_pairs> exempt = pairs_sharing_a_joint(question_.geometry, criteria.exempt);
    for (std::size_t k = 0; pairs && k < exempt.size(); ++k)
      if (exempt[k]) line("exempt " + std::to_string(k));
  }

  /// What lies beside the box that was divided, then the halves of it, the boxes found being some of them.
  void put_tree() {
    PositionBox all{question_.domain.low, question_.domain.high};
    const double size = std::ldexp(1.0, 1 - exponent_of(question_));
    std::string after;
    for (int k = 0; k < 3; ++k) {
      const double low = found_.low[k], high = found_.high[k];
      const double gap = beside * (size + std::abs(low) + std::abs(high));
      for (const double at : {low - gap, low})
        if (all.low[k] < at && at < all.high[k]) {
          put_cut(k, at);
          leaf(at == low ? open_box : outside, 0.0, slab(all, k, at, false), tree_);
        }
      for (const double at : {high + gap, high})
        if (all.low[k] < at && at < all.high[k]) {
          put_cut(k, at);
          std::string one;
          leaf(at == high ? open_box : outside, 0.0, slab(all, k, at, true), one);
          after.insert(0, one);
        }
    }
    put_halves(all);
    tree_ += after;
  }
  void put_cut(int k, double at) {
    tree_ += static_cast<char>(cut_at + k);
    const auto bits = std::bit_cast<std::uint64_t>(at);
    for (unsigned shift = 0; shift < 64; shift += 8) tree_ += static_cast<char>(bits >> shift & 0xFFU);
  }
  /// Takes the part of a box below or above a cut off it.
  static PositionBox slab(PositionBox& all, int k, double at, bool above) {
    PositionBox out = all;
    (above ? out.low : out.high)[k] = at;
    (above ? all.high : all.low)[k] = at;
    return out;
  }
  void leaf(char code, double low, const PositionBox& box, std::string& to, double high = most_share) {
    to += code;
    if (code == outside) return;
    if (code == inside) low = high = most_share;
    else
      for (const double share : {low, high})
        for (const unsigned shift : {0U, 8U}) to += static_cast<char>(static_cast<unsigned>(share) >> shift & 0xFFU);
    volume_ += volume_of(box) * Interval(low / most_share, high / most_share);
  }

  struct Ahead {
    PositionBox box;
    std::vector<std::size_t> found;  ///< those from inner_low.size() on are open
  };
  void put_halves(const PositionBox& all) {
    const std::size_t inner = found_.inner_low.size();
    std::vector<std::size_t> every(inner + found_.open_low.size());
    for (std::size_t n = 0; n < every.size(); ++n) every[n] = n;
    const auto low_of = [&](std::size_t n) { return n < inner ? found_.inner_low[n] : found_.open_low[n - inner]; };
    const auto high_of = [&](std::size_t n) { return n < inner ? found_.inner_high[n] : found_.open_high[n - inner]; };
    std::vector<Ahead> ahead{{all, std::move(every)}};
    while (!ahead.empty()) {
      const Ahead one = std::move(ahead.back());
      ahead.pop_back();
      if (one.found.empty()) {
        leaf(outside, 0.0, one.box, tree_);
        continue;
      }
      const std::size_t n = one.found.front();
      if (low_of(n) == one.box.low && high_of(n) == one.box.high) {
        if (n < inner) leaf(inside, 0.0, one.box, tree_);
        else put_open(n - inner, one.box);
        continue;
      }
      const std::vector<PositionBox> halves = halves_of(one.box);
      if (halves.empty()) throw InvalidArgument("found", "boxes of another question", "those of certified_workspace");
      Eigen::Index k = 0;
      (one.box.high - one.box.low).maxCoeff(&k);
      tree_ += static_cast<char>(k);
      Ahead low{halves[0], {}}, high{halves[1], {}};
      for (const std::size_t m : one.found) (low_of(m)[k] < halves[1].low[k] ? low : high).found.push_back(m);
      ahead.push_back(std::move(high));
      ahead.push_back(std::move(low));
    }
  }
  void put_open(std::size_t n, const PositionBox& box) {
    const VolumeBounds& part = found_.open_volume[n];
    const Interval whole = volume_of(box);
    const double low = std::floor(most_share * (part.low / whole.hi) * (1.0 - slack));
    const double high = std::ceil(most_share * (part.high / whole.lo) * (1.0 + slack));
    leaf(open_box, low >= 0.0 ? low : 0.0, box, tree_, high <= most_share ? high : most_share);
  }

  const Question& question_;
  const CertifiedWorkspace& found_;
  Interval volume_;
  std::string tree_;
};

}  // namespace
}  // namespace certified

std::string workspace_certificate(const Geometry& g, const WorkspaceDomain& domain, const InternalPointRule& rule,
                                  const WorkspaceCriteria& criteria, const CertifiedWorkspace& found,
                                  const std::optional<Configuration>& home) {
  const certified::Question question{g, domain, rule, criteria,
                                     certified::home_or_middle(g, domain, rule, criteria, home)};
  return certified::WorkspaceLines(question, found).written();
}

}  // namespace ninedof
