/// blueprint.hpp and the families: joints and neutral configuration against the constructors of Geometry, derivatives
/// against differences.

#include <doctest/doctest.h>

#include "support/designs.hpp"

using namespace ninedof;
using namespace designs;

namespace {

/// A blueprint's numbers in the order of its gradient's rows.
Eigen::VectorXd numbers(const DesignFamily& family, const Eigen::VectorXd& x) {
  Blueprint b;
  family.blueprint(span(x), b);
  Eigen::VectorXd out(static_cast<Eigen::Index>(blueprint_rows));
  for (int joint = 0; joint < 12; ++joint) out.segment<3>(3 * joint) = b.joint[static_cast<std::size_t>(joint)];
  out[row_zp] = b.zp;
  out[row_zs] = b.zs;
  out[row_theta_z] = b.theta_z;
  return out;
}

/// Largest distance of two joints that should coincide.
double apart(const Geometry& a, const Geometry& b) {
  double most = 0.0;
  for (std::size_t i = 0; i < 3; ++i)
    for (const double distance :
         {(a.base_external()[i] - b.base_external()[i]).norm(), (a.base_internal()[i] - b.base_internal()[i]).norm(),
          (a.platform_external()[i] - b.platform_external()[i]).norm(),
          (a.platform_internal()[i] - b.platform_internal()[i]).norm()})
      most = std::max(most, distance);
  return most;
}

Geometry of_blueprint(const DesignFamily& family, const Eigen::VectorXd& x) {
  Blueprint b;
  family.blueprint(span(x), b);
  const auto triple = [&](std::size_t first) -> Triple {
    return {b.joint[first], b.joint[first + 1], b.joint[first + 2]};
  };
  return {triple(0), triple(3), triple(6), triple(9)};
}

std::vector<std::string> names_of(const std::string& family) {
  std::vector<std::string> out;
  for (const VariableInfo& v : design_family(family).variables()) out.push_back(v.name);
  return out;
}

}  // namespace

TEST_SUITE("families") {
  TEST_CASE("hexagonal: the joints of eqs. (37)-(38)") {
    Random random(201);
    const DesignFamily& family = design_family("hexagonal");
    for (int n = 0; n < 200; ++n) {
      Eigen::VectorXd x = random_design("hexagonal", random);
      if (n % 3 == 1) x[0] = x[3] = 0.0;
      const Geometry expected = Geometry::hexagonal(x[0], x[1], x[2], x[3]);
      CHECK(apart(family.geometry(span(x)), expected) == 0.0);
      CHECK(apart(of_blueprint(family, x), expected) <= 8.0 * eps * x.cwiseAbs().maxCoeff());
    }
  }

  TEST_CASE("symmetric families: four orbits, the external base joint at angle 0; heights where there are some") {
    Random random(202);
    for (const std::string name : {"symmetric", "symmetric_nonplanar"}) {
      const DesignFamily& family = design_family(name);
      for (int n = 0; n < 200; ++n) {
        const Eigen::VectorXd x = random_design(name, random);
        const auto height = [&](Eigen::Index k) { return x.size() == 13 ? x[9 + k] : 0.0; };
        const Geometry expected = Geometry::symmetric({x[0], 0.0, height(0)}, {x[1], x[2], height(1)},
                                                      {x[3], x[4], height(2)}, {x[5], x[6], height(3)});
        CHECK(apart(family.geometry(span(x)), expected) <= 16.0 * eps);
        CHECK(apart(of_blueprint(family, x), expected) <= 16.0 * eps);
      }
    }
  }

  TEST_CASE("general: any robot, joint by joint") {
    Random random(203);
    const DesignFamily& family = design_family("general");
    for (int n = 0; n < 50; ++n) {
      const Geometry g = random_robot(random).geometry;
      Eigen::VectorXd x(39);
      int k = 0;
      for (const Triple* t : {&g.base_external(), &g.base_internal(), &g.platform_external(), &g.platform_internal()})
        for (const Vec3& joint : *t) x.segment<3>(3 * k++) = joint;
      x.tail<3>() = Vec3(4.0, 2.0, 0.3);
      CHECK(apart(family.geometry(span(x)), g) == 0.0);
    }
  }

  TEST_CASE("neutral configuration: zp and zs on the axis, turned by theta_z where the family has it") {
    Random random(204);
    for (const std::string& name : families) {
      CAPTURE(name);
      const DesignFamily& family = design_family(name);
      const Eigen::VectorXd x = random_design(name, random);
      const std::vector<std::string> names = names_of(name);
      const bool turns = std::find(names.begin(), names.end(), "theta_z") != names.end();
      CHECK(turns == (name == "hexagonal" || name == "general"));
      const Configuration c = family.configuration(span(x));
      const double angle = turns ? x[family.index("theta_z")] : 0.0;
      CHECK(c.position == Vec3(0.0, 0.0, x[family.index("zp")]));
      CHECK(c.internal_point == Vec3(0.0, 0.0, x[family.index("zs")]));
      CHECK((c.rotation - Eigen::AngleAxisd(angle, Vec3::UnitZ()).toRotationMatrix()).cwiseAbs().maxCoeff() <=
            4.0 * eps);
    }
  }

  TEST_CASE("derivatives against differences") {
    Random random(205);
    for (const std::string& name : families) {
      CAPTURE(name);
      const DesignFamily& family = design_family(name);
      for (int n = 0; n < 20; ++n) {
        const Eigen::VectorXd x = random_design(name, random);
        Blueprint b;
        family.blueprint(span(x), b);
        REQUIRE(b.gradient.rows() == static_cast<Eigen::Index>(blueprint_rows));
        REQUIRE(b.gradient.cols() == x.size());
        for (Eigen::Index k = 0; k < x.size(); ++k) {
          CAPTURE(k);
          const Eigen::VectorXd expected =
              difference([&](const Eigen::VectorXd& at) { return numbers(family, at); }, x, k, 1e-3);
          CHECK(matrix_error(b.gradient.col(k), expected) <= 1e-11);
          CHECK(expected.cwiseAbs().maxCoeff() > 0.1);  // every variable moves something
        }
      }
    }
  }

  TEST_CASE("names, kinds and default bounds") {
    CHECK(design_family_names() == families);
    CHECK(names_of("hexagonal") == std::vector<std::string>{"a1", "a2", "b1", "b2", "zp", "zs", "theta_z"});
    CHECK(names_of("symmetric") == std::vector<std::string>{"base_external_radius", "base_internal_radius",
                                                            "base_internal_angle", "platform_external_radius",
                                                            "platform_external_angle", "platform_internal_radius",
                                                            "platform_internal_angle", "zp", "zs"});
    std::vector<std::string> nonplanar = names_of("symmetric");
    for (const char* triple : {"base_external", "base_internal", "platform_external", "platform_internal"})
      nonplanar.push_back(std::string(triple) + "_height");
    CHECK(names_of("symmetric_nonplanar") == nonplanar);
    const std::vector<std::string> general = names_of("general");
    REQUIRE(general.size() == 39);
    CHECK(general.front() == "base_external_1_x");
    CHECK(general[16] == "base_internal_3_y");
    CHECK(general[35] == "platform_internal_3_z");
    for (const std::string& name : families) {
      const DesignFamily& family = design_family(name);
      CHECK(family.name() == name);
      CHECK(family.symmetric() == (name != "general"));
      CHECK(family.variables().size() <= max_variables);
      for (std::size_t k = 0; k < family.variables().size(); ++k) {
        const VariableInfo& v = family.variables()[k];
        CAPTURE(v.name);
        const bool angle = v.name.ends_with("angle") || v.name == "theta_z";
        const bool coordinate = v.name.ends_with("height") || (name == "general" && k < 36);
        CHECK(v.kind == (angle ? VariableKind::angle : coordinate ? VariableKind::coordinate : VariableKind::length));
        CHECK(v.low <= v.high);
        CHECK(family.index(v.name) == static_cast<int>(k));
      }
      CHECK(refuses("variable", [&] { family.index("length"); }));
    }
  }

  TEST_CASE("general: the defaults are the published coupled triangles") {
    const DesignFamily& family = design_family("general");
    Eigen::VectorXd x(39);
    for (Eigen::Index k = 0; k < 39; ++k) {
      const VariableInfo& v = family.variables()[static_cast<std::size_t>(k)];
      CHECK((v.low == v.high) == (v.name != "zp" && v.name != "zs"));
      x[k] = v.low;
    }
    const Geometry g = family.geometry(span(x));
    for (std::size_t i = 0; i < 3; ++i) {
      CHECK((g.base_external()[i] - g.base_external()[(i + 1) % 3]).norm() == doctest::Approx(5.8124).epsilon(1e-14));
      CHECK((g.platform_external()[i] - g.platform_external()[(i + 1) % 3]).norm() ==
            doctest::Approx(2.9062).epsilon(1e-14));
      const auto coupled = [&](const Triple& t, const Vec3& joint) {
        return std::any_of(t.begin(), t.end(), [&](const Vec3& other) { return (other - joint).norm() <= 1e-14; });
      };
      CHECK(coupled(g.base_internal(), g.base_external()[i]));
      CHECK(coupled(g.platform_internal(), g.platform_external()[i]));
    }
  }

  TEST_CASE("unknown families, too few variables and invalid plates throw, naming the argument") {
    CHECK(refuses("family", [] { design_family("hexagon"); }));
    for (const std::string& name : families)
      CHECK(message_of([] { design_family(""); }).find("\"" + name + "\"") != std::string::npos);
    for (const std::string& name : families)
      for (const std::size_t count : {0, 6, 8, 38, 40}) {
        const std::vector<double> x(count, 1.0);
        Blueprint out;
        CHECK(refuses("x", [&] { design_family(name).blueprint(x, out); }));
      }
    const auto hexagonal = [](std::array<double, 7> x) { design_family("hexagonal").geometry(x); };
    CHECK(refuses("a1", [&] { hexagonal({-1, 1, 1, 1, 2, 1, 0}); }));
    CHECK(refuses("b1, b2", [&] { hexagonal({1, 1, 0, 0, 2, 1, 0}); }));
    const std::vector<double> point{1, 0, 0, 1, 0, 1, 0, 2, 1};
    CHECK(message_of([&] { design_family("symmetric").geometry(point); }) != "nothing thrown");
    CHECK(message_of([] { design_family("general").geometry(std::vector<double>(39, 1.0)); }) != "nothing thrown");
  }
}
