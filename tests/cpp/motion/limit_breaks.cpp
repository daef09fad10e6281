/// limit_breaks.hpp against margins and determinants with known zeros.

#include "ninedof/motion/limit_breaks.hpp"

#include <doctest/doctest.h>

#include "support/support.hpp"

using namespace ninedof;
using namespace support;

namespace {

std::vector<double> times(int n, double end) {
  std::vector<double> out;
  for (int k = 0; k < n; ++k) out.push_back(end * k / (n - 1));
  return out;
}

template <class F>
std::vector<double> values(const std::vector<double>& time, const F& f) {
  std::vector<double> out;
  for (const double t : time) out.push_back(f(t));
  return out;
}

}  // namespace

TEST_SUITE("limit_breaks") {
  TEST_CASE("stretches begin and end at the zeros of the margin") {
    const std::vector<double> time = times(4001, 4.0 * pi);
    const std::vector<double> sine = values(time, [](double t) { return std::sin(t); });
    const std::vector<double> limited = values(sine, [](double m) { return 5.0 - m; });
    const auto found = stretches("l1 low", time, limited, sine);
    REQUIRE(found.size() == 2);
    for (int k = 0; k < 2; ++k) {
      const LimitBreak& b = found[static_cast<std::size_t>(k)];
      CHECK(b.limit == "l1 low");
      CHECK(std::abs(b.begin - (2 * k + 1) * pi) < 1e-6);
      CHECK(std::abs(b.end - (2 * k + 2) * pi) < 1e-6);
      CHECK(std::abs(b.at - (2 * k + 1.5) * pi) < 4e-3);
      CHECK(std::abs(b.worst - 6.0) < 1e-5);
    }
  }

  TEST_CASE("a stretch at an end of the motion begins or ends there, and the tolerance decides what is one") {
    const std::vector<double> time{0.0, 1.0, 3.0, 4.0};
    const std::vector<double> margin{-1.0, 1.0, 1.0, -3.0}, limited{7.0, 6.0, 6.0, 9.0};
    const auto found = stretches("q2 high", time, limited, margin);
    REQUIRE(found.size() == 2);
    CHECK((found[0].begin == 0.0 && found[0].end == 0.5 && found[0].worst == 7.0 && found[0].at == 0.0));
    CHECK((found[1].begin == 3.25 && found[1].end == 4.0 && found[1].worst == 9.0 && found[1].at == 4.0));
    CHECK(stretches("q2 high", time, limited, margin, 1.0).size() == 1);
    CHECK(stretches("q2 high", time, limited, margin, 3.0).empty());
    CHECK(stretches("q2 high", time, limited, std::vector{0.0, -0.9e-6, not_a_number, infinity}).empty());
    CHECK(stretches("q2 high", time, limited, std::vector{-1.0, -1.0, -2.0, -1.0}).size() == 1);
    CHECK(refuses("values, margin", [&] { stretches("q2 high", time, limited, std::vector{1.0}); }));
  }

  TEST_CASE("determinants cross zero where the line between two samples does, or at a sample") {
    const std::vector<double> time{0.0, 1.0, 2.0, 4.0};
    const auto between = crossings("det B", time, std::vector{0.1, 0.3, -0.1, -0.2});
    REQUIRE(between.size() == 1);
    CHECK((between[0].begin == doctest::Approx(1.75) && between[0].end == between[0].begin));
    CHECK((between[0].worst == 0.0 && between[0].at == between[0].begin && between[0].limit == "det B"));
    const auto at_sample = crossings("det C", time, std::vector{0.1, 0.0, -0.1, 0.3});
    REQUIRE(at_sample.size() == 2);
    CHECK(at_sample[0].at == 1.0);
    CHECK(at_sample[1].at == doctest::Approx(2.5));
    CHECK(crossings("det N", time, std::vector{0.1, 0.2, 0.1, 1e-300}).empty());
  }

  TEST_CASE("margins are parts of the limit, and a limit of zero or infinity is none") {
    LegLimits limits;
    limits.low[0] = 2.0;
    limits.high[1] = 4.0;
    const LegMargins margins = leg_margins(Vec9::Constant(5.0), limits);
    CHECK(margins.low[0] == 1.5);
    CHECK(margins.high[1] == -0.25);
    CHECK((margins.low.tail<8>().array() == infinity).all());
    CHECK((margins.high[0] == infinity && (margins.high.tail<7>().array() == infinity).all()));
  }

  TEST_CASE("legs and determinants are named, the earliest first") {
    const std::vector<double> time{0.0, 1.0, 2.0};
    std::vector<Vec9> lengths(3, Vec9::Constant(3.0));
    lengths[2][0] = 1.0;  // l1 passes 2 at t = 1.5
    lengths[1][4] = 5.0;  // q2 passes 4 from t = 0.5 to 1.5
    lengths[0][8] = 1.0;  // r3 is too short at first
    LegLimits limits{Vec9::Constant(2.0), Vec9::Constant(4.0)};
    const std::vector<PerMechanism> determinants{{1.0, 1.0, -1.0}, {-3.0, 1.0, -1.0}, {-1.0, 1.0, -1.0}};
    std::string words;
    for (const LimitBreak& b : limit_breaks(time, lengths, limits, determinants))
      words += b.limit + " " + std::to_string(b.begin).substr(0, 4) + " " + std::to_string(b.end).substr(0, 4) + ", ";
    CHECK(words == "r3 low 0.00 0.50, det N 0.25 0.25, q2 high 0.50 1.50, l1 low 1.50 2.00, ");
    CHECK(refuses("lengths, determinants", [&] { limit_breaks(time, {}, limits, determinants); }));
  }
}
