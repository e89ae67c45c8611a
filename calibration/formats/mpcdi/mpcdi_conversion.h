#pragma once

#include <string>
#include <vector>

#include "calibration/formats/mpcdi/mpcdi.h"
#include "calibration/warps/projector_view.h"
#include "calibration/warps/warp_mesh.h"

// Converts MPCDI calibrations to warps, surfaces, poses and lenses, and warps to calibrations.
namespace ergodome {

//! Position and orientation of a projector in the dome's axes (x right, y up, z back).
struct ProjectorPose {
  Vector3<double> position_m{};
  Orientation orientation;
};

//! Returns the warp of a region of profile 2d or 3d. In profile 2d it refers to the whole image of
//! the buffer (u = x + xSize · u of the file), in profile 3d to the image in the region's frustum.
//! Throws Error, which names `location`, for other profiles and regions without a warp.
WarpMesh warp_of(const Mpcdi& mpcdi, const MpcdiRegion& region, const std::string& location);

//! Returns the surface that a region of profile a3 or sl lights. Profile sl rotates it by the
//! region's coordinate frame, like the pose; profile a3 has x to the left, y up, z to the front
//! (VESA MPCDI 2.0, 3.6.3). Throws Error for other profiles and regions without a surface.
SurfaceMesh surface_of(const Mpcdi& mpcdi, const MpcdiRegion& region, const std::string& location);

//! Returns the pose of a region with a frustum. Without a coordinate frame, its position is the
//! origin, the ideal eye point. With one, the axis of pitch points right, that of roll to the
//! front, that of yaw down (VESA MPCDI 2.0, 2.2.2), and lengths have the unit of its 3D data.
ProjectorPose pose_of(const MpcdiRegion& region);

//! Returns the lens of a region: a fisheye if an extension defines one, otherwise its frustum, if
//! any. The field of view of a fisheye is the widest in which its polynomial increases; skew and
//! anamorphic ratio are ignored.
Lens lens_of(const MpcdiRegion& region);

//! Returns a region of profile 2d that covers its whole buffer: the warp as a map of the given
//! size, and its intensities as the alpha mask.
MpcdiRegion region_from_warp(const std::string& id, const WarpMesh& warp, int resolution_x, int resolution_y,
                             int map_width, int map_height);

//! Returns a calibration of version 2, profile 2d, with a single buffer of these regions. `date` is
//! "yyyy-MM-dd HH:mm:ss".
Mpcdi media_calibration(std::vector<MpcdiRegion> regions, const std::string& date);

}  // namespace ergodome
