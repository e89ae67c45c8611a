#pragma once

#include <optional>

#include "render/frame/show_renderer.h"
#include "render/output/image_writer.h"

namespace ergodome {

//! A file of a frame, as its facts tell of it.
struct FrameFile {
  int frame = 0;          //!< counted from 0
  double baseline = 0.0;  //!< how far the eyes are apart [M]
  FramePart part = FramePart::whole;
  std::optional<CubeFace> face{};
  ViewMode mode = ViewMode::sky;
};

//! What a frame's file says of it. `show`: with its numbers as they are in that frame.
FrameMetadata frame_facts(const Show& show, const FrameFile& file);

}  // namespace ergodome
