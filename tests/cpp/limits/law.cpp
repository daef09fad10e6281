/// The rows of poses under one law: slopes are difference quotients, forms over boxes of poses, and of designs as well,
/// hold a thousand of them, bounds hold what they bound, stacks are their poses one by one, and kernels agree with
/// rows. A planted error in any function of a row breaks it. design_row.cpp and spread_row.cpp have that of the others.

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "batch/spectrum_stack.hpp"
#include "limits/law_boxes.hpp"
#include "limits/leg_clearance.hpp"
#include "limits/rows.hpp"
#include "ninedof/batch/batch.hpp"
#include "ninedof/limits/numbers.hpp"
#include "ninedof/math/error.hpp"
#include "ninedof/math/rotation.hpp"
#include "ninedof/singularity/singularity.hpp"
#include "support/support.hpp"

using namespace ninedof;
using namespace support;
using namespace law;

namespace {

/// Another pose of the same robot with its points moved: not what a joint can do, but what slopes are about.
PosedPoints moved(PosedPoints at, int point, const Vec3& by) {
  at.at[at_index(point)] += by;
  at.legs = nine_legs(at.at);
  return at;
}
PosedPoints turned_alone(PosedPoints at, const Vec3& w) {
  at.rotation = exp_rotation(w) * at.rotation;
  return at;
}

/// A fourth-order quotient of the number as something moves by h along each axis.
template <class Moved>
Vec3 quotient(const Moved& number) {
  constexpr double h = 1e-4;
  Vec3 out;
  for (int k = 0; k < 3; ++k) {
    const Vec3 e = h * Vec3::Unit(k);
    out[k] = (8.0 * (number(e) - number(-e)) - (number(2.0 * e) - number(-2.0 * e))) / (12.0 * h);
  }
  return out;
}

int wrong_slopes(const PoseRow& row, const Case& one) {
  const PosedPoints here = posed_points(one.g, one.here), home = posed_points(one.g, one.home);
  const auto number = [&](const PosedPoints& at, const PosedPoints& at_home, int item) {
    return row.number(PointLook(at, at_home, one.options), item);
  };
  int out = 0;
  for (int item = 0; item < row.items; ++item) {
    PointSlopes slopes;
    const double value = row.slopes(PointLook(here, home, one.options), item, slopes);
    out += !(std::abs(value - number(here, home, item)) <= 1e-14 * (1.0 + std::abs(value)));
    const auto differ = [&](const Vec3& a, const Vec3& b) { return !((a - b).norm() <= 1e-7 * (1.0 + a.norm())); };
    for (int point = 0; point < point_count; ++point) {
      Vec3 at = Vec3::Zero(), at_home = Vec3::Zero();
      for (int n = 0; n < slopes.points; ++n)
        if (slopes.at[at_index(n)].point == point) at += slopes.at[at_index(n)].slope;
      for (int n = 0; n < slopes.home_points; ++n)
        if (slopes.home[at_index(n)].point == point) at_home += slopes.home[at_index(n)].slope;
      out += differ(at, quotient([&](const Vec3& by) { return number(moved(here, point, by), home, item); }));
      out += differ(at_home, quotient([&](const Vec3& by) { return number(here, moved(home, point, by), item); }));
    }
    const Vec3 turn = slopes.turns ? slopes.turn : Vec3::Zero(), back = slopes.turns ? slopes.home_turn : Vec3::Zero();
    const auto by_length = [&](const Vec3& by) {  // the same along every axis
      return row.number(PointLook(here, home, one.options, 1.0 + by.sum()), item);
    };
    out += differ(Vec3::Constant(slopes.length), quotient(by_length));
    out += differ(turn, quotient([&](const Vec3& w) { return number(turned_alone(here, w), home, item); }));
    out += differ(back, quotient([&](const Vec3& w) { return number(here, turned_alone(home, w), item); }));
  }
  return out;
}

/// All numbers at once are those of each item.
int wrong_numbers(const PoseRow& row, const Case& one) {
  const PosedPoints here = posed_points(one.g, one.here), home = posed_points(one.g, one.home);
  const PointLook look(here, home, one.options);
  std::array<double, leg_pairs> all;
  row.numbers(look, all.data());
  int out = 0;
  for (int item = 0; item < row.items; ++item) out += all[at_index(item)] != row.number(look, item);
  return out;
}

/// The forms of a row at places of a box, and the numbers there.
template <class T>
int wrong_forms(const PoseRow& row, const Case& one, double half, Random& random) {
  const Box<T> box{one, half};
  const Seen<T> seen(box);
  int out = 0;
  for (int item = 0; item < row.items; ++item) {
    const T u = Seen<T>::form(row)(seen.look, item);
    const auto numerator = Seen<T>::numerator(row);
    const T part = numerator == nullptr ? T{} : numerator(seen.look, item);
    out += half < 1e-3 && !is_known(u);
    for (int n = 0; n < 1000 / row.items; ++n) {
      const auto t = Box<T>::random_place(random);
      const Case there = box.at(t);
      const PosedPoints here = posed_points(there.g, there.here), home = posed_points(there.g, there.home);
      const PointLook look(here, home, there.options);
      if (row.on_the_way && look.side(item) != seen.home.side[at_index(item)]) continue;  // another design's side
      const double number = row.number(look, item);
      out += !holds(row.read(at(u, t)), number) || !holds(row.read({lower(u), upper(u)}), number);
      if (numerator == nullptr) continue;
      const Seen<PoseForm> point(Box<PoseForm>{there, 0.0});
      const PoseForm exact = row.numerator(point.look, item);
      out += !holds(at(part, t), exact.c) || (std::abs(number) > 1e-10 && !(exact.c * number > 0.0));
    }
  }
  return out;
}

/// Vectors move along every coordinate that the number depends on, in proportion to the box.
template <class T>
int wrong_moves(const PoseRow& row, const Case& one) {
  const Box<T> box{one, 0.02}, small{one, 0.01};
  const Seen<T> seen(box), seen_small(small);
  int out = 0;
  for (int item = 0; item < row.items; ++item) {
    Moves moves, fewer;
    Seen<T>::moves(row)(seen.look, item, moves);
    Seen<T>::moves(row)(seen_small.look, item, fewer);
    for (std::size_t k = 0; k < moves.along.size(); ++k) {
      const typename Box<T>::Place e = Box<T>::Place::Unit(static_cast<Eigen::Index>(k));
      const double change = number_of(row, box.at(e), item) - number_of(row, box.at(-e), item);
      out += std::abs(change) > 1e-9 && !(moves.along[k] > 0.0);
      out += !(std::abs(moves.along[k] - 2.0 * fewer.along[k]) <= 0.02 * moves.along[k]);
    }
  }
  return out;
}

template <class T>
int wrong_distances(const Case& one, double half, Random& random) {
  const Box<T> box{one, half};
  const Seen<T> seen(box);
  int out = 0;
  for (int pair = 0; pair < leg_pairs; ++pair) {
    const auto legs = leg_pair_forms(seen.look, pair);
    const T above = squared_distance_above(legs);
    for (const Xyz<T>& direction : {fixed_direction(legs), turning_direction(legs)}) {
      out += half < 1e-3 && !is_known(direction.x);
      const auto ends = end_distances(legs, direction);
      for (int n = 0; n < 20; ++n) {
        const auto t = Box<T>::random_place(random);
        const double distance = number_of(leg_clearance_row, box.at(t), pair);
        double least = std::numeric_limits<double>::infinity();
        for (const T& end : ends.along) least = std::min(least, at(end, t).lo);
        out += !(distance * distance <= at(above, t).hi + 1e-13) || least > distance + 1e-13;
      }
    }
  }
  return out;
}

/// u of a number is what the number is read from.
int wrong_maps(const PoseRow& row) {
  int out = (row.smooth(0.5).hi < row.smooth(0.4).lo) != row.falls;
  for (const double number : {0.05, 0.3, 0.9}) {
    const Interval read = row.read(row.smooth(number));
    out += !contains(read, number) || !(width(read) < 1e-13);
  }
  return out;
}

int wrong_parts(const PoseRow& row) {
  std::set<std::string> parts;
  for (int item = 0; item < row.items; ++item) parts.insert(row.part(item));
  return static_cast<int>(parts.size()) != row.items || parts.contains("");
}

/// What of the law a row breaks in the first case that shows it; "" where it keeps all of it.
std::string broken_by(const PoseRow& row) {
  Random random(28);
  if (wrong_parts(row) > 0) return "parts";
  if (row.read != nullptr && wrong_maps(row) > 0) return "maps";
  for (int n = 0; n < cases(12); ++n) {
    const Case one(random, n);
    if (wrong_slopes(row, one) > 0) return "slopes";
    if (row.numbers != nullptr && wrong_numbers(row, one) > 0) return "numbers";
    if (row.form != nullptr) {
      if (wrong_moves<PoseForm>(row, one) > 0) return "moves";
      for (const double half : {1e-6, 0.02, 0.2})
        if (wrong_forms<PoseForm>(row, one, half, random) > 0) return "forms";
    }
    if (row.design_form != nullptr) {
      if (wrong_moves<DesignForm>(row, one) > 0) return "moves over designs";
      for (const double half : {1e-6, 0.02})
        if (wrong_forms<DesignForm>(row, one, half, random) > 0) return "forms over designs";
    }
  }
  return "";
}

/// The row behind a planted error: rows hold plain functions.
PoseRow sound;

template <class T>
T too_sure(T u) {
  u.r *= 0.01;
  return u;
}

/// An error in one function of a row; false where the row does not have it.
using Plant = bool (*)(PoseRow&);
constexpr std::array<Plant, 12> plants{
    [](PoseRow& row) {
      row.slopes = [](const PointLook& look, int item, PointSlopes& slopes) {
        const double value = sound.slopes(look, item, slopes);
        for (int k = 0; k < slopes.points; ++k) slopes.at[at_index(k)].slope *= 1.0 + 1e-5;
        return value;
      };
      return true;
    },
    [](PoseRow& row) {
      row.number = [](const PointLook& look, int item) { return sound.number(look, item) * (1.0 + 1e-6); };
      return true;
    },
    [](PoseRow& row) {
      row.numbers = [](const PointLook& look, double* out) {
        sound.numbers(look, out);
        out[sound.items - 1] *= 1.0 + 1e-12;
      };
      return sound.numbers != nullptr;
    },
    [](PoseRow& row) {
      row.part = [](int) { return std::string(); };
      return true;
    },
    [](PoseRow& row) {
      row.form = [](const FormLook& look, int item) { return too_sure(sound.form(look, item)); };
      return sound.form != nullptr;
    },
    [](PoseRow& row) {
      row.numerator = [](const FormLook& look, int item) { return too_sure(sound.numerator(look, item)); };
      return sound.numerator != nullptr;
    },
    [](PoseRow& row) {
      row.moves = [](const FormLook& look, int item, Moves& moves) {
        sound.moves(look, item, moves);
        for (double& along : moves.along) along *= along;
      };
      return sound.moves != nullptr;
    },
    [](PoseRow& row) {
      row.design_form = [](const DesignLook& look, int item) { return too_sure(sound.design_form(look, item)); };
      return sound.design_form != nullptr;
    },
    [](PoseRow& row) {
      row.design_numerator = [](const DesignLook& look, int item) {
        return too_sure(sound.design_numerator(look, item));
      };
      return sound.design_numerator != nullptr;
    },
    [](PoseRow& row) {
      row.design_moves = [](const DesignLook&, int, Moves&) {};
      return sound.design_moves != nullptr;
    },
    [](PoseRow& row) {
      row.read = [](const Interval& u) { return sound.read(u) + Interval(1e-6); };
      return sound.read != nullptr;
    },
    [](PoseRow& row) {
      row.smooth = [](const Interval& number) { return sound.smooth(number) * Interval(1.0 + 1e-6); };
      return sound.smooth != nullptr;
    },
};

}  // namespace

TEST_SUITE("law") {
  TEST_CASE("every row of a pose keeps the law") {
    int rows = 0;
    for (const LimitRow& row : limit_rows()) {
      if (row.pose == nullptr) continue;
      ++rows;
      CAPTURE(std::string(row.info.name));
      CHECK(broken_by(*row.pose) == "");
    }
    CHECK(rows >= 8);
  }

  TEST_CASE("a determinant, the determinants of the kernels and a limit that also holds on the way are the same rows") {
    for (const LimitRow& row : limit_rows()) {
      const bool sign = row.info.kind == LimitKind::sign;
      CHECK(row.on_the_way() == sign);
      if (sign) CHECK(row.pose->items == 3);
      if (row.pose != nullptr && row.pose->cone_body >= 0)
        CHECK(row.pose->first_at_body + row.pose->items <= legs_at_body);
      if (row.pose != nullptr && row.pose->pairs) CHECK(row.pose->items == leg_pairs);
    }
  }

  TEST_CASE("distances of legs are within their bounds") {
    Random random(5);
    for (int n = 0; n < cases(30); ++n) {
      const Case one(random, n);
      for (const double half : {1e-6, 0.02, 0.2}) {
        CHECK(wrong_distances<PoseForm>(one, half, random) == 0);
        CHECK(wrong_distances<DesignForm>(one, half, random) == 0);
      }
    }
  }

  TEST_CASE("a planted error in any function of a row breaks the law") {
    for (const LimitRow& row : limit_rows()) {
      if (row.pose == nullptr) continue;
      CAPTURE(std::string(row.info.name));
      sound = *row.pose;
      for (std::size_t k = 0; k < plants.size(); ++k) {
        CAPTURE(k);
        PoseRow wrong = sound;
        if (plants[k](wrong)) CHECK(broken_by(wrong) != "");
      }
    }
  }

  TEST_CASE("a stack is its poses one by one, with the numbers of the rows") {
    Random random(6);
    constexpr long count = 13;  // lanes and a rest
    for (int n = 0; n < 20; ++n) {
      Case one(random, n);
      std::vector<Configuration> poses;
      Eigen::Matrix<double, 3, count> p, s;
      std::array<Eigen::Matrix<double, 3, 3, Eigen::RowMajor>, count> q;
      for (Eigen::Index k = 0; k < count; ++k) {
        const Configuration at = Case({one.g, one.home}, random, n).here;
        poses.push_back(at);
        p.col(k) = at.position;
        s.col(k) = at.internal_point;
        q[at_index(k)] = at.rotation;
      }
      const batch::Configurations c{p.data(), q.front().data(), s.data(), count, 3, 9, 3};
      std::array<double, 9 * count> lengths;
      std::array<double, 3 * count> det;
      batch::leg_lengths(one.g, c, lengths.data());
      batch::singularity_margins(one.g, c, det.data());
      for (const LimitRow& row : limit_rows()) {
        if (row.pose == nullptr) continue;
        CAPTURE(std::string(row.info.name));
        const LimitNumbers stack(row.info.name, one.g, one.home, 1.0, one.options);
        std::array<double, leg_pairs> found;
        for (int k = 0; k < count; ++k) {
          one.here = poses[at_index(k)];
          stack.at(one.here, found.data());
          for (int item = 0; item < row.pose->items; ++item) {
            const double number = number_of(*row.pose, one, item);
            CHECK(found[at_index(item)] == number);
            if (row.pose->first_leg >= 0) {
              const double kernel = lengths[at_index(9 * k + row.pose->first_leg + item)];
              CHECK(number == doctest::Approx(kernel).epsilon(1e-13));
            }
            if (row.info.kind == LimitKind::sign) {
              const PosedPoints home = posed_points(one.g, one.home);
              const double side = PointLook(home, home, one.options).side(item);
              CHECK(std::abs(number - side * det[at_index(3 * k + item)]) <= 1e-13);
              CHECK(side == FormHome(one.g, one.home, one.options).side[at_index(item)]);
            }
          }
        }
      }
    }
  }

  TEST_CASE("a stack of condition numbers and their slopes is its poses one by one") {
    Random random(7);
    for (int n = 0; n < cases(12); ++n) {
      std::vector<PosedPoints> poses;
      const Case one(random, n);
      for (int k = 0; k < 5; ++k) {
        const Case there = Case({one.g, one.home}, random, n);
        poses.push_back(posed_points(there.g, there.here));
      }
      std::array<const PosedPoints*, 5> all;
      std::ranges::transform(poses, all.begin(), [](const PosedPoints& pose) { return &pose; });
      const SpectrumStack stack(all, 1.0);
      for (std::size_t k = 0; k < poses.size(); ++k) {
        const Spectrum s = stack.spectrum(k);
        const auto log_kappa = [&](const PosedPoints& at) {
          const Vec6 sigma = spectrum(at.at, at.legs, 1.0).sigma;
          return std::log(sigma[0] / sigma[5]);
        };
        CHECK(std::log(s.sigma[0] / s.sigma[5]) == doctest::Approx(log_kappa(poses[k])).epsilon(1e-12));
        const PointGradient top = stack.slopes(k, s, 0), bottom = stack.slopes(k, s, 5);
        for (int point = 0; point < point_count; ++point) {
          const Vec3 slope = top.point[at_index(point)] - bottom.point[at_index(point)];
          const Vec3 expected = quotient([&](const Vec3& by) { return log_kappa(moved(poses[k], point, by)); });
          CHECK((slope - expected).norm() <= 1e-6 * (1.0 + slope.norm()));
        }
      }
    }
  }

  TEST_CASE("the names of the public header are those of the rows") {
    Random random(8);
    const Case one(random, 0);
    for (const std::string& name : limits_of_poses()) {
      const LimitNumbers numbers(name, one.g, one.home, 1.0, one.options);
      const PoseRow& row = *limit_row(name).pose;
      REQUIRE(numbers.items() == row.items);
      REQUIRE(limit_parts(name).size() == static_cast<std::size_t>(row.items));
    }
    CHECK(limits_over_lengths() == std::vector<std::string>{"leg_ratio", "stroke_ratio", "stroke"});
    CHECK(limit_body("base_cone") == "base");
    CHECK(limit_body("platform_cone_internal") == "platform");
    CHECK(limit_body("leg_length") == "");
    for (const LimitRow& row : limit_rows()) CHECK(limit_kind_from(to_string(row.info.kind)) == row.info.kind);
    CHECK_THROWS_AS(limit_kind_from("colour"), InvalidArgument);
    CHECK_THROWS_WITH_AS(LimitNumbers("height", one.g, one.home, 1.0), doctest::Contains("height"), InvalidArgument);
    Triple same = one.g.base_internal();
    same[1] = one.g.base_external()[2];
    const Geometry coupled(one.g.base_external(), same, one.g.platform_external(), one.g.platform_internal());
    const std::array<bool, 21> exempt = pairs_sharing_a_joint(coupled);
    for (int pair = 0; pair < leg_pairs; ++pair)
      CHECK(exempt[at_index(pair)] == (leg_clearance_row.part(pair) == "l3-r2"));
  }
}
