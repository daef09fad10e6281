#pragma once
/// Branch and bound: boxes that are not decided are looked at in rounds, in parallel, and divided.
///
/// Which boxes a round has does not depend on the number of threads, and what was seen is merged in the order of the
/// round: nor does the result. A stop leaves boxes open, with which the search can go on.

#include <algorithm>
#include <cassert>
#include <iterator>
#include <limits>
#include <optional>
#include <vector>

#include "ninedof/math/control.hpp"
#include "ninedof/math/parallel.hpp"

namespace ninedof {

/// Open boxes, the last ones next.
template <class Box>
struct OpenStack : std::vector<Box> {
  void push(Box box) { this->push_back(std::move(box)); }
  void take(std::size_t most, std::vector<Box>& round) {
    const auto from = this->end() - static_cast<std::ptrdiff_t>(std::min(most, this->size()));
    std::ranges::move(from, this->end(), std::back_inserter(round));
    this->erase(from, this->end());
  }
};

/// Open boxes, the greatest by operator< next.
template <class Box>
struct OpenHeap : std::vector<Box> {
  const Box& top() const { return this->front(); }
  void push(Box box) {
    this->push_back(std::move(box));
    std::push_heap(this->begin(), this->end());
  }
  Box pop() {
    std::pop_heap(this->begin(), this->end());
    Box out = std::move(this->back());
    this->pop_back();
    return out;
  }
  void take(std::size_t most, std::vector<Box>& round) {
    while (round.size() < most && !this->empty()) round.push_back(pop());
  }
};

/// What a search does unless it says otherwise: one box after another, all of it in `merge`.
struct BoxSearch {
  struct Nothing {};
  template <class Box>
  std::optional<Nothing> look(const Box&, const std::stop_token&) const {
    return Nothing{};
  }
  std::size_t together() const { return 1; }
  void end_round() {}
  double value() const { return std::numeric_limits<double>::quiet_NaN(); }
  long looked = 0;  ///< boxes
};

/// Looks at the boxes of `search.open` until none is left, until there is enough, or until a stop. A search has
///   open              the boxes, as OpenStack and OpenHeap have them
///   enough()          whether no further round is needed; there are open boxes
///   together()        how many of them a round has at most, one at least
///   look(box, stop)   what is seen of a box, which it may narrow; nothing on a stop, and only then: it stays open.
///                     Looks of a round run side by side
///   merge(box, seen)  takes that in, counts it in `looked`, and opens parts of the box
///   end_round()       after the last merge of a round
///   looked, value()   of progress
/// A thread takes `block` boxes of a round at a time.
template <class Search>
void bound(Search& search, const Control& control, int threads = 1, long block = 1) {
  std::vector<typename decltype(search.open)::value_type> round;
  std::vector<decltype(search.look(round.front(), control.stop))> seen;
  const auto look = [&](long first, long last) {
    for (auto n = static_cast<std::size_t>(first); n < static_cast<std::size_t>(last); ++n)
      if (!control.stop.stop_requested()) seen[n] = search.look(round[n], control.stop);
  };
  while (!search.open.empty() && !control.stop.stop_requested() && !search.enough()) {
    round.clear();
    search.open.take(search.together(), round);
    assert(!round.empty());
    seen.clear();
    seen.resize(round.size());
    if (round.size() == 1) look(0, 1);
    else parallel_for(std::ssize(round), block, threads, look);
    for (std::size_t n = 0; n < round.size(); ++n) {
      if (seen[n]) search.merge(std::move(round[n]), *std::move(seen[n]));
      else search.open.push(std::move(round[n]));
    }
    search.end_round();
    if (control.progress) control.progress(search.looked, 0, search.value());
  }
}

}  // namespace ninedof
