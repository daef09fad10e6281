#include "ninedof/workspace/certified.hpp"

#include <cmath>

#include "math/numbers.hpp"
#include "math/time_limit.hpp"
#include "ninedof/math/error.hpp"
#include "ninedof/proof/bounds.hpp"
#include "workspace/certified/home_piece.hpp"
#include "workspace/certified/scale.hpp"
#include "workspace/certified/search.hpp"
#include "workspace/criteria/limits.hpp"
#include "workspace/requirements.hpp"

namespace ninedof {
namespace certified {
namespace {

constexpr long looks_beyond = 20'000;
constexpr double part_beyond = 0.5;   // of the time, at most
constexpr double least_gap = 1e-3;  // of all poses, relative to that asked for, where home's piece needs it

void require_certified(const WorkspaceDomain& domain, const InternalPointRule& rule, const WorkspaceCriteria& criteria,
                       const CertifySettings& settings) {
  if (domain.archetype == Archetype::orientation)
    throw InvalidArgument("archetype", "\"orientation\"",
                          "a workspace of positions: of orientations nothing is certified");
  if (rule.kind == InternalPointRule::Kind::best)
    throw InvalidArgument("internal_point", "\"best\"",
                          "a rule that is a formula: where O is searched for, nothing is certified");
  if (!criteria.legs && criteria.limits.empty() && !criteria.condition_number)
    throw InvalidArgument("criteria", "none", "at least one");
  if (!(settings.gap > 0.0 && settings.gap < 1.0))
    throw InvalidArgument("gap", format_number(settings.gap), "a number in (0, 1)");
  if (!(settings.seconds >= 0.0)) throw InvalidArgument("time_limit", format_number(settings.seconds), "at least 0");
  if (settings.boxes < 1) throw InvalidArgument("boxes", std::to_string(settings.boxes), "at least 1");
}

/// What is in `all` but not in `box`, as boxes.
std::vector<PositionBox> rest_of(PositionBox all, const PositionBox& box) {
  std::vector<PositionBox> out;
  for (int k = 0; k < 3; ++k) {
    for (const bool above : {false, true}) {
      PositionBox slab = all;
      if (above) slab.low[k] = std::max(slab.low[k], box.high[k]);
      else slab.high[k] = std::min(slab.high[k], box.low[k]);
      if (slab.low[k] < slab.high[k]) out.push_back(slab);
    }
    all.low[k] = std::max(all.low[k], box.low[k]);
    all.high[k] = std::min(all.high[k], box.high[k]);
    if (!(all.low[k] <= all.high[k])) break;  // nothing of it is in the box
  }
  return out;
}

CertifiedWorkspace::Beyond beyond(const LimitsOverBox& cuts, const PositionBox& reached, const PositionBox& box,
                                  bool some, const std::stop_token& stop) {
  using Beyond = CertifiedWorkspace::Beyond;
  if ((reached.low.array() > reached.high.array()).any()) return Beyond::nothing;  // no leg lengths fit anywhere
  if (!(reached.low.allFinite() && reached.high.allFinite())) return Beyond::unknown;
  Beyond out = Beyond::nothing;
  for (const PositionBox& slab : rest_of(reached, box)) {
    const Beyond one = anything_in(cuts, slab, some, looks_beyond, stop);
    if (one == Beyond::something) return one;
    if (one == Beyond::unknown) out = one;
  }
  return out;
}

void write_boxes(const Tree& tree, CertifiedWorkspace& out) {
  std::vector<int> leaves;
  for (int n = 0; n < static_cast<int>(tree.size()); ++n) {
    const Node& node = tree[static_cast<std::size_t>(n)];
    if (!node.leaf() || node.seen.outer()) continue;
    leaves.push_back(n);
    if (node.seen.inner()) {
      out.inner_low.push_back(node.box.low);
      out.inner_high.push_back(node.box.high);
      continue;
    }
    out.open_low.push_back(node.box.low);
    out.open_high.push_back(node.box.high);
    out.open_volume.push_back(volume_of_leaves(tree, {n}, {n}));
    out.first_cut.push_back(std::ssize(out.cuts));
    for (const Cut& cut : node.seen.cuts)
      out.cuts.push_back({{cut.slope[0], cut.slope[1], cut.slope[2]}, cut.allowed, cut.forbidden});
  }
  out.first_cut.push_back(std::ssize(out.cuts));
  out.volume = volume_of_leaves(tree, leaves, leaves);
}

}  // namespace
}  // namespace certified

CertifiedWorkspace certified_workspace(const Geometry& g, const WorkspaceDomain& domain, const InternalPointRule& rule,
                                       const WorkspaceCriteria& criteria, const CertifySettings& settings,
                                       const std::optional<Configuration>& home, const Control& control) {
  using namespace certified;
  const TimeLimit limit(settings.seconds, control.stop), beside(part_beyond * settings.seconds, control.stop);
  require_sound_arithmetic();
  require_question(domain, rule, criteria, home);
  require_certified(domain, rule, criteria, settings);
  const Question asked{g, domain, rule, criteria, home_or_middle(g, domain, rule, criteria, home)};
  const int exponent = exponent_of(asked);
  const Question question = scaled(asked, exponent);
  const bool some = domain.archetype == Archetype::reachable;
  const LimitsOverBox cuts(question.geometry, question.domain, question.rule, question.criteria, question.home);
  const PositionBox given{question.domain.low, question.domain.high}, reached = cuts.reached();
  const PositionBox box{given.low.cwiseMax(reached.low), given.high.cwiseMin(reached.high)};

  const bool nothing_there = (box.low.array() >= box.high.array()).any();
  if (!nothing_there && !std::isfinite(volume_of(box).hi))
    throw InvalidArgument("box", "one whose volume is no double beside the size of the joints", "a smaller one");

  CertifiedWorkspace out;
  // Before the search, which may take all the time there is. With many rotations each look takes long.
  out.beyond = beyond(cuts, reached, given, some, beside.stop());
  if (nothing_there) {
    out.home_outside = true;
    out.first_cut.push_back(0);
  } else {
    Grown grown = seed(cuts, box, some);
    CertifySettings now = settings;
    grow(grown, cuts, some, now, limit.stop(), control);
    HomePiece piece = home_piece(grown.tree, question.home.position);
    // Where only home's piece counts, its own gap is to be small: others go on for as long as it takes.
    const auto wide = [&] { return piece.volume.high - piece.volume.low > settings.gap * piece.volume.high; };
    while (asks_for_connection(criteria) && wide() && grown.end == CertifiedWorkspace::End::gap &&
           now.gap > least_gap * settings.gap) {
      now.gap *= 0.5;
      grow(grown, cuts, some, now, limit.stop(), control);
      piece = home_piece(grown.tree, question.home.position);
    }
    out.end = grown.end;
    out.looked = grown.looked;
    out.low = box.low;
    out.high = box.high;
    write_boxes(grown.tree, out);
    out.home_volume = piece.volume;
    out.home_inside = piece.inside;
    out.home_outside = piece.outside;
  }
  scale_back(out, exponent);
  out.box_low = domain.low;
  out.box_high = domain.high;
  if (nothing_there) {
    out.low = domain.low;
    out.high = domain.high;
  }
  return out;
}

}  // namespace ninedof
