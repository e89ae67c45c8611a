#pragma once

#include <array>
#include <optional>

#include "content/sky/environment_image.h"

namespace ergodome {

//! The arrangement of the six faces of a cube map in an image.
enum class CubeMapLayout {
  row,               //!< 6:1, faces +X, -X, +Y, -Y, +Z, -Z from left to right, oriented as in OpenGL and DirectX
  column,            //!< 1:6, the same faces from top to bottom
  horizontal_cross,  //!< 4:3, left, front, right and back in the middle row, top and bottom above and below front
  vertical_cross,  //!< 3:4, left, front and right in the second row; top, bottom, and back upside down in the middle column
  openexr          //!< 1:6, OpenEXR's envmap of type cube
};

//! Returns the layout of an image from its shape; nothing if none fits. `openexr_cube` is true if
//! the file's metadata states such an environment map.
std::optional<CubeMapLayout> cube_map_layout(int width, int height, bool openexr_cube);

//! Returns the width and height of an image in faces.
std::array<int, 2> faces_of(CubeMapLayout layout);

//! Returns true if each cell of a cross that contains no face has a single color, within JPEG
//! errors. Images of the same shape that are not cube maps have content there. Always true for
//! layouts other than crosses.
bool has_plain_corners(const EnvironmentImage& image, CubeMapLayout layout);

//! Resamples a cube map to an equirectangular image of `width` x `width` / 2 texels, bilinearly
//! within each face. The front face is in the middle, the right face to its right. Source: OpenGL
//! 4.6, table 8.19; OpenEXR, "Environment Maps" (ImfEnvmap).
EnvironmentImage equirectangular_from_cube(const EnvironmentImage& cube, CubeMapLayout layout, int width);

}  // namespace ergodome
