/// The box of designs, the largest undecided part next. Declared in ninedof/proof/admissible.hpp.

#include <algorithm>
#include <cmath>

#include "domains/bound.hpp"
#include "math/time_limit.hpp"
#include "proof/admissible/examine.hpp"

namespace ninedof {
namespace admissible {
namespace {

constexpr std::size_t boxes_at_once = 64;  // of a round: the result does not depend on the number of threads

/// A box that is to be looked at, the largest next.
struct Waiting {
  ToExamine asked;
  double undecided;                 ///< volume
  std::vector<DesignPiece> pieces;  ///< what is known of it
  bool operator<(const Waiting& other) const { return undecided < other.undecided; }
};

/// What one look gives.
struct LookedAt {
  std::vector<DesignPiece> decided;
  std::vector<Waiting> rests;
  long boxes;
};

class Search : public BoxSearch {
 public:
  Search(const DesignQuestion& question, const DesignSettings& settings, const std::vector<DesignPiece>& from)
      : examiner_(question),
        dimensions_(question.varied.size()),
        range_(range_of(question)),
        whole_(volume_of(range_, dimensions_)),
        settings_(settings) {
    if (from.empty()) open.push_back(whole_of({range_.low, range_.high, Membership::undecided, -1, {}, {}}));
    for (const DesignPiece& piece : from) {
      if (piece.state != Membership::undecided) out_.pieces.push_back(piece);
      else if (Waiting one = whole_of(piece); divisible(one)) open.push_back(std::move(one));
      else small_.push_back(std::move(one));
    }
    std::make_heap(open.begin(), open.end());
    for (const Waiting& one : open) undecided_ += one.undecided;
  }

  DesignSet found() {
    out_.demands = examiner_.names();
    out_.looked_at = looked;
    for (const std::vector<Waiting>* all : {static_cast<std::vector<Waiting>*>(&open), &small_})
      for (const Waiting& one : *all) out_.pieces.insert(out_.pieces.end(), one.pieces.begin(), one.pieces.end());
    out_.inside = out_.outside = out_.undecided = 0.0;
    for (const DesignPiece& piece : out_.pieces) {
      const double share = volume_of({piece.low, piece.high}, dimensions_) / whole_;
      (piece.state == Membership::inside    ? out_.inside
       : piece.state == Membership::outside ? out_.outside
                                            : out_.undecided) += share;
    }
    return std::move(out_);
  }

  OpenHeap<Waiting> open;
  std::size_t together() const { return boxes_at_once; }
  bool enough() const { return !(undecided_ > settings_.undecided * whole_); }
  std::optional<LookedAt> look(const Waiting& one, const std::stop_token& stop) const {
    const Examined found = examiner_.examine(one.asked, stop);
    if (!found.finished) return {};  // what was known stays
    const Divided parts = divided(one.asked.box, dimensions_, range_, found.known);
    LookedAt out{examiner_.pieces_of(parts.decided), {}, found.boxes};
    for (const Rest& rest : parts.rests) {
      ToExamine next = found.inherited;
      next.box = rest.box;
      out.rests.push_back({std::move(next), rest.undecided, examiner_.pieces_of(rest.pieces)});
    }
    return out;
  }
  void merge(const Waiting& one, LookedAt seen) {
    ++looked;
    out_.boxes += seen.boxes;
    undecided_ -= one.undecided;
    out_.pieces.insert(out_.pieces.end(), seen.decided.begin(), seen.decided.end());
    for (Waiting& rest : seen.rests) {
      undecided_ += rest.undecided;
      if (divisible(rest)) open.push(std::move(rest));
      else small_.push_back(std::move(rest));
    }
  }
  double value() const { return undecided_ / whole_; }

 private:
  bool divisible(const Waiting& one) const {
    return is_divisible(one.asked.box, dimensions_, range_, settings_.resolution);
  }
  Waiting whole_of(const DesignPiece& piece) const {
    const DesignBox box{piece.low, piece.high};
    return {{box, {}, {}, {}}, volume_of(box, dimensions_), {piece}};
  }

  Examiner examiner_;
  std::size_t dimensions_;
  DesignBox range_;
  double whole_;
  const DesignSettings& settings_;
  std::vector<Waiting> small_;
  double undecided_ = 0.0;
  DesignSet out_;
};

}  // namespace
}  // namespace admissible

DesignSet admissible_designs(const DesignQuestion& question, const DesignSettings& settings,
                             const std::vector<DesignPiece>& from, const Control& control) {
  using namespace admissible;
  question.validate();
  const TimeLimit limit(settings.seconds, control.stop);
  Search search(question, settings, from);
  bound(search, {limit.stop(), control.progress}, settings.threads);
  DesignSet out = search.found();
  out.interrupted = control.stop.stop_requested();
  return out;
}

}  // namespace ninedof
