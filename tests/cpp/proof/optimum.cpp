/// optimum.hpp and checker.hpp: the paper's problem, threads, interruption, bad studies, damaged certificates.

#include "ninedof/proof/optimum.hpp"

#include <doctest/doctest.h>

#include "ninedof/math/error.hpp"
#include "ninedof/proof/checker.hpp"

using namespace ninedof;

namespace {

constexpr double best = 3.7626590785960471961;  // by a solution of the optimality conditions in 50 digits

Problem paper() {
  Problem p;
  p.variables = {{0.0, 60.0}, {0.0, 60.0}, {0.0, 60.0}, {0.0, 60.0}, {0.05, 80.0}, {0.05, 80.0}, {0.0, 0.0}};
  Limit ratio;
  ratio.name = "radius_ratio";
  ratio.high = 2.0;
  p.limits.push_back(ratio);
  return p;
}

OptimumProof prove(const Problem& study, double target, bool keep = false, int threads = 2) {
  OptimumSettings settings;
  settings.target = target;
  settings.keep_tree = keep;
  settings.threads = threads;
  return prove_optimum(study, settings);
}

const std::string first_lines = "ninedof certificate 1\nchecksum ";

std::string body_of_certificate(const std::string& file) {
  return file.substr(file.find('\n', first_lines.size()) + 1);
}

/// A file with a checksum that fits.
std::string with_checksum(const std::string& body) {
  std::uint32_t crc = 0xFFFFFFFFU;
  for (const char c : body) {
    crc ^= static_cast<unsigned char>(c);
    for (int k = 0; k < 8; ++k) crc = (crc >> 1U) ^ ((crc & 1U) != 0U ? 0xEDB88320U : 0U);
  }
  char text[16];
  std::snprintf(text, sizeof text, "%x", ~crc);
  return first_lines + text + "\n" + body;
}

/// The file with one line of its head replaced.
std::string changed(const std::string& file, const std::string& from, const std::string& to) {
  std::string body = body_of_certificate(file);
  const std::size_t at = body.find(from);
  REQUIRE(at != std::string::npos);
  return with_checksum(body.replace(at, from.size(), to));
}

/// Of another tree.
std::string with_tree(const std::string& file, const std::string& tree) {
  const std::string body = body_of_certificate(file);
  return with_checksum(body.substr(0, body.find("\ntree ")) + "\ntree " + std::to_string(tree.size()) + "\n" + tree);
}

}  // namespace

TEST_SUITE("optimum") {
  TEST_CASE("coarse: proved below the optimum, never above it, alike on one thread and two") {
    const OptimumProof one = prove(paper(), 0.9 * best, true, 1), two = prove(paper(), 0.9 * best, true, 2);
    CHECK(one.complete);
    CHECK(one.lower_bound == 0.9 * best);
    CHECK(one.certificate == two.certificate);
    CHECK(one.boxes == two.boxes);

    OptimumSettings above;
    above.target = 1.01 * best;
    above.box_limit = 100'000;
    const OptimumProof open = prove_optimum(paper(), above);
    CHECK_FALSE(open.complete);
    CHECK(open.lower_bound <= best);
    CHECK(open.open > 0);
    CHECK(open.certificate.empty());
  }

  TEST_CASE("under a limit of zp: proved to the optimum, not beyond it, and weights of limits are those of the study") {
    constexpr double best_low = 4.048039517543512;  // found by many starts
    Problem low = paper();
    low.variables[4].high = 2.5;
    const OptimumProof found = prove(low, best_low * (1.0 - 1e-8), true);
    CHECK(found.complete);
    CHECK(found.boxes < 300'000);
    const checker::Verdict good = checker::check(found.certificate);
    CHECK_MESSAGE(good.proved, good.words);
    CHECK_FALSE(checker::check(changed(found.certificate, " 0x1.4p+1\n", " 0x1.41p+1\n")).proved);

    OptimumSettings above;
    above.target = best_low * (1.0 + 1e-6);
    above.box_limit = 400'000;
    CHECK_FALSE(prove_optimum(low, above).complete);

    const std::string zeros(8, '\0'), one("\0\0\x80\x3f", 4), less("\0\0\x80\xbf", 4), nothing("\0\0\xc0\x7f", 4);
    for (const auto& [limits, words] : {std::pair<std::string, std::string>{'\x80' + one, "does not exist"},
                                        {'\x01' + one, "that the study does not have"},
                                        {'\x04' + less, "that the study does not have"},
                                        {'\x08' + nothing, "is not finite"},
                                        {'\x08' + one, "is not proved"}}) {
      const checker::Verdict bad = checker::check(with_tree(found.certificate, '\x13' + zeros + limits));
      INFO(words);
      CHECK_FALSE(bad.proved);
      CHECK(bad.words.find(words) != std::string::npos);
    }
  }

  TEST_CASE("a stop leaves what is proved so far") {
    std::stop_source source;
    OptimumSettings settings;
    settings.target = 0.999 * best;
    const OptimumProof found =
        prove_optimum(paper(), settings, {source.get_token(), [&](long boxes, long, double bound) {
                                            CHECK(bound <= best);
                                            if (boxes > 20'000) source.request_stop();
                                          }});
    CHECK_FALSE(found.complete);
    CHECK(found.boxes < 40'000);
    CHECK(found.lower_bound > 1.0);
    CHECK(found.lower_bound < best);
  }

  TEST_CASE("limits that the theory does not reach are left out and named; studies are refused") {
    Problem study = paper();
    Limit clearance;
    clearance.name = "leg_clearance";
    clearance.low = 0.1;
    study.limits.push_back(clearance);
    const OptimumProof found = prove(study, 1.5);
    REQUIRE(found.left_out.size() == 1);
    CHECK(found.left_out[0] == "leg_clearance");

    Problem general = paper();
    general.family = "general";
    CHECK_THROWS_AS(prove(general, 2.0), InvalidArgument);
    Problem flat = paper();
    flat.variables[4].low = 0.0;
    CHECK(prove(flat, 1.5).complete);
    flat.characteristic_length = {StudyLength::Choice::kind, 1.0, LengthKind::mean_leg, {}};
    CHECK_THROWS_WITH_AS(prove(flat, 2.0),
                         "zp: got [0, 80], expected a positive lower bound for a proof, or a number as the "
                         "characteristic length",
                         InvalidArgument);
    Problem posed = paper();
    posed.objective.poses.push_back({});
    CHECK_THROWS_AS(prove(posed, 2.0), InvalidArgument);
    CHECK_THROWS_AS(prove(paper(), 1.0), InvalidArgument);
    CHECK_THROWS_AS(prove(paper(), std::nan("")), InvalidArgument);
  }

  TEST_CASE("a certificate is checked, and refused once it states more than was proved") {
    const std::string file = prove(paper(), 0.8 * best, true).certificate;
    const checker::Verdict good = checker::check(file);
    CHECK_MESSAGE(good.proved, good.words);
    CHECK(good.leaves > 1000);

    // Damage anywhere is noticed.
    for (const std::size_t at : {std::size_t{3}, std::size_t{30}, std::size_t{80}, file.size() / 2, file.size() - 1}) {
      std::string damaged = file;
      damaged[at] = static_cast<char>(damaged[at] ^ 1);
      CHECK_FALSE(checker::check(damaged).proved);
    }
    CHECK_FALSE(checker::check("").proved);
    CHECK_FALSE(checker::check(file.substr(0, file.size() / 2)).proved);

    // Stronger statements over the same tree, with a checksum that fits.
    const std::string target = file.substr(file.find("target "), file.find("\ncharacteristic") - file.find("target "));
    for (const auto& [from, to] : {std::pair<std::string, std::string>{target, "target 0x1.e4p+1"},
                                   {"limit radius_ratio 0x0p+0 0x1p+1", "limit radius_ratio 0x0p+0 0x1p+3"},
                                   {"limit radius_ratio 0x0p+0 0x1p+1\n", ""},
                                   {"variable theta_z 0x0p+0 0x0p+0", "variable theta_z -0x1p+2 0x1p+2"},
                                   {"variable zp", "variable zq"},
                                   {"variable zp 0x1.999999999999ap-5", "variable zp 0x0p+0"},
                                   {"family hexagonal", "family general"},
                                   {"family hexagonal", "family symmetric"},
                                   {"variable a1 0x0p+0", "variable a1 nan"},
                                   {"variable a1 0x0p+0 0x1.ep+5", "variable a1 0x1.ep+5 0x0p+0"},
                                   {"characteristic_length 0x1p+0", "characteristic_length 0x0p+0"},
                                   {"limit radius_ratio", "limit leg_clearance"}}) {
      const checker::Verdict bad = checker::check(changed(file, from, to));
      INFO(from << " -> " << to);
      CHECK_FALSE(bad.proved);
      CHECK_FALSE(bad.words.empty());
    }
  }
}
