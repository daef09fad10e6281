/// Plain Eigen over the poses of a file, one core: assemble, invert, JacobiSVD.
///
///     ninedof_plain_eigen_LEVEL FILE COUNT [OUT]
///
/// Writes the condition numbers to OUT and prints the seconds they took.

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <exception>

#include "batch/floor/file.hpp"
#include "support/baseline.hpp"

int main(int argc, char** argv) try {
  if (argc < 3) throw std::runtime_error("usage: FILE COUNT [OUT]");
  const bench::File file(argv[1], std::strtoul(argv[2], nullptr, 10));
  const ninedof::Geometry g = file.geometry();
  std::vector<ninedof::Configuration> poses;
  for (std::size_t k = 0; k < file.count(); ++k) poses.push_back(file.configuration(k));
  std::vector<double> kappa(poses.size());

  const auto begin = std::chrono::steady_clock::now();
  for (std::size_t k = 0; k < poses.size(); ++k)
    kappa[k] = bench::plain::condition_number(g, poses[k], file.characteristic_length());
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begin;

  if (argc > 3)
    std::ofstream(argv[3], std::ios::binary)
        .write(reinterpret_cast<const char*>(kappa.data()),
               static_cast<std::streamsize>(kappa.size() * sizeof(double)));
  std::printf("%.9g\n", seconds.count());
  return 0;
} catch (const std::exception& e) {
  std::fprintf(stderr, "%s\n", e.what());
  return 1;
}
