#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/cli/idle_options.h"
#include "content/show/show.h"
#include "render/lens/lens_source.h"
#include "render/lens/stations/station_stream.h"

namespace CLI {
class App;
}

namespace ergodome {

//! Where the lenses of a show come from, as a person chooses it.
struct LensOptions {
  std::string lens = "auto";
  std::string trajectory;  //!< file; empty: the show's own name with .trajectory beside it, if it is there
  std::optional<int> stream_memory_mib;
};

constexpr int usual_stream_memory_mib = 256;

//! Adds --lens, --trajectory and --stream-memory to a command, and to its idle options where they change nothing. `options` outlive both.
void add_lens_options(CLI::App& command, LensOptions& options, IdleOptions& idle);

LensChoice lens_choice(const LensOptions& options);

//! Takes a sentence for the person who watches.
using Tell = std::function<void(const std::string&)>;

//! Writes it on the terminal; what was written there before is not said again. From any thread.
void tell_on_terminal(const std::string& note);

//! The stream of the show's baked stations; none where there is no trajectory or the choice needs none. Throws Error where a trajectory
//! that was asked for cannot be used; one that is merely found beside the show is then left alone, with a word about it. `tell` is called from the
//! stream's thread, too, for stations that cannot be read.
std::shared_ptr<StationStream> open_stream(const Show& show, const LensOptions& options, Backend backend,
                                           Tell tell = tell_on_terminal);

//! Throws UsageError where most memory for streamed stations is given, and nothing of the show's is streamed: there is no trajectory.
void require_used_memory(const Show& show, const LensOptions& options);

//! Whether stations of a trajectory hold the show's budget in pictures of a width (0: the show's own).
bool is_fine_enough(const StationStream& stream, const Show& show, int size_px);

//! What is to be known of a stream for pictures of a width (0: the show's own) that a backend makes: that it is too coarse for them, and what becomes of
//! that, or that some of what it is used for misses the budget. None where there is no stream.
std::vector<std::string> stream_notes(const StationStream* stream, const Show& show, const LensOptions& options,
                                      Backend backend, int size_px);

//! Prints what a stream has done.
void print_statistics(const StreamStatistics& statistics);

}  // namespace ergodome
