#include "workspace/cells/cell_lattice.hpp"

#include <algorithm>
#include <bit>

#include "math/splitmix.hpp"
#include "ninedof/math/parallel.hpp"

namespace ninedof {
namespace {

constexpr int key_bits = 21;
constexpr std::uint64_t mask = (std::uint64_t{1} << key_bits) - 1;

using Index3 = std::array<std::uint64_t, 3>;

Index3 indices(std::uint64_t key) {
  return {key & mask, (key >> key_bits) & mask, key >> (2 * key_bits)};
}

std::uint64_t key_of(const Index3& at) {
  return at[0] | (at[1] << key_bits) | (at[2] << (2 * key_bits));
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

CellLattice::CellLattice(const LimitsAtPoints& margins, int resolution, int threads)
    : margins_(margins),
      best_(margins),
      low_(margins.chart().low()),
      step_((margins.chart().high() - margins.chart().low()) / (resolution * static_cast<double>(2 << deepest))),
      resolution_(resolution),
      threads_(threads) {}

std::vector<Cell> CellLattice::roots() const {
  std::vector<Cell> out;
  const auto n = static_cast<std::uint32_t>(resolution_);
  for (std::uint32_t k = 0; k < n; ++k)
    for (std::uint32_t j = 0; j < n; ++j)
      for (std::uint32_t i = 0; i < n; ++i) out.push_back({i, j, k, 0});
  return out;
}

Vec3 CellLattice::centre(const Cell& c) const {
  const Vec3 index(static_cast<double>(c.i), static_cast<double>(c.j), static_cast<double>(c.k));
  return low_ + (index + Vec3::Constant(0.5)).cwiseProduct(size(c.level));
}

Vec3 CellLattice::at(std::uint64_t key) const {
  const auto [i, j, k] = indices(key);
  const Vec3 index(static_cast<double>(i), static_cast<double>(j), static_cast<double>(k));
  return low_ + index.cwiseProduct(step_);
}

std::vector<NinePoints> CellLattice::points_of(const std::vector<Cell>& cells, const std::stop_token& stop) {
  std::vector<NinePoints> out(cells.size());
  for (std::size_t n = 0; n < cells.size(); ++n) {
    if (n % 4096 == 0 && stop.stop_requested()) throw Stopped{};
    const Cell& c = cells[n];
    const int shift = deepest - c.level;  // half a cell is 2^shift steps
    const auto key = [&](std::uint64_t di, std::uint64_t dj, std::uint64_t dk) {
      return key_of({(2 * std::uint64_t{c.i} + di) << shift, (2 * std::uint64_t{c.j} + dj) << shift,
                     (2 * std::uint64_t{c.k} + dk) << shift});
    };
    for (std::uint64_t corner = 0; corner < 8; ++corner)
      out[n][corner] = table_.add(key(2 * (corner & 1), corner & 2, (corner & 4) >> 1));
    out[n][8] = table_.add(key(1, 1, 1));
  }
  return out;
}

void CellLattice::evaluate(const Control& control, long expected, double volume) {
  const long first = evaluations(), count = static_cast<long>(table_.size()) - first;
  if (best_.needed()) {
    best_.reserve(table_.size());
    if (first == 0) map_corners(control.stop);
  }
  // Progress is reported between pieces of work, by this thread alone.
  const long piece = std::max<long>(margins_.block() * 64, 1);
  for (long done = 0; done < count; done += piece) {
    const long now = std::min(piece, count - done);
    known_.grow(at_index(first + done + now));
    parallel_for(now, margins_.block(), threads_, [&](long from, long to) {
      const auto begin = at_index(first + done + from);
      std::vector<Vec3> x;
      for (long n = from; n < to; ++n) x.push_back(point(static_cast<std::uint32_t>(first + done + n)));
      const BestAt best = [&](long k, std::size_t r, const PlatformPose& pose) {
        const std::size_t n = begin + at_index(k);
        if (best_.mapped(n)) return best_.at(n, r, pose);
        const InternalPoint found =
            best_.between(around(table_.key(static_cast<std::uint32_t>(n))), x[at_index(k)], r, pose);
        best_.keep(n, r, found.s);
        return found;
      };
      std::vector<PointMargins> judged(x.size());
      margins_.evaluate(x.data(), to - from, judged.data(), control.stop, best);
      for (std::size_t n = 0; n < judged.size(); ++n) known_[begin + n] = judged[n];
    });
    evaluations_ = first + done + now;
    if (control.progress) control.progress(evaluations_, std::max(expected, first + count), volume);
  }
}

void CellLattice::map_corners(const std::stop_token& stop) {
  const auto count = static_cast<std::uint64_t>(resolution_) + 1;
  constexpr int shift = deepest + 1;
  std::vector<Vec3> x;
  std::vector<std::size_t> numbers;
  for (std::uint64_t k = 0; k < count; ++k)
    for (std::uint64_t j = 0; j < count; ++j)
      for (std::uint64_t i = 0; i < count; ++i) {
        const Anchor corner = anchor(key_of({i << shift, j << shift, k << shift}));
        x.push_back(corner.x);
        numbers.push_back(corner.number);
      }
  best_.map(x, {count, count, count}, numbers, threads_, stop);
}

Anchors CellLattice::around(std::uint64_t key) const {
  const Index3 at = indices(key);
  // Some index is an odd multiple of `half`, so that the point lies half way between known ones.
  const int twos = std::countr_zero(at[0] | at[1] | at[2]);
  const std::uint64_t half = std::uint64_t{1} << twos;
  Index3 a = at, b = at;
  bool centre = true;
  for (std::size_t n = 0; n < 3; ++n) {
    centre = centre && (at[n] & half) != 0;
    if ((at[n] & half) == 0) continue;
    a[n] -= half;
    b[n] += half;
  }
  // The centre of a divided cell's child: a corner of that cell has even multiples of 2 half, its centre odd ones.
  if (centre && twos < deepest)
    for (std::size_t n = 0; n < 3; ++n)
      if ((a[n] & (2 * half)) != 0) std::swap(a[n], b[n]);
  return {anchor(key_of(a)), anchor(key_of(b))};
}

Anchors CellLattice::around(const Cell& cell, const Vec3& x) const {
  constexpr std::uint64_t half = std::uint64_t{1} << deepest;
  const Vec3 middle = centre(cell);
  Index3 at{(2 * std::uint64_t{cell.i} + 1) * half, (2 * std::uint64_t{cell.j} + 1) * half,
            (2 * std::uint64_t{cell.k} + 1) * half};
  const Anchor inner = anchor(key_of(at));
  for (std::size_t n = 0; n < 3; ++n)
    at[n] = x[static_cast<Eigen::Index>(n)] < middle[static_cast<Eigen::Index>(n)] ? at[n] - half : at[n] + half;
  return {anchor(key_of(at)), inner};
}

std::vector<PointMargins> CellLattice::within(const std::vector<Cell>& cells, const std::vector<Vec3>& x,
                                              const std::stop_token& stop) {
  if (stop.stop_requested()) throw Stopped{};
  std::vector<PointMargins> out(x.size());
  parallel_for(static_cast<long>(x.size()), margins_.block(), threads_, [&](long from, long to) {
    const auto begin = at_index(from);
    margins_.evaluate(&x[begin], to - from, &out[begin], stop, [&](long k, std::size_t r, const PlatformPose& pose) {
      const std::size_t n = begin + at_index(k);
      return best_.between(around(cells[n], x[n]), x[n], r, pose);
    });
  });
  return out;
}

}  // namespace ninedof
