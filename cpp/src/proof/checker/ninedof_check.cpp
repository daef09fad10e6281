/// ninedof_check CERTIFICATE: the function check as a program of its own. Declared in `ninedof/proof/checker.hpp`.
/// Exit status 0: a proof, 1: refused, 2: cannot be read, 3: not all is confirmed.

#include <cstdio>
#include <fstream>

#include "ninedof/proof/checker.hpp"

int main(int count, char** words) {
  if (count != 2) {
    std::fprintf(stderr, "usage: ninedof_check CERTIFICATE\n");
    return 2;
  }
  std::ifstream file(words[1], std::ios::binary);
  file.peek();
  if (!file) {
    std::fprintf(stderr, "ninedof_check: %s cannot be read\n", words[1]);
    return 2;
  }
  const ninedof::checker::Verdict found = ninedof::checker::check(file);
  for (const std::string& line : found.study) std::printf("%s\n", line.c_str());
  std::printf("%s: %s (%ld boxes, %ld cut further)\n",
              found.proved       ? "Proved"
              : found.incomplete ? "Incomplete"
                                 : "Refused",
              found.words.c_str(), found.leaves, found.recut);
  return found.proved ? 0 : found.incomplete ? 3 : 1;
}
