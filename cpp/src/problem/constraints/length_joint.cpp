#include "problem/constraints/length_joint.hpp"

#include <algorithm>

namespace ninedof {
namespace {

/// Relative difference of distances that are the same by construction.
constexpr double same_distance = 1e-12;

/// Margin of the joint itself, which is no limit.
constexpr double no_limit = 1.0;

class LengthJoint : public SolverRows {
 public:
  explicit LengthJoint(std::vector<int> joints)
      : SolverRows(unnamed(), SolverMargin::logarithm), joints_(std::move(joints)) {}
  bool analytic() const override { return false; }
  double price_factor(int) const override { return 0.0; }

 private:
  static Limit unnamed() {
    Limit l;
    l.low = 1.0;
    return l;
  }
  int items(Side) const override { return static_cast<int>(joints_.size()); }
  bool limited(const DesignState& v, int item) const {
    return v.length_joint >= 0 && joints_[at_index(item)] != v.length_joint;
  }
  double item_margin(const DesignState& v, Side, int item) const override {
    return limited(v, item) ? 1.0 - v.joint_distance(joints_[at_index(item)]) / v.characteristic_length : no_limit;
  }
  void add_item_gradient(const DesignState& v, Side, int item, Row out) const override {
    if (!limited(v, item)) return;
    const int joint = joints_[at_index(item)];
    const double here = v.joint_distance(joint), longest = v.characteristic_length;
    if (!(longest > 0.0)) return;
    if (here > 0.0) v.add_joint(joint, -v.joint_arm(joint) / (here * longest), out);
    v.add_length(here / (longest * longest), out);
  }

  std::vector<int> joints_;
};

}  // namespace

std::vector<int> joints_of_distinct_distance(const std::vector<DesignState>& designs) {
  std::vector<int> out;
  for (int joint = point_u; joint < 12; ++joint) {
    const auto same = [&](int other) {
      return std::ranges::all_of(designs, [&](const DesignState& v) {
        const double a = v.joint_distance(joint), b = v.joint_distance(other);
        return std::abs(a - b) <= same_distance * std::max(a, b);
      });
    };
    if (std::ranges::none_of(out, same)) out.push_back(joint);
  }
  return out;
}

std::unique_ptr<SolverRows> make_length_joint(std::vector<int> joints) {
  return std::make_unique<LengthJoint>(std::move(joints));
}

}  // namespace ninedof
