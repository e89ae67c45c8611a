#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>

#include "app/cli/commands.h"
#include "app/cli/interrupt.h"
#include "app/cli/option_checks.h"
#include "app/cli/progress.h"
#include "app/cli/show_loading.h"
#include "app/cli/show_options.h"
#include "app/commands/channels/channel_frames.h"
#include "app/commands/channels/channel_options.h"
#include "app/commands/render/frame_check.h"
#include "app/commands/render/frame_request.h"
#include "app/commands/render/frame_writer.h"
#include "app/commands/render/light_meter.h"
#include "app/commands/render/numbered_frames.h"
#include "app/commands/render/pattern_frames.h"
#include "app/commands/render/render_arguments.h"
#include "app/commands/render/render_budget.h"
#include "app/commands/render/render_request.h"
#include "content/files/atomic_file.h"
#include "content/files/console.h"
#include "content/files/printable.h"
#include "kernels/core/error.h"
#include "render/patterns/test_pattern.h"

namespace ergodome {

namespace {

int write_patterns(const RenderOptions& options, const Show& show, const std::optional<DomeSetup>& setup) {
  if (setup) {
    return write_pattern_frames({options.pattern, show.stereo.layout, options.size_px, options.out}, *setup);
  }
  require_file_layout(options, show);
  return write_pattern_frames({options.pattern, options.out, format_of(options), options.size_px}, show);
}

//! Writes the metadata summary of frames [first, last]. Writes none for projectors, for an empty
//! range, and with --no-summary.
void write_metadata(const RenderOptions& options, const FrameWriter& writer, int first, int last) {
  if (options.setup.empty() && last >= first && !options.no_summary) {
    writer.files().write_metadata(first, last);
  }
}

void report_frames(const RenderOptions& options, const FrameWriter& writer) {
  const int there = writer.resumed();
  const std::string again =
      writer.renewed() > 0 ? fmt::format(" ({} replaced, rendered with other options before)", writer.renewed()) : "";
  print_out("{} in {}{}{}\n", counted(writer.written(), "frame"), options.out, again,
            there > 0 ? fmt::format("; skipped {} from an earlier run", counted(there, "frame")) : "");
}

//! Ends an interrupted run: writes the metadata summary of the finished frames [first, last], and
//! throws Error.
[[noreturn]] void stop(const RenderOptions& options, const FrameWriter& writer, int first, int last) {
  std::string unwritten;
  try {
    // Written even after an interruption, because the summary that an earlier run left may describe
    // other frames than [first, last].
    write_metadata(options, writer, first, last);
  } catch (const Error& problem) {
    unwritten = fmt::format(" (and {})", problem.what());
  }
  throw Error("render", fmt::format("stopped after {}{}", counted(writer.written(), "frame"), unwritten),
              "continue with --resume");
}

void report_other_frames(const RenderOptions& options, const FrameWriter& writer, int first, int last) {
  if (options.no_summary) {
    return;
  }
  if (const std::vector<int> others = writer.files().asked_otherwise(first, last); !others.empty()) {
    print_out("the folder also contains {} rendered with other options ({})\n", counted(others.size(), "frame"),
              frame_ranges(others));
  }
}

void write_frames(const RenderOptions& options, FrameWriter& writer, int first, int last) {
  if (const std::string note = writer.early_room_note(first, last); !note.empty()) {
    print_note("{}", note);
  }
  Progress progress("rendering", last - first + 1);
  for (int frame = first; frame <= last; ++frame) {
    if (interrupted()) {
      stop(options, writer, first, frame - 1);
    }
    writer.write(frame);
    for (const std::string& note : writer.run_notes(frame + 1, last)) {
      progress.clear();
      print_note("{}", note);
    }
    progress.advance_to(frame - first + 1);
  }
  write_metadata(options, writer, first, last);
  report_frames(options, writer);
  report_other_frames(options, writer, first, last);
}

//! Checks frames [first, last] and writes their metadata summary. Throws Error if frames are missing,
//! damaged or rendered with other options.
void verify_frames(const RenderOptions& options, const FrameWriter& writer, int first, int last) {
  const std::vector<int> lacking = lacking_frames(writer.files(), first, last);
  if (!lacking.empty()) {
    throw Error(options.out,
                fmt::format("{} missing, damaged or rendered with other options ({})",
                            counted(lacking.size(), "frame is", "frames are"), frame_ranges(lacking)),
                "render them with --resume");
  }
  write_metadata(options, writer, first, last);
  print_out("{} in {} verified\n", counted(last - first + 1, "frame"), options.out);
}

void write_channels(const RenderOptions& options, const Show& show) {
  require_channels(options, show);
  const auto [first, last] = chosen_frames(options, show);
  write_channel_frames(options, show, FrameRequests(options, show, std::nullopt), first, last);
}

void run(RenderOptions options) {
  Show show = chosen_show(options);
  const std::optional<DomeSetup> setup = chosen_setup(options);
  fit_to_chosen_setup(options, setup, show);
  if (!options.pattern.empty()) {
    const int files = write_patterns(options, show, setup);
    print_out("{} in {}\n", counted(files, "file"), options.out);
    return;
  }
  require_features(show);
  require_used_options(options, show);
  if (!options.channels.empty()) {
    return write_channels(options, show);
  }
  require_metering(options, show);
  prepare_frames(options, show);
  const auto [first, last] = chosen_frames(options, show);
  // Computed before the budget is applied: its choices depend on measured times, which differ in
  // each run.
  const FrameRequests requests(options, show, setup);
  if (!use_render_budget(options, show, setup)) {
    return;
  }
  if (!options.movie.empty()) {
    // Partial films of earlier runs are removed first, because the frames may need the space.
    remove_abandoned_files(std::filesystem::path(options.movie).parent_path());
  }
  FrameWriter writer(options, show, setup, requests);
  if (!options.meter.empty()) {
    return meter_frames(options, writer, first, last);
  }
  if (options.verify) {
    verify_frames(options, writer, first, last);
  } else {
    write_frames(options, writer, first, last);
  }
  if (!options.movie.empty()) {
    writer.write_movies(first, last);
    if (options.delete_frames) {
      writer.delete_frames();
    }
  }
  if (const auto streamed = writer.stream_statistics()) {
    print_statistics(*streamed);
  }
  if (writer.files().unresolved() > 0) {
    print_note("rays of {} did not converge; {} the mean color of the sky",
               counted(writer.files().unresolved(), "pixel"),
               writer.files().unresolved() == 1 ? "it shows" : "they show");
  }
}

//! Registers the options that have no effect on projector frames, test patterns or checks.
void add_ignored_options(const std::shared_ptr<RenderOptions>& options, IgnoredOptions& ignored) {
  ignored.add("with --pattern", [options] { return !options->pattern.empty(); },
              {"--frames", "--from", "--to", "--movie", "--delete-frames", "--fps", "--view", "--view-range",
               "--method", "--budget", "--check", "--resume", "--baseline", "--language", "--objects", "--backend",
               "--lens", "--trajectory", "--stream-memory"});
  ignored.add("without a show", [options] { return options->show.empty(); }, {"--set"});
  ignored.add("with --pattern for one eye",
              [options] {
                const bool mono = options->stereo.empty() ? options->show.empty() : options->stereo == "mono";
                return !options->pattern.empty() && mono;
              },
              {"--tint-eyes"});
  const std::initializer_list<const char*> of_chunks = {"--verify", "--no-summary", "--meter", "--light"};
  ignored.add(
      "with --pattern", [options] { return !options->pattern.empty(); }, of_chunks);
  ignored.add(
      "with --check", [options] { return options->checked_moments > 0; }, of_chunks);
  ignored.add("with --verify, which renders nothing", [options] { return options->verify; },
              {"--resume", "--delete-frames", "--no-summary"});
  ignored.add("with --meter, which writes no frames", [options] { return !options->meter.empty(); },
              {"--resume", "--movie", "--delete-frames", "--verify", "--no-summary", "--light"});
  ignored.add("with --check, which writes no frames", [options] { return options->checked_moments > 0; },
              {"--frames", "--from", "--to", "--movie", "--delete-frames", "--format", "--compression", "--alpha",
               "--resume", "--language"});
}

//! Returns the values that --pattern accepts.
std::vector<std::string> pattern_choices() {
  std::vector<std::string> choices = test_pattern_names();
  choices.emplace_back("all");
  return choices;
}

//! Adds the options that only `render` has.
void add_own_options(CLI::App& command, RenderOptions& options) {
  command.option_defaults()->group("Files");
  command
      .add_flag("--delete-frames", options.delete_frames,
                "with --movie: delete this run's frames once the film is complete and checked")
      ->needs(command.get_option("--movie"));
  command.option_defaults()->group("Heat maps and pixel values");
  add_channel_option(command, options);
  command.option_defaults()->group("Domes");
  command
      .add_option("--pattern", options.pattern, "write a test pattern, or all of them, instead of the show's frames")
      ->check(CLI::IsMember(pattern_choices()));
  command.option_defaults()->group("Computation");
  command
      .add_option("--check", options.checked_moments,
                  "with --budget: measure the error at N random times of the show, and write no frames")
      ->check(CLI::Range(1, 1000));
  command.option_defaults()->group("Several machines");
  command.add_flag("--verify", options.verify,
                   "check that all chosen frames are complete and rendered with these options; render nothing");
  command.add_flag("--no-summary", options.no_summary, "write no summary of the frames, for a part of a film");
  command
      .add_option("--meter", options.meter,
                  "measure the frames' light for automatic exposure, write it to DIR, and write no frames")
      ->type_name("DIR");
  command
      .add_option("--light", options.light, "follow automatic exposure from the light that --meter has written to DIR")
      ->type_name("DIR");
}

}  // namespace

void add_render_command(CLI::App& app) {
  auto options = std::make_shared<RenderOptions>();
  CLI::App* command = app.add_subcommand("render", "Render a show to numbered frames, without a window");
  command->add_option("show", options->show, "show file (.toml) or name of a built-in show");
  add_set_option(*command, options->set);
  command->add_option("--out", options->out, "folder for the frames")->type_name("DIR")->capture_default_str();
  command->add_option("--size", options->size_px, "width of one eye's image in pixels (default: the show's)")
      ->check(CLI::Range(1, 16384));
  command->add_flag("--resume", options->resume,
                    "skip complete frames that were rendered with the same show and options");
  IgnoredOptions ignored(*command);
  CLI::Option* const format = add_film_options(*command, *options, ignored);
  add_own_options(*command, *options);
  add_ignored_options(options, ignored);
  add_channel_rules(options, ignored);
  command->callback([options, ignored, format] {
    choose_number_format(*options, format->count() > 0);
    ignored.refuse();
    run(*options);
  });
}

}  // namespace ergodome
