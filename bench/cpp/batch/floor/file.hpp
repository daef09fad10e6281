#pragma once
/// The poses of the comparison, as bench/python/compare/data.py writes them: doubles, first the robot (four joint
/// triples), the characteristic length, then 15 numbers per pose: position, rotation (row-major), internal point.

#include <algorithm>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "ninedof/robot/configuration.hpp"
#include "ninedof/robot/geometry.hpp"

namespace bench {

struct File {
  std::vector<double> numbers;

  static constexpr std::size_t head = 37, width = 15;

  /// At most `most` of the poses.
  explicit File(const std::string& path, std::size_t most = ~std::size_t{0} / 1024) {
    std::ifstream in(path, std::ios::binary | std::ios::ate);
    if (!in) throw std::runtime_error("cannot read " + path);
    const std::size_t all = static_cast<std::size_t>(in.tellg()) / sizeof(double);
    if (all < head) throw std::runtime_error(path + ": no robot in it");
    numbers.resize(std::min(all, head + width * most));
    in.seekg(0);
    in.read(reinterpret_cast<char*>(numbers.data()), static_cast<std::streamsize>(numbers.size() * sizeof(double)));
  }

  std::size_t count() const { return (numbers.size() - head) / width; }
  double characteristic_length() const { return numbers[36]; }
  const double* pose(std::size_t k) const { return numbers.data() + head + width * k; }
  double* pose(std::size_t k) { return numbers.data() + head + width * k; }

  ninedof::Geometry geometry() const {
    ninedof::Triple t[4];
    for (std::size_t j = 0; j < 12; ++j) t[j / 3][j % 3] = Eigen::Map<const ninedof::Vec3>(numbers.data() + 3 * j);
    return {t[0], t[1], t[2], t[3]};
  }
  ninedof::Configuration configuration(std::size_t k) const {
    using RowMajor3 = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;
    const double* x = pose(k);
    return {Eigen::Map<const ninedof::Vec3>(x), Eigen::Map<const RowMajor3>(x + 3),
            Eigen::Map<const ninedof::Vec3>(x + 12)};
  }
};

}  // namespace bench
