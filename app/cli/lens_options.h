#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/cli/option_checks.h"
#include "content/show/show.h"
#include "render/lens/lens_source.h"
#include "render/lens/stations/station_stream.h"

namespace CLI {
class App;
}

namespace ergodome {

//! Options that choose the source of a show's lenses.
struct LensOptions {
  std::string lens = "auto";
  std::string trajectory;  //!< file; empty: NAME.trajectory in the show's folder, if it exists
  std::optional<int> stream_memory_mib;
};

constexpr int usual_stream_memory_mib = 256;

//! Adds --lens, --trajectory and --stream-memory to a command, and registers that the last two have
//! no effect with --lens live or direct. `options` must outlive both.
void add_lens_options(CLI::App& command, LensOptions& options, IgnoredOptions& ignored);

LensChoice lens_choice(const LensOptions& options);

//! A function that receives a note for the user.
using NoteSink = std::function<void(const std::string&)>;

//! Prints a note on stderr unless this function has printed the same text before. Thread-safe.
void print_note_once(const std::string& note);

//! Opens the stream of a show's baked stations. Returns null if there is no trajectory or the
//! choice needs none. Throws Error if --trajectory or --lens streamed asks for one that is missing
//! or cannot be used; otherwise an unusable one in the show's folder is skipped with a note.
//! `report` is also called from the stream's thread, for stations that cannot be read.
std::shared_ptr<StationStream> open_stream(const Show& show, const LensOptions& options, Backend backend,
                                           NoteSink report = print_note_once);

//! Throws UsageError if a memory limit for streamed stations is given but the show has no
//! trajectory to stream.
void require_used_memory(const Show& show, const LensOptions& options);

//! Returns whether the stations of a trajectory keep the show's budget in pictures of this width
//! (0: the show's).
bool is_fine_enough(const StationStream& stream, const Show& show, int size_px);

//! Returns at most one note on a stream for pictures of this width (0: the show's): that it is too
//! coarse and what is used instead, that parts of it exceed the budget, or that stereo model omni
//! does not use it although it was asked for. Empty if there is no stream.
std::vector<std::string> stream_notes(const StationStream* stream, const Show& show, const LensOptions& options,
                                      Backend backend, int size_px);

//! Prints statistics of a stream.
void print_statistics(const StreamStatistics& statistics);

//! Adds --budget to a command: words for parse_budget(). The option may be repeated, each time with
//! one word.
void add_budget_option(CLI::App& command, std::vector<std::string>& words);

}  // namespace ergodome
