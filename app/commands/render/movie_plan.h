#pragma once

#include <filesystem>

#include "app/commands/render/frame_writer.h"
#include "render/frame/show_renderer.h"

namespace ergodome {

//! Throws Error before rendering if the frames cannot become a film, or if the film cannot be
//! written. Does nothing without --movie.
void require_movie(const RenderOptions& options, const Show& show);

//! Prints a note about stereo information that the film cannot store.
void report_movie_losses(const RenderOptions& options, const Show& show);

//! Returns the file of the film of a part of the frames. With the layout `separate`, each eye has
//! its own film: FILE_L and FILE_R.
std::filesystem::path movie_path(const std::filesystem::path& file, FramePart part);

//! Returns the parts of frames that have separate films.
std::vector<FramePart> movie_parts(const Show& show);

}  // namespace ergodome
