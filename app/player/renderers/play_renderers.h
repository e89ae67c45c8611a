#pragma once

#include <memory>
#include <string>

#include "app/cli/lens_options.h"
#include "app/player/note_board.h"
#include "app/player/renderers/renderer_loader.h"

namespace ergodome {

//! How the renderers of a player's shows are made.
struct RendererWish {
  Backend backend;
  bool may_fall_back;  //!< to the CPU, where the GPU is lost
  LensOptions lens;
  int size_px;
  bool tells_misses;  //!< notes say what of a show its trajectory is too coarse for
  std::shared_ptr<NoteBoard> notes;
  std::string language;  //!< that somebody asked for, or none
};

//! Makes a show's renderer, with the stream of its trajectory, and posts what is to be known of both. Throws Error where it cannot be made.
RendererLoader::Make renderer_maker(const RendererWish& wish);

//! `make`, but for the first time that the show of this name is asked for: then `first`, which something was measured with, serves.
RendererLoader::Make with_first(RendererLoader::Make make, const std::string& name,
                                std::shared_ptr<ShowRenderer> first);

}  // namespace ergodome
