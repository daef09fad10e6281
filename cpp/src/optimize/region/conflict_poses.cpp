#include "optimize/region/conflict_poses.hpp"

#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "math/numbers.hpp"
#include "optimize/conflict.hpp"

namespace ninedof {
namespace {

constexpr std::size_t most_named = 4;  // poses in a sentence

/// "neutral shifted by (50, -50, 0) and turned (0, 10, 0)°"; without what is zero.
std::string in_words(const Pose& pose) {
  const auto list = [](Vec3 v) {
    const double rounding = 1e-9 * v.cwiseAbs().maxCoeff();
    for (double& c : v) c = std::abs(c) <= rounding ? 0.0 : c;
    std::array<char, 100> text{};
    std::snprintf(text.data(), text.size(), "(%.4g, %.4g, %.4g)", v.x(), v.y(), v.z());
    return std::string(text.data());
  };
  std::string text = "neutral";
  const bool shifted = pose.position != Vec3::Zero(), turned = pose.rotation != Vec3::Zero();
  if (shifted) text += " shifted by " + list(pose.position) + (pose.in_zp ? " zp" : "");
  if (turned) text += (shifted ? " and turned " : " turned ") + list(pose.rotation * 180.0 / std::numbers::pi) + "°";
  return text;
}

}  // namespace

void name_conflict(Result& result, std::size_t listed, std::vector<Pose>& poses) {
  std::vector<Pose> kept;
  for (const int pose : result.cause_poses) {
    const auto k = at_index(pose) - listed;
    if (at_index(pose) >= listed && k < poses.size()) kept.push_back(poses[k]);
  }
  if (kept.empty()) return;
  std::string text = "at the pose";
  text += kept.size() > 1 ? "s " : " ";
  for (std::size_t k = 0; k < std::min(kept.size(), most_named); ++k) text += (k > 0 ? ", " : "") + in_words(kept[k]);
  if (kept.size() > most_named) (text += ", and more, ") += std::to_string(kept.size()) + " in all";
  if (const auto at = result.reason.find(in_these_poses); at != std::string::npos)
    result.reason.replace(at, in_these_poses.size(), text);
  poses = std::move(kept);
}

}  // namespace ninedof
