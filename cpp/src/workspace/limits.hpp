#pragma once
/// Numbers of everything that may end a workspace, as indices into limit_names().

namespace ninedof::limit {

constexpr int leg_low = 0, leg_high = 9;
constexpr int base_cone = 18, platform_cone = 24;  // l1 l2 l3, then the body's own internal legs
constexpr int clearance = 30;                      // 21 pairs of legs
constexpr int condition_number = 51;
constexpr int det_m = 52, det_b = 53, det_c = 54;
constexpr int region = 55, box = 56, internal_point = 57;
constexpr int count = 58;

}  // namespace ninedof::limit
