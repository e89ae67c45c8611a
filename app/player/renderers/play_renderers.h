#pragma once

#include <memory>
#include <string>

#include "app/cli/lens_options.h"
#include "app/player/renderers/note_board.h"
#include "app/player/renderers/renderer_loader.h"

namespace ergodome {

//! How to make the renderers of a player's shows.
struct RendererWish {
  Backend backend;
  bool may_fall_back;  //!< use the CPU if the GPU is lost
  LensOptions lens;
  int size_px;
  bool reports_misses;  //!< add notes on parts of a show for which its trajectory is too coarse
  std::shared_ptr<NoteBoard> notes;
  std::string language;  //!< requested language; empty: none
};

//! Returns a function that makes a show's renderer with the stream of its trajectory, and posts
//! notes about both. That function throws Error if the renderer cannot be made.
RendererLoader::Make renderer_maker(const RendererWish& wish);

//! Wraps `make`: for the first request of the show with this name, returns `first`, which already
//! exists because it was used for a measurement.
RendererLoader::Make with_first(RendererLoader::Make make, const std::string& name,
                                std::shared_ptr<ShowRenderer> first);

}  // namespace ergodome
