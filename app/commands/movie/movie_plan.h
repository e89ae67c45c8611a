#pragma once

#include <filesystem>

#include "app/commands/render/frame_writer.h"
#include "render/frame/show_renderer.h"

namespace ergodome {

//! Throws Error where no film could be made of the frames that are asked for, or none written, before any is rendered. Nothing is wrong where none is asked for.
void require_movie(const RenderOptions& options, const Show& show);

//! Says on the terminal what of the eyes is lost in the film that is asked for.
void tell_movie_losses(const RenderOptions& options, const Show& show);

//! The film of a part of the frames: eyes of the layout `separate` have one each, FILE_L and FILE_R.
std::filesystem::path movie_path(const std::filesystem::path& file, FramePart part);

//! The parts that have films of their own.
std::vector<FramePart> movie_parts(const Show& show);

}  // namespace ergodome
