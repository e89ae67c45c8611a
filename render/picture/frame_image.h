#pragma once

#include <optional>

#include "kernels/projection/projection.h"
#include "render/picture/picture.h"

namespace ergodome {

//! The part of a frame that an image is.
enum class FramePart { whole, left, right };

//! An image to show or to write: linear light, four floats per pixel.
struct FrameImage {
  FramePart part = FramePart::whole;
  Picture picture;
  std::optional<CubeFace> face{};  //!< the face of a cube, if each face has a file
};

}  // namespace ergodome
