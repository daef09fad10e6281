#include "ninedof/limits/numbers.hpp"

#include "limits/table.hpp"
#include "math/numbers.hpp"
#include "ninedof/math/error.hpp"
#include "robot/leg_pairs.hpp"

namespace ninedof {

std::vector<std::string> limits_of_poses() {
  std::vector<std::string> out;
  for (const LimitRow& row : limit_rows())
    if (row.pose != nullptr) out.emplace_back(row.info.name);
  return out;
}

std::vector<std::string> limits_over_lengths() {
  std::vector<std::string> out;
  for (const LimitRow& row : limit_rows())
    if (row.spread != nullptr) out.emplace_back(row.info.name);
  return out;
}

const SpreadRow& spread_row(const std::string& name) {
  const SpreadRow* row = limit_row(name).spread;
  if (row == nullptr) throw InvalidArgument("limit", "\"" + name + "\"", "a limit of lengths over all poses");
  return *row;
}

std::vector<std::string> limit_parts(const std::string& name) {
  std::vector<std::string> out;
  const SpreadRow* spread = limit_row(name).spread;
  if (spread != nullptr && !spread->each_leg) return out;
  const PoseRow& row = spread != nullptr ? *leg_length_limit().pose : pose_row("limit", name);
  for (int item = 0; item < row.items; ++item) out.push_back(row.part(item));
  return out;
}

std::string limit_body(const std::string& name) {
  const PoseRow* row = limit_row(name).pose;
  return row == nullptr || row->cone_body < 0 ? "" : row->cone_body == 0 ? "base" : "platform";
}

LimitNumbers::LimitNumbers(const std::string& name, const Geometry& g, const Configuration& home,
                           double characteristic_length, const LimitOptions& options,
                           const std::array<bool, 21>& exempt)
    : row_(pose_row("limit", name)),
      geometry_(g),
      home_(posed_points(g, home)),
      options_(options),
      exempt_(exempt),
      length_(characteristic_length) {}

int LimitNumbers::items() const {
  return row_.items;
}

void LimitNumbers::at(const Configuration& pose, double* out) const {
  const PosedPoints here = posed_points(geometry_, pose);
  const PointLook look(here, home_, options_, length_);
  if (row_.numbers != nullptr) return row_.numbers(look, out);
  for (int item = 0; item < row_.items; ++item)
    out[item] = row_.pairs && exempt_[at_index(item)] ? infinity : row_.number(look, item);
}

std::array<bool, 21> pairs_sharing_a_joint(const Geometry& g, const std::array<bool, 21>& among) {
  const Points at = points(g, {Vec3::Zero(), Mat3::Identity(), Vec3::Zero()});  // joints in the frames of their bodies
  std::array<bool, leg_pairs> out = among;
  for (int pair = 0; pair < leg_pairs; ++pair)
    out[at_index(pair)] = out[at_index(pair)] && share_joint(std::span(at).first<12>(), pair);
  return out;
}

}  // namespace ninedof
