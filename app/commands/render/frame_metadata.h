#pragma once

#include <optional>

#include "render/frame/show_renderer.h"
#include "render/output/image_writer.h"

namespace ergodome {

//! Properties of one file of a frame that its metadata contains.
struct FrameFile {
  int frame = 0;          //!< counted from 0
  double baseline = 0.0;  //!< the baseline that was applied, which may be reduced [M]
  FramePart part = FramePart::whole;
  std::optional<CubeFace> face{};
  ViewMode mode = ViewMode::sky;
};

//! Returns the metadata of a frame's file. `show` must be evaluated at the time of the frame.
FrameMetadata frame_metadata(const Show& show, const FrameFile& file);

}  // namespace ergodome
