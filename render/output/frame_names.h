#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "render/frame/show_renderer.h"

namespace ergodome {

//! Folder of an eye's own files: L, R; empty for what is no single eye's.
std::filesystem::path eye_folder(FramePart part);

//! Path of a numbered frame inside the output folder: NAME_000001.png counted from 1; separate eyes in L/ and R/; sequences of more than
//! 10,000 frames in folders NAME_000001_010,000 (domemaster convention); a cube's faces NAME_000001_px.png (see cube_face_name). `index`
//! counts from 0.
std::filesystem::path frame_path(const std::string& name, int index, int frames_in_show, FramePart part,
                                 const std::string& ending, std::optional<CubeFace> face = std::nullopt);

}  // namespace ergodome
