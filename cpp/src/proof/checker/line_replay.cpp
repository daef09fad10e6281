/// The tree of a proof of non-planar designs. Declared in proof/checker/lines.hpp.

#include <optional>

#include "proof/checker/lines.hpp"

namespace ninedof::checker::lines {
namespace {

struct Waiting {
  Box box;
  Sides sides;
  bool empty = false;
};

class LineReplay {
 public:
  LineReplay(const Study& study, TreeBytes& tree, const Reading& reading, Verdict& out)
      : study_(study), tree_(tree), reading_(reading), out_(out) {}

  void run() {
    for (unsigned n = 0; n < 16; ++n) {
      Waiting root{study_.box, {(n & 1U) != 0U ? -1.0 : 1.0, (n & 2U) != 0U ? -1.0 : 1.0}};
      ((n & 4U) != 0U ? root.box[x_a].b : root.box[x_a].a) = 0.0;
      ((n & 8U) != 0U ? root.box[x_b].b : root.box[x_b].a) = 0.0;
      std::vector<Waiting> ahead{root};
      while (!ahead.empty()) {
        const Waiting next = ahead.back();
        ahead.pop_back();
        if (ahead.size() > most_waiting) refuse("the tree is too deep");
        node(next, ahead);
      }
    }
  }

 private:
  /// The reasons of a box, then its cut. Where the checker has seen that nothing is left, it only reads.
  void node(Waiting box, std::vector<Waiting>& ahead) {
    while (true) {
      const unsigned code = tree_.byte();
      if (code < coordinates) {
        const double at = tree_.long_real();
        if (!std::isfinite(at)) refuse("a box is cut at no number");
        Waiting low = box, high = box;
        low.box[code].b = std::min(box.box[code].b, at);
        high.box[code].a = std::max(box.box[code].a, at);
        for (Waiting* half : {&low, &high}) half->empty = half->empty || lines::empty(half->box);
        ahead.push_back(high);
        ahead.push_back(low);
        return;
      }
      if (code < 16 || code > 19) refuse("byte " + digits(code) + " of the tree means nothing");
      std::optional<Mixture> by;
      if (code > 17) by = mixture();
      const bool last = code == 16 || code == 18;
      if (last) count_leaf(tree_, reading_, out_);
      if (!box.empty && last && !closed(box.box, box.sides, by ? &*by : nullptr, 0))
        refuse("a box is not proved to hold no design below the target");
      if (last) return;
      box.empty = box.empty || !narrow(study_, box.box, box.sides, by ? &*by : nullptr);
    }
  }

  Mixture mixture() {
    const unsigned given = tree_.pair();
    if (given >> 14U != 0U) refuse("a mixture has more than fourteen entries");
    std::array<Range, 14> l;
    l.fill(0.0);
    for (unsigned k = 0; k < l.size(); ++k)
      if ((given >> k & 1U) != 0U) l[k] = double(tree_.real());
    const std::array<std::array<Range, 7>, 2> sums{entries_of_factors(&l[0]), entries_of_factors(&l[7])};
    Mixture out;
    std::array<Range, 2> trace{0.0, 0.0};
    for (std::size_t n = 0; n < 2; ++n) {
      for (const std::size_t k : {0, 2, 3, 6}) trace[n] = trace[n] + sums[n][k];
      if (!(trace[n].a > 0.0 && trace[n].b < inf)) refuse("a mixture has no vectors");
    }
    for (std::size_t k = 0; k < 7; ++k) {
      const Range x = sums[0][k] / trace[0] - square(Range(study_.target)) * (sums[1][k] / trace[1]);
      out.entry[k] = Linear(0.5 * (x.a + x.b), up(x.b - x.a));
    }
    for (unsigned count = tree_.byte(); count > 0; --count) {
      const std::size_t limit = tree_.byte();
      const double weight = tree_.real();
      if (!(weight >= 0.0 && weight < inf)) refuse("a weight is negative or not finite");
      out.limits.emplace_back(limit, weight);
    }
    return out;
  }
  /// L L* of both blocks, off the diagonal twice.
  static std::array<Range, 7> entries_of_factors(const Range* l) {
    return {square(l[0]),
            2.0 * l[0] * l[1],
            square(l[1]) + square(l[2]),
            square(l[3]),
            2.0 * l[3] * l[4],
            2.0 * l[3] * l[5],
            square(l[4]) + square(l[5]) + square(l[6])};
  }

  bool closed(Box box, Sides sides, const Mixture* by, int depth) {
    if (!narrow(study_, box, sides, by)) return true;
    if (!may_recut(depth, out_)) return false;
    std::size_t widest = 0;
    const auto width = [&](std::size_t k) { return (box[k].b - box[k].a) / (0.1 + size(box[k])); };
    for (std::size_t k = 1; k < coordinates; ++k)
      if (width(k) > width(widest)) widest = k;
    Box low = box, high = box;
    low[widest].b = high[widest].a = 0.5 * box[widest].a + 0.5 * box[widest].b;
    return closed(low, sides, by, depth + 1) && closed(high, sides, by, depth + 1);
  }

  const Study& study_;
  TreeBytes& tree_;
  const Reading& reading_;
  Verdict& out_;
};

}  // namespace

void replay(const Study& study, TreeBytes& tree, const Reading& reading, Verdict& out) {
  LineReplay(study, tree, reading, out).run();
}

}  // namespace ninedof::checker::lines
