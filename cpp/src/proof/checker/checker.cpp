#include "ninedof/proof/checker.hpp"

#include <cfenv>
#include <optional>
#include <stdexcept>
#include <streambuf>

#include "proof/checker/blocks.hpp"
#include "proof/checker/lines.hpp"
#include "proof/checker/replay.hpp"
#include "proof/checker/workspace.hpp"

namespace ninedof::checker {
namespace {

std::pair<Box, Box> halves(const Box& box, std::size_t k, const Domain& d) {
  std::pair out(box, box);
  const double m = std::clamp(std::sqrt(box[k].a) * std::sqrt(box[k].b), box[k].a, box[k].b);
  out.first[k].b = out.second[k].a = m;
  settle(out.first, d);
  settle(out.second, d);
  return out;
}

class Walk {
 public:
  Walk(const Domain& domain, TreeBytes& tree, Verdict& verdict, const Reading& reading)
      : d_(domain), tree_(tree), verdict_(verdict), reading_(reading) {}

  void run() {
    std::vector<Box> ahead{d_.box};
    while (!ahead.empty()) {
      const Box box = ahead.back();
      ahead.pop_back();
      if (ahead.size() > most_waiting) refuse("the tree is too deep");
      const int code = static_cast<int>(tree_.byte());
      if (code < d_.dimension) {
        auto [low, high] = halves(box, static_cast<std::size_t>(code), d_);
        ahead.push_back(high);
        ahead.push_back(low);
        continue;
      }
      leaf(box, code);
    }
  }

 private:
  void leaf(const Box& box, int code) {
    std::optional<Weights> by;
    if (code == 18 || code == 19) {
      by = Weights{tree_.real(), tree_.real()};
      if (code == 19) read_limits(*by);
      if (!(by->max >= 0.0F && by->max <= 1.0F && by->min >= 0.0F && by->min <= 1.0F))
        refuse("a weight is not from 0 to 1");
    } else if (code != 16 && code != 17) {
      refuse("byte " + std::to_string(code) + " of the tree means nothing");
    }
    count_leaf(tree_, reading_, verdict_);
    if (!closed(box, by, 0)) refuse("a box is not proved to hold no design below the target");
  }

  void read_limits(Weights& by) {
    const unsigned which = tree_.byte();
    if (which >> by.limits.size() != 0) refuse("a weight of a limit that does not exist");
    for (std::size_t i = 0; i < by.limits.size(); ++i) {
      if ((which >> i & 1U) == 0) continue;
      by.limits[i] = tree_.real();
      if (!std::isfinite(by.limits[i])) refuse("a weight is not finite");
      if (!(i < 2 ? d_.leg_ratio < inf : bound_of(d_, i, by.limits[i]) > 0.0))
        refuse("a weight of a limit that the study does not have");
    }
  }

  /// Whatever the tree says, all that excludes a box counts; where rounding or a wider formula leaves a doubt, its
  /// parts are looked at.
  bool closed(const Box& box, const std::optional<Weights>& by, int depth) {
    if (box[0].a > box[0].b) return true;
    for (const Range& r : box)
      if (!r.sound()) return false;
    if (outside(d_, box)) return true;
    if ((by && by_combination(box, d_, *by)) || by_ranges(box, d_)) return true;
    if (depth == 0) {
      const Box part = narrowed(d_, box);
      if (empty(part)) return true;
      if (part != box) return closed(part, by, 1);
    }
    if (!may_recut(depth, verdict_)) return false;
    std::size_t widest = 0;
    double width = -1.0;
    for (std::size_t k = 0; k < static_cast<std::size_t>(d_.dimension); ++k) {
      const double w = box[k].b / box[k].a;
      if (w > width) width = w, widest = k;
    }
    const auto [low, high] = halves(box, widest, d_);
    return closed(low, by, depth + 1) && closed(high, by, depth + 1);
  }

  const Domain& d_;
  TreeBytes& tree_;
  Verdict& verdict_;
  const Reading& reading_;
};

bool is_one_box(TreeBytes& tree) {
  return tree.size() == 1 && tree.byte() == 16;
}

void walk(const Certificate& c, TreeBytes& tree, const Reading& reading, Verdict& out) {
  const bool of_lines = c.family == "symmetric_nonplanar";
  const lines::Study study = of_lines ? lines::study_of_lines(c) : lines::Study();
  Domain d = of_lines ? Domain() : domain_of(c);
  if (!of_lines && !empty(d.box)) settle(d.box, d);
  if (of_lines ? lines::empty(study.box) : empty(d.box)) {
    if (!is_one_box(tree)) refuse("the domain holds no design, and the tree is more than one box");
    out.leaves = 1;
  } else if (of_lines) {
    lines::replay(study, tree, reading, out);
  } else {
    for (const Range& r : d.box)
      if (!r.sound() || !(r.a > 0.0) || !(r.b < inf)) refuse("the domain has no bounds");
    Walk(d, tree, out, reading).run();
  }
}

}  // namespace

Verdict check(std::istream& certificate, const Reading& reading) {
  Verdict out;
  std::optional<Stream> file;
  try {
    volatile double least = std::numeric_limits<double>::min(), half = 0.5;
    if (std::fegetround() != FE_TONEAREST || !(least * half > 0.0))
      refuse("numbers are not rounded as they must be here: to nearest, with gradual underflow");
    const std::string kind = file.emplace(certificate).kind();
    if (kind == sets::kind_of_designs) {
      sets::replay(sets::read_designs(*file), reading, out);
      return out;
    }
    if (kind == sets::kind_of_workspace) {
      sets::replay_workspace(sets::read_designs(*file), *file, reading, out);
      return out;
    }
    if (kind != kind_of_optimum) refuse(quoted(kind) + " is no kind of certificate");
    const Certificate c = read(*file);
    TreeBytes tree(*file, c.tree);
    walk(c, tree, reading, out);
    tree.finish();
    file->finish();
    out.study = study_of(c);
    out.words = "no design of this study has a condition number below " + rounded_down(c.target);
    out.proved = true;
  } catch (const std::exception& error) {
    out.words = file && !file->intact() ? damaged : error.what();  // a byte that was changed may mean anything
  }
  return out;
}

Verdict check(std::string_view certificate, const Reading& reading) {
  struct Bytes : std::streambuf {
    explicit Bytes(std::string_view all) {
      char* const first = const_cast<char*>(all.data());  // NOLINT: nobody writes to a buffer that is read
      setg(first, first, first + all.size());
    }
  } bytes(certificate);
  std::istream file(&bytes);
  return check(file, reading);
}

}  // namespace ninedof::checker
