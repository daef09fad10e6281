/// O between the plates (eq. 9b) where the optimizer places it: above the plane of the base frame and below that of the
/// platform frame in every such pose. Beyond either plane O would be on the far side of a singularity.
/// Declared in problem/constraints/solver_rows.hpp.

#include <Eigen/Geometry>

#include "problem/constraints/solver_rows.hpp"

namespace ninedof {
namespace {

class BetweenPlates : public SolverRows {
 public:
  explicit BetweenPlates(std::vector<int> poses) : SolverRows(named(), SolverMargin::plain), poses_(std::move(poses)) {}
  double price_factor(int) const override { return 0.0; }

 private:
  static Limit named() {
    Limit l;
    l.name = "zp > zs";
    l.low = plate_gap;
    return l;
  }
  int items(Side) const override { return 2 * static_cast<int>(poses_.size()); }
  int pose(const DesignState& v, int item) const override { return v.first_pose + poses_[at_index(item / 2)]; }
  static Vec3 below(const PoseState& at) { return at.at[point_p] - at.at[point_s]; }
  /// Of O below the platform: the tool's point is tool.position.z above its plane.
  static double below_plate(const DesignState& v, const PoseState& at) {
    return below(at).dot(at.plate.col(2)) - v.tool.position.z();
  }

  double value(const DesignState& v, Side, int item) const override {
    const PoseState& at = v.pose(pose(v, item));
    const double height = item % 2 == 0 ? at.at[point_s].z() : below_plate(v, at);
    return height / v.blueprint.zp;
  }
  void add_value_gradient(const DesignState& v, Side side, int item, double scale, Row out) const override {
    const int k = pose(v, item);
    const PoseState& at = v.pose(k);
    const double size = scale / v.blueprint.zp;
    v.add_zp(-size * value(v, side, item), out);
    if (item % 2 == 0) return v.add_point(k, point_s, Vec3(0.0, 0.0, size), out);
    // The axis of the platform turns with theta_z.
    const Vec3 axis = at.plate.col(2);
    v.add_point(k, point_p, size * axis, out);
    v.add_point(k, point_s, -size * axis, out);
    v.add_turn(k, size * axis.cross(below(at)), out);
  }

  std::vector<int> poses_;
};

}  // namespace

std::unique_ptr<SolverRows> make_between_plates(std::vector<int> poses) {
  return std::make_unique<BetweenPlates>(std::move(poses));
}

}  // namespace ninedof
