#pragma once

#include "calibration/formats/warps/pfm.h"
#include "calibration/projectors/blend_map.h"
#include "calibration/warps/warp_mesh.h"

// Between the forms that a warp takes in files.
namespace ergodome {

//! Whether texture coordinates of a map run downwards, as MPCDI has them, or upwards, as some programs wrote them.
enum class TextureDirection { downwards, upwards };

//! A map of two-dimensional data as a mesh: each sample is a node in the fill layout, its first two components u and v. Samples
//! where one of them is not finite (or is beyond 10,000) are unknown and not drawn; the third component, the sample's error, is
//! left out.
WarpMesh warp_from_map(const FloatMap& map, TextureDirection direction);

//! A mesh as a map of the given size: nodes where the mesh has them in place already, else values between nodes by
//! resampled_warp. Third components are 0; samples that no drawn cell covers are NaN.
FloatMap map_from_warp(const WarpMesh& mesh, int width, int height, TextureDirection direction);

//! A mesh's values at the places of a map of the given size. Cells are two triangles, cut from the top left corner to the bottom
//! right, in which all is linear; where cells overlap the last one counts. Throws Error where they overlap more than a warp's
//! can.
WarpMesh resampled_warp(const WarpMesh& mesh, int width, int height);

//! Returns a mesh that draws the same with each cell cut into `steps` x `steps`, for conversions that are
//! not linear. Uses fewer steps if the mesh would exceed 2^23 nodes or most_mesh_side. Returns a polar mesh
//! unchanged.
WarpMesh refined_warp(const WarpMesh& mesh, int steps);

//! A mesh in fill layout with nodes on the raster's rim added, continued in a straight line from the outermost two on each side:
//! samples stand for the middles of their part of the raster, so a coarse map alone would leave the rim undrawn.
WarpMesh with_rim(const WarpMesh& mesh);

//! A mesh's intensities, 0 where it is not drawn, as a grey mask of 16 bits and the given size. Intensities above 1 become 1.
BlendMap mask_from_warp(const WarpMesh& mesh, int width, int height);

//! Multiplies a mesh's intensities by a mask, read between its samples at each node and raised to `gamma`; of colours the mean.
void multiply_intensity(WarpMesh& mesh, const BlendMap& mask, double gamma);

}  // namespace ergodome
