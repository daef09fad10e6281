#include "proof/checker/workspace.hpp"

#include <memory>

namespace ninedof::checker::sets {
namespace {

enum Code : unsigned { cut_at = 3, outside = 16, inside = 17, open = 18 };
constexpr double most_share = 65535.0;
constexpr int between_narrowings = 3, cuts_of_leaf = 400;
constexpr std::size_t most_compared = 8;

/// What has yet to be seen with one rotation.
struct OpenWant {
  const Want* want;
  int rotation;
};
/// One alternative is enough; of it all wants must hold.
using Alternatives = std::vector<std::vector<OpenWant>>;
using SharedAlternatives = std::shared_ptr<const Alternatives>;

/// A box of positions, and the part of its volume that is allowed.
struct Part {
  Patch box;
  SharedAlternatives ways;
  Range share{0.0, 1.0};
};

Range volume_of(const Patch& box) {
  Range out = 1.0;
  for (std::size_t k = 0; k < 3; ++k) out = out * (Range(box.high[k]) - Range(box.low[k]));
  return {std::max(out.a, 0.0), out.b};
}
std::pair<Patch, Patch> halves_at(const Patch& box, std::size_t k, double cut) {
  std::pair out(box, box);
  if (!(box.low[k] < cut && cut < box.high[k])) refuse("a cut is beside its box");
  out.first.high[k] = out.second.low[k] = cut;
  return out;
}
double middle_of(const Patch& box, std::size_t k) {
  return 0.5 * (box.low[k] + box.high[k]);
}

/// Whether the second is negative wherever in the box the first is.
bool covered(const Linear& x, const Linear& by) {
  const auto size = [](const Linear& of) { return 1e-12 * (swing(of) + std::abs(of.c) + of.r); };
  const std::vector<Point> corners = corners_beyond({-x.a[0], -x.a[1], -x.a[2]}, x.c - x.r - size(x));
  return !corners.empty() && std::ranges::all_of(corners, [&](const Point& t) {
    return by.c - by.r + by.a[0] * t[0] + by.a[1] * t[1] + by.a[2] * t[2] <= -size(by);
  });
}

/// Shares of the symbols' range as shares of a box: `along` may go beyond it by a rounding on each side.
Range of_positions(const Patch& box, const Range& share) {
  Range wider = 1.0;
  for (std::size_t k = 0; k < 3; ++k)
    if (box.low[k] < box.high[k])
      wider = wider * (Range(2.0 * along(box.low[k], box.high[k], k).a[k]) / (Range(box.high[k]) - Range(box.low[k])));
  return {share.a == 1.0 ? 1.0 : std::max(down(1.0 - up(up(1.0 - share.a) * wider.b)), 0.0),
          share.b == 0.0 ? 0.0 : std::min(up(share.b * wider.b), 1.0)};
}

/// At most the part of the box where one of them may be negative.
double share_of_any(const std::vector<Linear>& all) {
  std::vector<std::pair<double, const Linear*>> sizes;
  for (const Linear& x : all)
    if (const double share = share_below_zero(x).b; share > 0.0) sizes.emplace_back(share, &x);
  std::ranges::sort(sizes, [](const auto& x, const auto& y) { return x.first > y.first; });
  std::vector<const Linear*> counted;
  double sum = 0.0;
  for (const auto& [share, x] : sizes) {
    if (std::ranges::any_of(counted, [&](const Linear* one) { return covered(*x, *one); })) continue;
    sum = up(sum + share);
    if (!(sum < 1.0)) return 1.0;
    if (counted.size() < most_compared) counted.push_back(x);
  }
  return sum;
}

class WorkspaceReplay {
 public:
  WorkspaceReplay(const DesignsFile& file, Stream& stream, const Reading& reading, Verdict& out)
      : file_(file),
        tree_(stream, file.space.tree),
        reading_(reading),
        out_(out),
        wants_(wants_of(file, unknown_)),
        weigher_(file, {}) {}

  void run(Stream& stream) {
    require_shared_joints(file_, mount(file_, {}));
    for (const Want& want : wants_)
      if (want.about == Want::About::spread || want.about == Want::About::design)
        refuse(file_.limits[static_cast<std::size_t>(want.limit - 2)].name + " is no limit of a pose");
    walk();
    tree_.finish();
    stream.finish();
    write_verdict();
  }

 private:
  Part everything() const {
    Part out;
    std::copy_n(file_.space.low.begin(), 3, out.box.low.begin());
    std::copy_n(file_.space.high.begin(), 3, out.box.high.begin());
    Alternatives ways(file_.space.some ? file_.space.rotations.size() : 1);
    for (int r = 0; r < std::ssize(file_.space.rotations); ++r)
      for (const Want& want : wants_) ways[file_.space.some ? static_cast<std::size_t>(r) : 0].push_back({&want, r});
    out.ways = std::make_shared<const Alternatives>(std::move(ways));
    return out;
  }

  void walk() {
    struct Waiting {
      Part part;
      int depth;
    };
    std::vector<Waiting> ahead{{everything(), 0}};
    while (!ahead.empty()) {
      auto [part, depth] = std::move(ahead.back());
      ahead.pop_back();
      if (ahead.size() > most_waiting) refuse("the tree is too deep");
      const unsigned code = tree_.byte();
      if (code >= 2 * cut_at) {
        leaf(part, code);
        continue;
      }
      const std::size_t k = code % cut_at;
      const double cut = code < cut_at ? middle_of(part.box, k) : tree_.long_real();
      const auto [low, high] = halves_at(part.box, k, cut);
      if (depth % between_narrowings == between_narrowings - 1) look(part);
      ahead.push_back({{high, part.ways}, depth + 1});
      ahead.push_back({{low, part.ways}, depth + 1});
    }
  }

  void leaf(const Part& part, unsigned code) {
    Range claimed = code == inside ? 1.0 : 0.0;
    if (code == open) {
      claimed.a = tree_.pair() / most_share;
      claimed.b = tree_.pair() / most_share;
      if (!claimed.sound()) refuse("the shares of a box are inverted");
    } else if (code != inside && code != outside) {
      refuse("byte " + std::to_string(code) + " of the tree means nothing");
    }
    count_leaf(tree_, reading_, out_);
    const Range own = share_of(part, claimed);
    if (excluded(claimed, own)) refuse("box " + digits(out_.leaves) + " does not have the share that is claimed");
    if (!confirmed(claimed, own)) ++open_;
    if (own.b > 0.0) sum_ = meet(sum_ + own * volume_of(part.box), {0.0, inf});
  }
  /// Up to the rounding of a sum over parts.
  static bool confirmed(const Range& claimed, const Range& own) {
    return claimed.a <= own.a + 1e-12 && own.b <= claimed.b;
  }
  /// Of limits that the checker does not know less may be allowed than it sees.
  bool excluded(const Range& claimed, const Range& own) const {
    return claimed.a > own.b || (unknown_.empty() && claimed.b < own.a);
  }

  /// The share of a box that is allowed, in parts where that is needed to see what is claimed of it. Those are shares
  /// of the greatest volume that the box may have: times its volume they are bounds again.
  Range share_of(Part part, const Range& claimed) {
    look(part);
    const double whole = volume_of(part.box).b;
    std::vector<std::pair<Part, double>> parts{{std::move(part), 1.0}};
    for (long cuts = 0;; ++cuts) {
      Range sum;
      std::size_t worst = 0;
      const auto gap = [&](std::size_t n) {
        return (parts[n].first.share.b - parts[n].first.share.a) * parts[n].second;
      };
      for (std::size_t n = 0; n < parts.size(); ++n) {
        if (const Range& share = parts[n].first.share; share.b > 0.0)
          sum = sum + share * (volume_of(parts[n].first.box) / Range(whole));
        if (gap(n) > gap(worst)) worst = n;
      }
      if (parts.size() == 1) sum = parts[0].first.share;
      sum = meet(sum, {0.0, 1.0});
      if (confirmed(claimed, sum) || claimed.a > sum.b || claimed.b < sum.a || cuts == cuts_of_leaf ||
          out_.recut > 100'000 + 4 * out_.leaves)
        return sum;
      const Patch box = parts[worst].first.box;
      std::size_t k = 0;
      for (std::size_t i = 1; i < 3; ++i)
        if (box.high[i] - box.low[i] > box.high[k] - box.low[k]) k = i;
      const double middle = middle_of(box, k);
      if (!(box.low[k] < middle && middle < box.high[k])) return sum;
      if (++out_.recut % 64 == 0 && reading_) reading_(tree_.read(), tree_.size());
      const auto [low, high] = halves_at(box, k, middle);
      const SharedAlternatives ways = parts[worst].first.ways;
      const double half = 0.5 * parts[worst].second;
      parts[worst] = {{low, ways}, half};
      parts.push_back({{high, ways}, half});
      look(parts[worst].first);
      look(parts.back().first);
    }
  }

  /// Drops the wants that hold in all of the box, and bounds its allowed share.
  void look(Part& part) const {
    auto left = std::make_shared<Alternatives>();
    Range share = 0.0;
    for (const std::vector<OpenWant>& way : *part.ways) {
      std::vector<OpenWant> still;
      std::vector<Linear> cuts;
      double broken = 0.0;
      for (const OpenWant& one : way) {
        part.box.piece = one.rotation;
        const Sides sides = weigher_.sides(*one.want, part.box);
        if (std::ranges::all_of(sides.keeps, [](const Linear& x) { return lower_end(x) > 0.0; })) continue;
        still.push_back(one);
        cuts.insert(cuts.end(), sides.keeps.begin(), sides.keeps.end());
        for (const Linear& x : sides.breaks)
          broken = upper_end(x) < 0.0 ? 1.0 : std::max(broken, share_below_zero(x).a);
        if (broken == 1.0) break;
      }
      if (broken == 1.0) continue;
      share.a = std::max(share.a, down(1.0 - share_of_any(cuts)));
      share.b = std::min(up(share.b + up(1.0 - broken)), 1.0);
      if (still.empty()) share = 1.0;
      left->push_back(std::move(still));
    }
    part.share = of_positions(part.box, {std::max(share.a, 0.0), share.b});
    part.ways = std::move(left);
  }

  void write_verdict() {
    const Range& claimed = file_.space.volume;
    out_.study = question_of(file_);
    if (excluded(claimed, sum_)) refuse("the volume is not that of the boxes");
    out_.proved = claimed.a <= sum_.a && sum_.b <= claimed.b && unknown_.empty();
    out_.incomplete = !out_.proved;
    const std::size_t n = file_.space.rotations.size();
    const std::string with = n == 1             ? " that keep every limit"
                             : file_.space.some ? " that keep every limit with one of " + digits(n) + " rotations"
                                                : " that keep every limit with all of " + digits(n) + " rotations";
    const Range& shown = out_.proved ? claimed : sum_;
    const std::string volume = unknown_.empty() ? " from " + digits(shown.a) + " to " : " of at most ";
    out_.words = "the positions of this box" + with + " have a volume" + volume + digits(shown.b);
    if (out_.proved) return;
    out_.words = "not confirmed is the volume, " + digits(claimed.a) + " to " + digits(claimed.b) +
                 ", by the shares of " + digits(open_) + " of " + digits(out_.leaves) + " boxes; " + out_.words;
    for (const std::string& name : unknown_) out_.words += "; not checked: " + name;
  }

  const DesignsFile& file_;
  TreeBytes tree_;
  const Reading& reading_;
  Verdict& out_;
  std::vector<std::string> unknown_;
  std::vector<Want> wants_;
  Weigher weigher_;
  Range sum_ = 0.0;
  long open_ = 0;
};

}  // namespace

/// Of a box with the sides m from 0: the sum over corners of (p - m . corner)^d / (d! m1 ... md), signs in turn. Slopes
/// that are small beside the others would be divided by, and count as errors.
Range share_below_zero(const Linear& x) {
  if (!(std::abs(x.c) + swing(x) + x.r < inf)) return {0.0, 1.0};
  const double most = std::max({std::abs(x.a[0]), std::abs(x.a[1]), std::abs(x.a[2])});
  std::vector<Range> sides;
  Range all = 0.0;
  double error = (x.r + grain::of_product * (std::abs(x.c) + swing(x))) * grain::up;
  for (std::size_t k = 0; k < 3; ++k) {
    const double a = std::abs(x.a[k]);
    if (a > 1e-5 * most) {
      sides.emplace_back(2.0 * a);
      all = all + a;
    } else {
      error = up(error + a);
    }
  }
  const auto share = [&](double c) -> Range {
    const Range p = all - c;
    if (p.b < 0.0 || sides.empty()) return c < 0.0 ? 1.0 : 0.0;
    if ((p - 2.0 * all).a > 0.0) return 1.0;
    Range sum = 0.0, under = 1.0;
    for (unsigned corner = 0; corner < 1U << sides.size(); ++corner) {
      Range rest = p, power = 1.0;
      for (std::size_t k = 0; k < sides.size(); ++k)
        if ((corner >> k & 1U) != 0U) rest = rest - sides[k];
      rest = {std::max(rest.a, 0.0), std::max(rest.b, 0.0)};
      for (std::size_t k = 0; k < sides.size(); ++k) power = power * rest;
      sum = std::popcount(corner) % 2 == 0 ? sum + power : sum - power;
    }
    for (std::size_t k = 0; k < sides.size(); ++k) under = under * sides[k] * static_cast<double>(k + 1);
    return meet(sum / under, {0.0, 1.0});
  };
  return {share(up(x.c + error)).a, share(down(x.c - error)).b};
}

void replay_workspace(const DesignsFile& file, Stream& stream, const Reading& reading, Verdict& out) {
  WorkspaceReplay(file, stream, reading, out).run(stream);
}

}  // namespace ninedof::checker::sets
