#pragma once
/// A box of designs as forms: joints, the neutral pose, and the heights of the plates.

#include <span>
#include <vector>

#include "ninedof/proof/admissible.hpp"
#include "robot/pose_of.hpp"

namespace ninedof::admissible {

using DesignVector = Xyz<DesignForm>;

/// One box of the varied variables.
struct DesignBox {
  std::array<double, most_varied> low{}, high{};
};

DesignBox range_of(const DesignQuestion& question);
/// The design in the middle, as a box of no width.
DesignBox middle_of(const DesignBox& box, std::size_t dimensions);

/// T is DesignForm, or CurvedForm with the coordinates of the designs alone: for one pose at a time.
template <class T>
struct DesignsOf {
  JointsOf<T> plates;  ///< in the frames of the plates
  JointsOf<T> joints;  ///< platform joints in the tool's frame
  PoseOf<T> home;      ///< of the tool
  T zp, zs;
  bool orbits = false;  ///< whether the joints of a triple are turned copies of its first one
};
using DesignForms = DesignsOf<DesignForm>;

template <class T = DesignForm>
DesignsOf<T> design_forms(const DesignQuestion& question, const DesignBox& box);

/// A listed pose of the objective.
template <class T>
PoseOf<T> listed_pose(const Pose& pose, const DesignsOf<T>& designs);

}  // namespace ninedof::admissible
