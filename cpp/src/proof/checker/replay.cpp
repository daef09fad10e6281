#include "proof/checker/replay.hpp"

#include <cmath>
#include <cstdio>
#include <deque>
#include <numeric>

namespace ninedof::checker::sets {
namespace {

constexpr int most_depth = 1000, most_halvings = 10, deepest_outside = 48;
constexpr long cuts_of_outside = 4000;
constexpr long large_first = 4096, between_reports = 4096;
constexpr long spots_of_node = 2000, spots_of_leaf = 300'000, spots_of_machine = 20'000'000;
/// Poses are divided until they move a leg by less than this part of what the designs do.
constexpr double part_of_designs = 0.5;

/// A want that is not yet known of some boxes of poses. All others are done for every design of the box.
struct Pending {
  const Want* want;
  std::vector<Spot> spots;
  std::array<double, most_varied_symbols> moves{};  ///< of the designs, at these spots
};

Cube middle_of_cube(const Cube& cube) {
  Cube out = cube;
  for (Range& x : out) x = Range(std::clamp(0.5 * x.a + 0.5 * x.b, x.a, x.b));
  return out;
}
Patch middle_of_patch(Patch patch) {
  for (std::size_t k = 0; k < pose_symbols; ++k)
    patch.low[k] = patch.high[k] = 0.5 * patch.low[k] + 0.5 * patch.high[k];
  return patch;
}

class DesignsReplay {
 public:
  DesignsReplay(const DesignsFile& file, const Reading& reading, Verdict& out)
      : file_(file), reading_(reading), out_(out), wants_(wants_of(file, unknown_)) {
    for (std::size_t k = 0; k < file.varied.size(); ++k) whole_[k] = file.variables[file.varied[k]].range;
  }

  void run() {
    std::vector<std::size_t> all(file_.boxes.size());
    std::iota(all.begin(), all.end(), std::size_t{0});
    require_shared_joints(file_, mount(file_, whole_));
    node(whole_, all, everything(), 0);
    say();
  }

 private:
  std::size_t dimensions() const { return file_.varied.size(); }
  void report() const {
    if (reading_) reading_(static_cast<std::size_t>(out_.leaves), file_.boxes.size());
  }

  /// The poses at which a want holds: of the design alone the neutral one stands for all.
  std::vector<Patch> poses_of(const Want& want) const {
    using About = Want::About;
    const bool of_design = want.about == About::height || want.about == About::design;
    if (of_design || (want.limit > 1 && file_.limits[static_cast<std::size_t>(want.limit - 2)].at_neutral)) return {{}};
    std::vector<Patch> out = all_poses(file_);
    if (want.limit == 0 && out.front().piece != -1) out.emplace_back();
    return out;
  }
  std::vector<Pending> everything() const {
    std::vector<Pending> out;
    for (const Want& want : wants_) {
      Pending one{&want, {}};
      const std::vector<Patch> poses = poses_of(want);
      for (const Patch& at : poses)
        for (const Patch& other : want.about == Want::About::spread ? poses : std::vector<Patch>{{}})
          one.spots.push_back({at, other});
      out.push_back(std::move(one));
    }
    return out;
  }

  /// The boxes are a division of the cube: one that is the cube, or those on both sides of a cut that meets none.
  void node(const Cube& cube, std::vector<std::size_t> boxes, std::vector<Pending> pending, int depth) {
    if (boxes.size() == 1) {
      const BoxLine& one = file_.boxes[boxes[0]];
      if (one.ends != cube) refuse("the boxes are no division of all designs: box " + digits(boxes[0] + 1));
      leaf(one, boxes[0], std::move(pending));
      return;
    }
    if (depth > most_depth) refuse("the boxes are no division by cuts: there are too many");
    std::size_t axis = 0;
    double cut = 0.0, best = 0.0;
    for (std::size_t k = 0; k < dimensions(); ++k) {
      sort_by_low(boxes, k);
      double reached = cube[k].a;
      for (std::size_t i = 0; i + 1 < boxes.size(); ++i) {
        reached = std::max(reached, file_.boxes[boxes[i]].ends[k].b);
        const double next = file_.boxes[boxes[i + 1]].ends[k].a;
        const double part = std::min(next - cube[k].a, cube[k].b - next) / (whole_[k].b - whole_[k].a);
        if (reached <= next && part > best) {
          best = part;
          axis = k;
          cut = next;
        }
      }
    }
    if (!(best > 0.0)) refuse("the boxes are no division of all designs: some overlap, or one is missing");
    if (std::ranges::any_of(boxes, [&](std::size_t n) { return file_.boxes[n].state == 'i'; }))
      narrow(cube, pending, spots_of_node);
    else pending.clear();
    sort_by_low(boxes, axis);
    const auto second = std::ranges::find_if(boxes, [&](std::size_t n) { return file_.boxes[n].ends[axis].a >= cut; });
    Cube low = cube, high = cube;
    low[axis].b = high[axis].a = cut;
    node(low, {boxes.begin(), second}, pending, depth + 1);
    node(high, {second, boxes.end()}, std::move(pending), depth + 1);
  }
  void sort_by_low(std::vector<std::size_t>& boxes, std::size_t axis) const {
    std::ranges::stable_sort(boxes, {}, [&](std::size_t n) { return file_.boxes[n].ends[axis].a; });
  }

  void leaf(const BoxLine& box, std::size_t number, std::vector<Pending> pending) {
    if (out_.leaves % 16 == 0) report();
    ++out_.leaves;
    const std::string name = dimensions() == 0 ? "the machine" : "box " + digits(number + 1);
    left_ = dimensions() == 0 ? spots_of_machine : spots_of_leaf;
    const long before = out_.recut;
    double volume = 1.0;
    for (std::size_t k = 0; k < dimensions(); ++k)
      volume *= (box.ends[k].b - box.ends[k].a) / (whole_[k].b - whole_[k].a);
    if (box.state == 'u') shares_[2] += volume;
    if (box.state == 'i') {
      ++inside_;
      shares_[0] += volume;
      if (!inside(box.ends, std::move(pending), most_halvings, name)) ++inside_open_;
    }
    if (box.state == 'o') {
      ++outside_;
      shares_[1] += volume;
      left_ = cuts_of_outside;
      if (!outside(box.ends, box, deepest_outside, name)) ++outside_open_;
    }
    if (out_.recut > before) out_.recut = before + 1;
  }

  /// Divides boxes of poses until the designs move the legs more than the poses do, and leaves what is not known.
  /// All designs of a box that has a name are called inside: now and then one of them is tried.
  void narrow(const Cube& cube, std::vector<Pending>& pending, long most, const std::string& name = "") {
    const Weigher weigher(file_, cube);
    for (Pending& one : pending) {
      std::deque<Spot> ahead(one.spots.begin(), one.spots.end());
      std::vector<Spot> left;
      one.moves = {};
      for (long count = 0; !ahead.empty(); ++count) {
        // Small ones first, as fewer have to be kept. Of a machine that is called inside, large ones before them: small
        // ones where a limit is just kept do not show that it is broken elsewhere.
        const bool large = dimensions() == 0 && count < large_first;
        const Spot spot = large ? ahead.front() : ahead.back();
        large ? ahead.pop_front() : ahead.pop_back();
        if (count % between_reports == between_reports - 1) report();
        if (beside(file_, spot.at) || beside(file_, spot.other)) continue;
        --left_;
        const Weighed found = weigher.weigh(*one.want, spot);
        if (found.low > 0.0) continue;
        if (!name.empty() && count % 64 == 63) show_broken(cube, {{one.want, {spot}, {}}}, name);
        double designs = 0.0;
        std::size_t k = 0;
        for (std::size_t n = 0; n < found.moves.size(); ++n)
          if (n >= pose_symbols && n < symbols) designs = std::max(designs, found.moves[n]);
          else if (found.moves[n] > found.moves[k]) k = n;
        Spot low = spot, high = spot;
        Patch &first = k < symbols ? low.at : low.other, &second = k < symbols ? high.at : high.other;
        const std::size_t i = k % symbols;
        const double middle = 0.5 * first.low[i] + 0.5 * first.high[i];
        if (found.moves[k] > part_of_designs * designs && count < most && first.low[i] < middle &&
            middle < first.high[i]) {
          first.high[i] = second.low[i] = middle;
          ahead.push_back(high);
          ahead.push_back(low);
          continue;
        }
        left.push_back(spot);
        for (std::size_t n = 0; n < dimensions(); ++n)
          one.moves[n] = std::max(one.moves[n], found.moves[pose_symbols + n]);
      }
      one.spots = std::move(left);
    }
    std::erase_if(pending, [](const Pending& one) { return one.spots.empty(); });
  }

  bool inside(const Cube& cube, std::vector<Pending> pending, int halvings, const std::string& name) {
    narrow(cube, pending, left_, name);
    if (pending.empty()) return true;
    if (halvings == 0 || left_ <= 0 || dimensions() == 0) {
      show_broken(cube, pending, name);
      return false;
    }
    std::array<double, most_varied_symbols> moves{};
    for (const Pending& one : pending)
      for (std::size_t k = 0; k < moves.size(); ++k) moves[k] = std::max(moves[k], one.moves[k]);
    const auto [low, high] = halves_of(cube, static_cast<std::size_t>(std::ranges::max_element(moves) - moves.begin()));
    return inside(low, pending, halvings - 1, name) && inside(high, std::move(pending), halvings - 1, name);
  }
  std::pair<Cube, Cube> halves_of(const Cube& cube, std::size_t k) {
    ++out_.recut;
    std::pair<Cube, Cube> out(cube, cube);
    out.first[k].b = out.second[k].a = middle_of_cube(cube)[k].a;
    return out;
  }
  /// One design that breaks a limit at one pose shows that a box is not inside.
  void show_broken(const Cube& cube, const std::vector<Pending>& pending, const std::string& name) const {
    const Weigher weigher(file_, middle_of_cube(cube));
    for (const Pending& one : pending)
      for (const Spot& spot : one.spots) {
        const Spot point{drawn_in(file_, {spot.at}, middle_of_patch(spot.at)),
                         drawn_in(file_, {spot.other}, middle_of_patch(spot.other))};
        if (weigher.weigh(*one.want, point).high < 0.0)
          refuse(name + " is called inside, and its design in the middle breaks " + limit_name(one.want->limit));
      }
  }
  std::string limit_name(int limit) const {
    return limit == 0   ? "no singularity"
           : limit == 1 ? "0 < zs < zp"
                        : file_.limits[static_cast<std::size_t>(limit - 2)].name;
  }

  bool outside(const Cube& cube, const BoxLine& box, int halvings, const std::string& name) {
    if (box.limit < 0 || box.limit > 1 + static_cast<int>(file_.limits.size())) refuse(name + " names no limit");
    const Weigher all(file_, cube);
    std::vector<std::pair<const Want*, Spot>> broken;
    std::array<double, most_varied_symbols> moves{};
    for (const Want& want : wants_) {
      if (want.limit != box.limit) continue;
      const std::vector<Patch> poses = poses_of(want);
      Spot spot;
      if (poses.size() > 1 || poses[0].piece != -1)
        spot = {drawn_in(file_, poses, box.at), drawn_in(file_, poses, box.other)};
      const Weighed found = all.weigh(want, spot);
      if (found.high < 0.0) return true;
      for (std::size_t k = 0; k < moves.size(); ++k) moves[k] = std::max(moves[k], found.moves[pose_symbols + k]);
      broken.emplace_back(&want, spot);
    }
    const Weigher middle(file_, middle_of_cube(cube));
    const bool known = std::ranges::find(unknown_, limit_name(box.limit)) == unknown_.end();
    if (known &&
        std::ranges::all_of(broken, [&](const auto& one) { return middle.weigh(*one.first, one.second).low > 0.0; }))
      refuse(name + " is called outside, and its design in the middle keeps the limit at that pose");
    if (halvings == 0 || dimensions() == 0 || --left_ < 0) return false;
    const auto [low, high] = halves_of(cube, static_cast<std::size_t>(std::ranges::max_element(moves) - moves.begin()));
    return outside(low, box, halvings - 1, name) && outside(high, box, halvings - 1, name);
  }

  void say() {
    for (std::size_t k = 0; k < shares_.size(); ++k)
      if (!(std::abs(shares_[k] - file_.shares[k]) <= 1e-9)) refuse("the shares are not those of the boxes");
    out_.study = question_of(file_);
    out_.words = statement();
    out_.incomplete = inside_open_ > 0 || outside_open_ > 0 || !unknown_.empty();
    out_.proved = !out_.incomplete;
    if (!out_.incomplete) return;
    out_.words = "not confirmed are " + digits(inside_open_) + " of " + digits(inside_) + " boxes inside and " +
                 digits(outside_open_) + " of " + digits(outside_) + " outside";
    for (const std::string& name : unknown_) out_.words += "; not checked: " + name;
  }

  std::string statement() const {
    const bool machine = dimensions() == 0, all_outside = outside_ == std::ssize(file_.boxes);
    const char* region = file_.region.shape == "none" ? "" : " of the region";
    if (machine && inside_ == 1) return std::string("the machine keeps every limit at every pose") + region;
    if (machine && all_outside) return std::string("the machine breaks a limit at a pose") + region;
    double least = inf;
    for (const LimitLine& one : file_.limits)
      if (one.name == "condition_number" && !one.at_neutral) least = std::min(least, one.range.b);
    if (all_outside && least < inf)
      return "no design of this study has a condition number below " + rounded_down(least) +
             (*region != 0           ? " over its region"
              : !file_.poses.empty() ? " at its poses"
                                     : " at the neutral pose");
    char text[160];
    std::snprintf(text, sizeof text,
                  "%.3f%% of these designs keep every limit at every pose, %.3f%% break one; %.3f%% are not decided",
                  100.0 * shares_[0], 100.0 * shares_[1], 100.0 * shares_[2]);
    return text;
  }

  const DesignsFile& file_;
  const Reading& reading_;
  Verdict& out_;
  std::vector<std::string> unknown_;
  std::vector<Want> wants_;
  Cube whole_{};
  std::array<double, 3> shares_{};
  long inside_ = 0, outside_ = 0, inside_open_ = 0, outside_open_ = 0, left_ = 0;
};

}  // namespace

void replay(const DesignsFile& file, const Reading& reading, Verdict& out) {
  DesignsReplay(file, reading, out).run();
}

}  // namespace ninedof::checker::sets
