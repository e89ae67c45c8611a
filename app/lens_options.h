#pragma once

#include <memory>
#include <string>

#include "content/show.h"
#include "render/lens/lens_source.h"
#include "render/lens/station_stream.h"

namespace CLI {
class App;
}

namespace ergodome {

//! Where the lenses of a show come from, as a person chooses it.
struct LensOptions {
  std::string lens = "auto";
  std::string trajectory;  //!< file; empty: the show's own name with .trajectory beside it, if it is there
  int stream_memory_mib = 256;
};

//! Adds --lens, --trajectory and --stream-memory to a command.
void add_lens_options(CLI::App& command, LensOptions& options);

LensChoice lens_choice(const LensOptions& options);

//! The stream of the show's baked stations; none where there is no trajectory or the choice needs none. Throws Error where a trajectory
//! that was asked for cannot be used; one that is merely found beside the show is then left alone, with a word about it.
std::shared_ptr<StationStream> open_stream(const Show& show, const LensOptions& options, Backend backend);

//! Whether stations of a trajectory hold the show's budget in pictures of a width (0: the show's own).
bool is_fine_enough(const StationStream& stream, const Show& show, int size_px);

//! Says on the terminal where they do not, and what becomes of that; nothing where there is no stream.
void tell_coarse_stream(const StationStream* stream, const Show& show, const LensOptions& options, int size_px);

//! Prints what a stream has done.
void print_statistics(const StreamStatistics& statistics);

}  // namespace ergodome
