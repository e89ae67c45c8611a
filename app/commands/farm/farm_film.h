#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/commands/farm/farm_options.h"
#include "app/commands/farm/farm_plan.h"
#include "app/commands/farm/film_bake.h"
#include "calibration/dome/dome_setup.h"
#include "content/show/show.h"

namespace ergodome {

//! A film with everything that its steps need.
struct FarmFilm {
  RenderOptions options;  //!< as the tasks will have them
  Show show;
  std::optional<DomeSetup> setup;
  FrameChunk frames;
  std::vector<std::string> words;  //!< options that change frames, as words of a command line
  std::optional<FilmBake> bake;
  int chunk = 1;
};

//! Loads and checks the show and chooses what is left open: the settings for --budget, the bake and
//! the size of chunks. Choices that depend on measured times are taken from an earlier run if the
//! film is the same, and stored unless `dry_run`. `words` are the given options of a film, without
//! those for the choice of frames, --movie, --language and --budget. Throws Error if the show cannot
//! be rendered so.
FarmFilm farm_film(FarmOptions& options, std::vector<std::string> words);

//! Returns the frames that are missing, damaged or rendered with other options, counted from 0.
//! Returns all frames if there is no frame yet, or if the trajectory is not baked yet.
std::vector<int> frames_to_render(const FarmFilm& film);

//! Returns the frames whose light must be measured for automatic exposure: none if it is not
//! automatic, otherwise all without a current measurement.
std::vector<int> frames_to_meter(const FarmFilm& film);

}  // namespace ergodome
