#pragma once

#include "calibration/warps/blend_map.h"
#include "calibration/warps/pfm.h"
#include "calibration/warps/warp_mesh.h"

// Conversions between the forms of a warp in files.
namespace ergodome {

//! Direction of a map's texture coordinates: downward as in MPCDI, or upward as some programs write
//! them.
enum class TextureDirection { downwards, upwards };

//! Converts a map of two-dimensional data to a mesh: each sample is a node in the fill layout, with
//! its first two components as u and v. Samples with a component that is not finite (or beyond
//! 10,000) are unknown and not drawn. Ignores the third component, the sample's error.
WarpMesh warp_from_map(const FloatMap& map, TextureDirection direction);

//! Converts a mesh to a map of the given size with resampled_warp(). Third components are 0.
//! Samples that neither a drawn cell nor a node covers are NaN.
FloatMap map_from_warp(const WarpMesh& mesh, int width, int height, TextureDirection direction);

//! Returns a mesh's values at the positions of a map of the given size. Each cell is two triangles,
//! divided from the top left corner to the bottom right, with linear interpolation; where cells
//! overlap the last one counts. A position within 0.001 samples of a valid node has that node's
//! values. Throws Error if cells overlap more than those of a real warp.
WarpMesh resampled_warp(const WarpMesh& mesh, int width, int height);

//! Returns a mesh that draws the same image, with each cell divided into `steps` x `steps` cells,
//! for nonlinear conversions. Uses fewer steps if the mesh would exceed 2^23 nodes or
//! max_mesh_side. Returns a polar mesh unchanged.
WarpMesh refined_warp(const WarpMesh& mesh, int steps);

//! Returns a mesh in fill layout with nodes added at the raster's edge, extrapolated linearly from
//! the outermost two on each side. Samples are at the centers of their parts of the raster, so a
//! coarse map alone would leave the edge undrawn.
WarpMesh with_rim(const WarpMesh& mesh);

//! Returns a mesh's intensities, 0 where it is not drawn, as a gray mask of 16 bits and the given
//! size. Intensities above 1 become 1.
BlendMap mask_from_warp(const WarpMesh& mesh, int width, int height);

//! Multiplies a mesh's intensities by a mask, interpolated at each node and raised to `gamma`. Uses
//! the mean of a mask's color channels.
void multiply_intensity(WarpMesh& mesh, const BlendMap& mask, double gamma);

}  // namespace ergodome
