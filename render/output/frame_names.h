#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "render/picture/frame_image.h"

// Paths of frame files.

namespace ergodome {

//! Returns the folder for an eye's own files: L or R; empty if a file belongs to no single eye.
std::filesystem::path eye_folder(FramePart part);

//! Returns the path of a numbered frame inside the output folder: NAME_000001.png, counted from 1.
//! Separate eyes are in L/ and R/. Sequences of more than 10,000 frames are in folders
//! NAME_000001_010,000 (domemaster convention). A cube's faces are NAME_000001_px.png (see
//! cube_face_name). `index` counts from 0.
std::filesystem::path frame_path(const std::string& name, int index, int frames_in_show, FramePart part,
                                 const std::string& ending, std::optional<CubeFace> face = std::nullopt);

}  // namespace ergodome
