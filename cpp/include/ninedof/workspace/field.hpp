#pragma once
/// The fields of a map on an even raster, smooth between the centres of its cells: for sections and bodies to draw.

#include <stop_token>

#include "ninedof/workspace/surface.hpp"
#include "ninedof/workspace/workspace.hpp"

namespace ninedof {

/// Both on the points of one raster about the workspace.
struct WorkspaceField {
  Raster fraction;  ///< allowed share, averaged over neighbours: the workspace ends where it is one half
  Raster condition_number;  ///< outside the workspace too
};

/// The fields of the cells of an octree or a grid, on at most about `most` points. Of the map are used: its ends, its
/// resolution and its cells.
///
/// From coarse to fine: the values of each level are the means of the cells in it where there are cells so small, and
/// interpolated linearly from the level above elsewhere. So a large cell has no step at its faces.
/// Throws InvalidArgument for a sample, and Stopped.
WorkspaceField field_of(const WorkspaceMap& map, long most = 1'300'000, const std::stop_token& stop = {});

/// The body of the workspace, at a level of the allowed share. The field is averaged, which shrinks a body that is
/// round or thin where the share is one half. So the level is the one that as many points of the raster are above as
/// are allowed, from 0.15 to 0.6.
QuadSurface surface_of(const WorkspaceField& field);

/// A plane section. Rows lie along `vertical`; in each, the points along `horizontal` are next to each other.
struct WorkspaceSection {
  std::vector<double> horizontal, vertical;
  std::vector<CellState> state;
  std::vector<std::int16_t> limit;  ///< index into limit_names(); -1 for none
  std::vector<double> condition_number;  ///< NaN where no pose is allowed
  std::vector<double> fraction;  ///< allowed share; the contour at one half is the boundary
};

/// The section of the cells of a map where coordinate `fixed` is `at`: `pixels` points along each side of the box, each
/// with the values of the cell that holds it. Cells of which no part is known to be allowed are outside.
/// Throws InvalidArgument for a sample, no such coordinate or no pixels, and Stopped.
WorkspaceSection section_of(const WorkspaceMap& map, int fixed, double at, int pixels,
                            const std::stop_token& stop = {});

/// The section of the field of a map, within its raster. The limit of a point on the boundary is that of the nearest
/// boundary cell, or "box" at a face of the box without one.
/// Throws Stopped.
WorkspaceSection section_of(const WorkspaceMap& map, const WorkspaceField& field, int fixed, double at,
                            const std::stop_token& stop = {});

}  // namespace ninedof
