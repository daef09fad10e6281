/// A limit of the design alone. Declared in problem/constraints/solver_rows.hpp.

#include "problem/constraints/solver_rows.hpp"

namespace ninedof {
namespace {

class DesignLimit : public SolverRows {
 public:
  DesignLimit(const Limit& limit, const LimitRow& row) : SolverRows(limit, row.solver), row_(row) {}

 private:
  int items(Side side) const override { return row_.design->items(side); }
  Touched<double> touched(const DesignState& v, std::pair<int, int> joints) const {
    const Blueprint& b = v.blueprint;
    const auto xyz = [&](int joint) { return PointLook::xyz(b.joint[at_index(joint)]); };
    return {xyz(joints.first), xyz(joints.second), b.zp, b.zs};
  }
  double value(const DesignState& v, Side side, int item) const override {
    const auto joints = row_.design->joints(v.blueprint.joint, side, item);
    return row_.design->number(touched(v, joints), item) / unit(v, row_.design->body(item));
  }
  void add_value_gradient(const DesignState& v, Side side, int item, double scale, Row out) const override {
    const auto joints = row_.design->joints(v.blueprint.joint, side, item);
    const DesignSlopes slopes = row_.design->slopes(touched(v, joints), item);
    if (!std::isfinite(slopes.value)) return;
    const int body = row_.design->body(item);
    const double u = unit(v, body), by = scale / u;
    v.add_joint(joints.first, by * slopes.a, out);
    v.add_joint(joints.second, by * slopes.b, out);
    v.add_zp(by * slopes.zp, out);
    v.add_zs(by * slopes.zs, out);
    add_unit_gradient(v, -by * slopes.value / u, out, body);
  }

  const LimitRow& row_;
};

}  // namespace

std::unique_ptr<SolverRows> make_design_limit(const Limit& limit, const LimitRow& row) {
  return std::make_unique<DesignLimit>(limit, row);
}

}  // namespace ninedof
