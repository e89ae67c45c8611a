#pragma once

#include <array>
#include <optional>

#include "content/sky/environment_image.h"

namespace ergodome {

//! How the six faces of a cube map lie in an image.
enum class CubeMapLayout {
  row,               //!< 6:1, faces +X, -X, +Y, -Y, +Z, -Z from left to right, as OpenGL and DirectX orient them
  column,            //!< 1:6, the same from top to bottom
  horizontal_cross,  //!< 4:3, left, front, right and back in the middle row, top and bottom above and below front
  vertical_cross,  //!< 3:4, left, front and right in the second row; top, bottom, and back upside down in the middle column
  openexr          //!< 1:6, OpenEXR's envmap of type cube
};

//! Returns the layout of an image by its shape, or nothing. `openexr_cube`: the file says that it is such an environment map.
std::optional<CubeMapLayout> cube_map_layout(int width, int height, bool openexr_cube);

//! Returns how many faces an image is wide and high.
std::array<int, 2> faces_of(CubeMapLayout layout);

//! True if the parts of a cross that hold no face have one color each, as far as JPEG leaves that: other images of the same
//! shape have pictures there.
bool has_plain_corners(const EnvironmentImage& image, CubeMapLayout layout);

//! Resamples a cube map to an equirectangular image of `width` x `width` / 2 texels, bilinearly within each face. The front face
//! comes to the middle, the right face to the right of it.
//! Source: OpenGL 4.6, table 8.19; OpenEXR, "Environment Maps" (ImfEnvmap).
EnvironmentImage equirectangular_from_cube(const EnvironmentImage& cube, CubeMapLayout layout, int width);

}  // namespace ergodome
