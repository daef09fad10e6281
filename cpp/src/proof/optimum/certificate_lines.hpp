#pragma once
/// Lines of certificates of designs and of workspaces.

#include <array>
#include <string>
#include <vector>

#include "ninedof/limits/duty.hpp"
#include "ninedof/limits/limits.hpp"
#include "ninedof/math/error.hpp"
#include "proof/optimum/certificate.hpp"

namespace ninedof::proof {

class CertificateLines {
 protected:
  struct Numbers {
    std::vector<double> all;
    Numbers() = default;
    Numbers(std::initializer_list<double> x) : all(x) {}
    Numbers(std::initializer_list<Vec3> x) {
      for (const Vec3& v : x) all.insert(all.end(), v.begin(), v.end());
    }
  };
  static std::string spelled(const Numbers& x) {
    std::string out;
    for (const double one : x.all) out.append(1, ' ').append(proof::hexadecimal(one));
    return out;
  }
  void line(const std::string& words, const Numbers& numbers = {}, const std::string& rest = "") {
    text_ += words + spelled(numbers) + rest + "\n";
  }

  /// Of limits of forces, rates and powers: one for all of them.
  void put_duty(const std::vector<Limit>& limits) {
    std::string first;
    for (const Limit& one : limits) {
      if (one.duty == nullptr) continue;
      const std::size_t start = text_.size();
      put_duty(*one.duty);
      const std::string own = text_.substr(start);
      if (first.empty()) first = own;
      else text_.resize(start);
      if (own != first) throw InvalidArgument(one.label(), "a duty of its own", "that of all other limits");
    }
  }
  void put_limit(const std::string& name, double low, double high, const char* of, bool neutral, const Vec3& axis) {
    line("limit " + name, {low, high}, std::string(" ") + of + (neutral ? " neutral" : " poses") + spelled({axis}));
  }
  std::string text_;

 private:
  void put_duty(const Duty& duty) {
    const Masses& m = duty.masses;
    const Vec3 &g = duty.gravity, &c = m.centre;
    line("weights", {g.x(), g.y(), g.z(), m.platform, c.x(), c.y(), c.z(), m.internal_point});
    for (int k = 0; k < 9; ++k) line("leg", {m.cylinder[k], m.cylinder_centre[k], m.rod[k], m.rod_centre[k]});
    for (const Load& load : duty.loads) line("load", {load.moment, load.force, load.force_at_o});
    const char* internal =
        std::array{" least", " held", " shifted", " carried"}[static_cast<std::size_t>(duty.motion.internal)];
    line("speeds", {duty.motion.linear_speed, duty.motion.angular_speed}, internal);
  }
};

}  // namespace ninedof::proof
