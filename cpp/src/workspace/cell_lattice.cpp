#include "workspace/cell_lattice.hpp"

#include <algorithm>

#include "ninedof/parallel.hpp"

namespace ninedof {
namespace {

constexpr int bits = 21;
constexpr std::uint64_t mask = (std::uint64_t{1} << bits) - 1;

std::uint64_t mixed(std::uint64_t z) {
  z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9ULL;
  z = (z ^ (z >> 27)) * 0x94D049BB133111EBULL;
  return z ^ (z >> 31);
}

}  // namespace

std::size_t KeyTable::place(std::uint64_t key) const {
  std::size_t at = mixed(key) & (slots_.size() - 1);
  while (slots_[at].index != absent && slots_[at].key != key) at = (at + 1) & (slots_.size() - 1);
  return at;
}

void KeyTable::grow() {
  slots_.assign(2 * slots_.size(), {});
  for (std::uint32_t n = 0; n < keys_.size(); ++n) slots_[place(keys_[n])] = {keys_[n], n};
}

std::uint32_t KeyTable::add(std::uint64_t key) {
  std::size_t at = place(key);
  if (slots_[at].index == absent) {
    if (2 * keys_.size() >= slots_.size()) {
      grow();
      at = place(key);
    }
    slots_[at] = {key, static_cast<std::uint32_t>(keys_.size())};
    keys_.push_back(key);
  }
  return slots_[at].index;
}

std::uint32_t KeyTable::find(std::uint64_t key) const {
  return slots_[place(key)].index;
}

CellLattice::CellLattice(const Margins& margins, int resolution, int threads)
    : margins_(margins),
      low_(margins.chart().low()),
      step_((margins.chart().high() - margins.chart().low()) / (resolution * static_cast<double>(2 << deepest))),
      resolution_(resolution),
      threads_(threads) {}

Vec3 CellLattice::size(int level) const {
  return step_ * static_cast<double>(2 << (deepest - level));
}

Vec3 CellLattice::centre(const Cell& c) const {
  const Vec3 index(static_cast<double>(c.i), static_cast<double>(c.j), static_cast<double>(c.k));
  return low_ + (index + Vec3::Constant(0.5)).cwiseProduct(size(c.level));
}

Vec3 CellLattice::at(std::uint64_t key) const {
  const Vec3 index(static_cast<double>(key & mask), static_cast<double>((key >> bits) & mask),
                   static_cast<double>(key >> (2 * bits)));
  return low_ + index.cwiseProduct(step_);
}

std::vector<NinePoints> CellLattice::points_of(const std::vector<Cell>& cells) {
  std::vector<NinePoints> out(cells.size());
  for (std::size_t n = 0; n < cells.size(); ++n) {
    const Cell& c = cells[n];
    const int shift = deepest - c.level;  // half a cell is 2^shift steps
    const auto key = [&](std::uint64_t di, std::uint64_t dj, std::uint64_t dk) {
      const std::uint64_t i = (2 * std::uint64_t{c.i} + di) << shift, j = (2 * std::uint64_t{c.j} + dj) << shift,
                          k = (2 * std::uint64_t{c.k} + dk) << shift;
      return i | (j << bits) | (k << (2 * bits));
    };
    for (std::uint64_t corner = 0; corner < 8; ++corner)
      out[n][corner] = table_.add(key(2 * (corner & 1), corner & 2, (corner & 4) >> 1));
    out[n][8] = table_.add(key(1, 1, 1));
  }
  return out;
}

void CellLattice::evaluate(const WorkspaceControl& control, long expected, double volume) {
  const long first = evaluations(), count = static_cast<long>(table_.size()) - first;
  known_.resize(table_.size());
  // News between pieces of work, from this thread alone.
  const long piece = std::max<long>(margins_.block() * 64, 1);
  for (long done = 0; done < count; done += piece) {
    const long now = std::min(piece, count - done);
    parallel_for(now, margins_.block(), threads_, [&](long from, long to) {
      std::vector<Vec3> x;
      for (long n = from; n < to; ++n) x.push_back(point(static_cast<std::uint32_t>(first + done + n)));
      margins_.evaluate(x.data(), to - from, &known_[static_cast<std::size_t>(first + done + from)], control.stop);
    });
    if (control.progress) control.progress(first + done + now, std::max(expected, first + count), volume);
  }
}

}  // namespace ninedof
