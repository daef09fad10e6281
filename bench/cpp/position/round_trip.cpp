/// Round trip of direct position analysis: random poses in any orientation, their nine lengths, and all assembly modes.
///
///     ninedof_round_trip [cases of each kind] [seed]
///
/// Counts poses that were not found again, modes that miss a length by more than 1e-11 of the largest, and cases where
/// elimination and the null-space method are both certain and find different numbers. Exit status 1 if there is any.

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <mutex>

#include "ninedof/math/parallel.hpp"
#include "ninedof/position/forward_position.hpp"
#include "ninedof/robot/legs.hpp"
#include "support/data.hpp"

namespace {

using ninedof::AssemblyModes;
using ninedof::Configuration;
using ninedof::Geometry;
using ninedof::RotationMethod;
using ninedof::Vec9;

struct Tally {
  long missed = 0, inexact = 0, differ = 0, uncertain = 0, handed_over = 0;
  double worst_length = 0.0, worst_error = 0.0;

  void add(const Tally& t) {
    missed += t.missed;
    inexact += t.inexact;
    differ += t.differ;
    uncertain += t.uncertain;
    handed_over += t.handed_over;
    worst_length = std::max(worst_length, t.worst_length);
    worst_error = std::max(worst_error, t.worst_error);
  }
};

double distance(const Configuration& a, const Configuration& b) {
  return std::max({(a.position - b.position).norm(), (a.internal_point - b.internal_point).norm(),
                   (a.rotation - b.rotation).norm()});
}

Tally one(bool hexagonal, unsigned seed) {
  bench::Random random(seed);
  const Geometry g = bench::random_geometry(random, hexagonal);
  const Configuration c = bench::any_configuration(random);
  const Vec9 lengths = ninedof::leg_lengths(g, c);
  const AssemblyModes modes = ninedof::forward_position(g, lengths);
  const AssemblyModes fast = ninedof::forward_position(g, lengths, RotationMethod::elimination);
  const AssemblyModes slow = ninedof::forward_position(g, lengths, RotationMethod::null_space);
  Tally t;
  double nearest = 1.0;
  for (const ninedof::AssemblyMode& m : modes) {
    const double error =
        (ninedof::leg_lengths(g, m.configuration) - lengths).cwiseAbs().maxCoeff() / lengths.maxCoeff();
    t.worst_length = std::max(t.worst_length, error);
    nearest = std::min(nearest, distance(m.configuration, c));
  }
  t.inexact = t.worst_length > 1e-11 ? 1 : 0;
  t.worst_error = nearest;
  t.missed = nearest > 1e-6 ? 1 : 0;  // half the digits, where two modes nearly meet
  t.differ = fast.certain && slow.certain && fast.count != slow.count ? 1 : 0;
  t.uncertain = modes.certain ? 0 : 1;
  t.handed_over = modes.null_space_branches;
  return t;
}

}  // namespace

int main(int argc, char** argv) {
  const long cases = argc > 1 ? std::atol(argv[1]) : 1'000'000;
  const auto seed = static_cast<unsigned>(argc > 2 ? std::atol(argv[2]) : 1);
  long bad = 0;
  for (const bool hexagonal : {true, false}) {
    Tally all;
    std::mutex guard;
    ninedof::parallel_for(cases, 1000, 0, [&](long first, long last) {
      Tally block;
      for (long k = first; k < last; ++k)
        block.add(one(hexagonal, seed + 2U * static_cast<unsigned>(k) + (hexagonal ? 1U : 0U)));
      const std::lock_guard lock(guard);
      all.add(block);
    });
    std::printf(
        "%s, %ld cases: %ld generating poses missed, %ld cases with a length off by 1e-11, %ld counted differently by "
        "two certain\n"
        "  methods; %ld uncertain counts, %ld branches handed to the null-space method, worst length error %.1e of the "
        "largest,\n"
        "  worst error of a generating pose %.1e\n",
        hexagonal ? "hexagonal" : "non-planar", cases, all.missed, all.inexact, all.differ, all.uncertain,
        all.handed_over, all.worst_length, all.worst_error);
    std::fflush(stdout);
    bad += all.missed + all.inexact + all.differ;
  }
  return bad == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
