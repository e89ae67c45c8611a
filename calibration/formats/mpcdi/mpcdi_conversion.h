#pragma once

#include <string>
#include <vector>

#include "calibration/formats/mpcdi/mpcdi.h"
#include "calibration/projectors/lens.h"
#include "calibration/warps/warp_mesh.h"

// What an MPCDI calibration means for drawing, and the calibration that warps make.
namespace ergodome {

//! Where a projector stands and looks, in the dome's axes (x right, y up, z back).
struct ProjectorPose {
  Vector3<double> position_m{};
  Orientation orientation;
};

//! The warp of a region of profile 2d or 3d. In profile 2d it looks up the buffer's whole image (u = x + xSize · u of the file);
//! in profile 3d the picture that the region's frustum shows. Throws Error, naming `place`, for the other profiles and where
//! there is no warp.
WarpMesh warp_of(const Mpcdi& mpcdi, const MpcdiRegion& region, const std::string& place);

//! The surface that a region of profile a3 or sl meets. Profile sl turns it by its coordinate frame, like the pose; profile a3
//! has x to the left, y up, z to the front (VESA MPCDI 2.0, 3.6.3). Throws Error for the other profiles and where there is no
//! surface.
SurfaceMesh surface_of(const Mpcdi& mpcdi, const MpcdiRegion& region, const std::string& place);

//! The pose of a region: where there is no coordinate frame it stands at the origin, the ideal eye point. With one, the axis of
//! pitch points right, that of roll to the front, that of yaw down (VESA MPCDI 2.0, 2.2.2), and lengths are in the unit of its 3D
//! data. Needs a frustum.
ProjectorPose pose_of(const MpcdiRegion& region);

//! The lens of a region: a fisheye where an extension tells one, with the widest field of view over which it grows; else its
//! frustum. Skewed and anamorphic fisheyes are read as round ones.
Lens lens_of(const MpcdiRegion& region);

//! A region of profile 2d that covers its whole buffer: the warp as a map of the given size, and its intensities as the alpha mask.
MpcdiRegion region_from_warp(const std::string& id, const WarpMesh& warp, int resolution_x, int resolution_y,
                             int map_width, int map_height);

//! A calibration of version 2, profile 2d, whose one buffer holds these regions. `date` is "yyyy-MM-dd HH:mm:ss".
Mpcdi media_calibration(std::vector<MpcdiRegion> regions, const std::string& date);

}  // namespace ergodome
