/// Runs a fuzz target without libFuzzer, with any compiler. replay_NAME CORPUS INPUTS feeds it every file of a folder,
/// and then so many inputs made from them, the same in every run. What it is fed stands in the file replay_NAME.input
/// until the next: after a failure, what failed. replay_NAME FILE feeds it that.

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <string>
#include <vector>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace {

using Input = std::vector<std::uint8_t>;

Input read(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// Changes an input in a few places, as libFuzzer does: bits, bytes, what is left out or comes in, parts of another.
class Mutator {
 public:
  explicit Mutator(std::vector<Input> corpus) : corpus_(std::move(corpus)) {}

  Input next() {
    Input out = any();
    for (std::size_t changes = 1 + below(6); changes > 0; --changes) change(out);
    return out;
  }

 private:
  /// The modulus favours small numbers by nothing that matters here, and is the same in every library.
  std::size_t below(std::size_t n) { return random_() % n; }
  const Input& any() { return corpus_[below(corpus_.size())]; }
  static Input::iterator at(Input& in, std::size_t place) { return in.begin() + static_cast<std::ptrdiff_t>(place); }

  void change(Input& in) {
    if (in.empty()) in.push_back(0);
    const std::size_t place = below(in.size()), length = std::min(1 + below(8), in.size() - place);
    switch (below(5)) {
      case 0: in[place] ^= static_cast<std::uint8_t>(1U << below(8)); break;
      case 1: in[place] = static_cast<std::uint8_t>(below(256)); break;
      case 2: in.erase(at(in, place), at(in, place + length)); break;
      case 3: {
        const Input copy(at(in, place), at(in, place + length));
        in.insert(at(in, below(in.size())), copy.begin(), copy.end());
        break;
      }
      default: {
        const Input& other = any();
        const std::size_t both = std::min(in.size(), other.size());
        if (both > place)
          std::copy(other.begin() + static_cast<std::ptrdiff_t>(place),
                    other.begin() + static_cast<std::ptrdiff_t>(std::min(place + 4 * length, both)), at(in, place));
      }
    }
  }

  std::vector<Input> corpus_;
  std::mt19937_64 random_{1};
};

}  // namespace

int main(int count, char** arguments) {
  namespace fs = std::filesystem;
  const bool one = count == 2 && fs::is_regular_file(arguments[1]);
  const long inputs = count == 3 ? std::strtol(arguments[2], nullptr, 10) : 0;
  if (!one && !(count == 3 && fs::is_directory(arguments[1]) && inputs > 0)) {
    std::fprintf(stderr, "usage: %s CORPUS INPUTS, or %s FILE\n", arguments[0], arguments[0]);
    return 2;
  }
  if (one) {
    const Input in = read(arguments[1]);
    return LLVMFuzzerTestOneInput(in.data(), in.size());
  }
  std::vector<fs::path> files;
  for (const fs::directory_entry& entry : fs::directory_iterator(arguments[1])) files.push_back(entry.path());
  std::ranges::sort(files);
  std::vector<Input> corpus;
  for (const fs::path& file : files) corpus.push_back(read(file));
  if (corpus.empty()) {
    std::fprintf(stderr, "%s: no file in it\n", arguments[1]);
    return 2;
  }
  const fs::path kept = fs::absolute(fs::path(arguments[0]).filename().string() + ".input");
  std::fprintf(stderr, "what fails is kept in %s\n", kept.c_str());
  const auto feed = [&](const Input& in) {
    std::ofstream(kept, std::ios::binary)
        .write(reinterpret_cast<const char*>(in.data()), static_cast<std::streamsize>(in.size()));
    LLVMFuzzerTestOneInput(in.data(), in.size());
  };
  for (const Input& in : corpus) feed(in);
  Mutator mutator(corpus);
  for (long k = 0; k < inputs; ++k) feed(mutator.next());
  fs::remove(kept);
  std::printf("%zu files and %ld inputs made from them, nothing found\n", corpus.size(), inputs);
  return 0;
}
