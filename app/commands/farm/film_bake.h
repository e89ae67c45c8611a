#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/commands/farm/farm_options.h"
#include "content/show/show.h"

namespace ergodome {

//! The trajectory of a film, which its tasks bake before the frames.
struct FilmBake {
  std::filesystem::path trajectory;  //!< its name contains a fingerprint of all that it depends on
  int parts = 1;
  std::vector<std::string> words;  //!< the command `bake` without --part
};

//! Decides whether a film is baked first. Returns nothing if it cannot be, if a trajectory exists, or
//! if options exclude it; with --bake PARTS, throws UsageError for the first reason. `frames` is the
//! number of frames in the film, from which the number of parts is chosen without --bake.
std::optional<FilmBake> film_bake(const FarmOptions& options, const Show& show, int frames);

}  // namespace ergodome
