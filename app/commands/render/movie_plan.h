#pragma once

#include <filesystem>

#include "app/commands/render/frame_writer.h"
#include "render/frame/show_renderer.h"

namespace ergodome {

//! Throws Error before rendering if the frames cannot become a film, or if the film cannot be
//! written. Does nothing without --movie.
void require_movie(const RenderOptions& options, const Show& show);

//! Prints a note if the film is an .mp4, whose halved color resolution blurs one eye, and the show
//! separates the eyes by color. Prints another one if the film is a panorama that gets no metadata
//! for VR headsets.
void report_movie_losses(const RenderOptions& options, const Show& show);

//! Returns the path of the film of a part of the frames: `file` for whole frames, with _L or _R
//! added to its stem for a single eye.
std::filesystem::path movie_path(const std::filesystem::path& file, FramePart part);

//! Returns the parts of frames that get a film each: the left and the right eye with the layout
//! `separate`, otherwise the whole frame.
std::vector<FramePart> movie_parts(const Show& show);

}  // namespace ergodome
