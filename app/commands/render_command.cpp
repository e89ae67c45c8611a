#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <memory>

#include "app/cli/backend_choice.h"
#include "app/cli/commands.h"
#include "app/cli/interrupt.h"
#include "app/cli/option_checks.h"
#include "app/cli/progress.h"
#include "app/cli/show_loading.h"
#include "app/cli/show_options.h"
#include "app/cli/usage_error.h"
#include "app/commands/channels/channel_frames.h"
#include "app/commands/channels/channel_options.h"
#include "app/commands/channels/heat_map_options.h"
#include "app/commands/render/frame_range.h"
#include "app/commands/render/frame_request.h"
#include "app/commands/render/frame_writer.h"
#include "app/commands/render/movie_plan.h"
#include "app/commands/render/numbered_frames.h"
#include "app/commands/render/pattern_frames.h"
#include "app/commands/render/render_budget.h"
#include "app/playback/playback.h"
#include "content/files/atomic_file.h"
#include "content/files/console.h"
#include "content/files/printable.h"
#include "content/show/animatable_number.h"
#include "kernels/core/error.h"
#include "render/frame/show_renderer.h"
#include "render/output/image_writer.h"
#include "render/patterns/test_pattern.h"

namespace ergodome {

namespace {

//! Throws UsageError if files of the chosen format cannot hold the show's stereo layout.
void require_file_layout(const RenderOptions& options, const Show& show) {
  if (show.stereo.layout == StereoLayout::multiview && options.format != "exr") {
    throw UsageError("stereo layout multiview", "writes two views to one file, which only EXR supports",
                     "add --format exr");
  }
  if (show.stereo.layout == StereoLayout::quad_buffer) {
    throw UsageError("stereo layout quad_buffer", "is only for windows",
                     "choose another layout, for instance --stereo side_by_side");
  }
}

//! Loads the show and applies the options of the command line. Patterns without a show use a dome
//! of 180°.
Show chosen_show(const RenderOptions& options) {
  if (options.show.empty() && options.pattern.empty()) {
    throw UsageError("render", "has nothing to render", "name a show file or a built-in show, or add --pattern");
  }
  Show show = options.show.empty() ? Show{} : load_show(options.show, options.set);
  apply_overrides(show, options, !options.setup.empty());
  show.view.from_outside = show.view.from_outside || options.from_outside;
  show.stereo.tint_eyes = show.stereo.tint_eyes || options.tint_eyes;
  if (options.frame_rate_hz > 0.0) {
    show.frame_rate_hz = options.frame_rate_hz;
  }
  return show;
}

//! Returns the dome setup if frames for its projectors are requested.
std::optional<DomeSetup> chosen_setup(const RenderOptions& options) {
  if (options.setup.empty()) {
    return std::nullopt;
  }
  if (options.format != "png" || options.alpha || !options.movie.empty()) {
    throw UsageError("--setup " + options.setup, "writes only 8-bit PNG files for projectors",
                     "leave out --format, --alpha and --movie");
  }
  return read_dome_setup(options.setup);
}

//! Throws UsageError if an option has no effect on this show, or if --view-range is malformed.
void require_used_options(const RenderOptions& options, const Show& show) {
  static_cast<void>(follow_method(options.method, options.view, show));
  static_cast<void>(view_range(options.view_range, view_mode(options.view), !options.method.empty()));
  require_two_eyes(show, "--baseline", options.baseline.has_value());
  require_two_eyes(show, "--tint-eyes", options.tint_eyes);
  require_used_memory(show, options.lens);
  const bool narrated =
      std::ranges::any_of(show.timeline.audio, [](const AudioTrack& track) { return !track.language.empty(); });
  const bool titled = std::ranges::any_of(show.title, [](const auto& each) { return !each.first.empty(); });
  if (!options.language.empty() && !titled && !show.readout && show.timeline.captions.empty() &&
      (options.movie.empty() || !narrated)) {
    throw UsageError("--language " + options.language,
                     fmt::format("has no effect: {} has no captions{}, no readout and no title in several languages",
                                 show.name, options.movie.empty() ? "" : ", no narration"),
                     "leave it out");
  }
}

void report_language(const RenderOptions& options, const Show& show) {
  Timeline heard;
  heard.captions = show.timeline.captions;
  if (!options.movie.empty()) {
    heard.audio = show.timeline.audio;
  }
  if (const std::string note = language_note(show.name, heard, options.language); !note.empty()) {
    print_note_once(note);
  }
}

int write_patterns(const RenderOptions& options, const Show& show, const std::optional<DomeSetup>& setup) {
  if (setup) {
    return write_pattern_frames({options.pattern, show.stereo.layout, options.size_px, options.out}, *setup);
  }
  require_file_layout(options, show);
  return write_pattern_frames({options.pattern, options.out, format_of(options), options.size_px}, show);
}

//! Writes the metadata summary of frames [first, last]. Writes none for projectors or an empty
//! range.
void write_metadata(const RenderOptions& options, const FrameWriter& writer, int first, int last) {
  if (options.setup.empty() && last >= first) {
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
  if (const std::vector<int> others = writer.files().asked_otherwise(first, last); !others.empty()) {
    print_out("the folder also contains {} rendered with other options ({})\n", counted(others.size(), "frame"),
              frame_ranges(others));
  }
}

void write_channels(const RenderOptions& options, const Show& show) {
  require_channels(options, show);
  const auto [first, last] = frame_range(options.frames, frame_count(show));
  write_channel_frames(options, show, FrameRequests(options, show, std::nullopt), first, last);
}

void run(RenderOptions options) {
  Show show = chosen_show(options);
  const std::optional<DomeSetup> setup = chosen_setup(options);
  if (setup) {
    const double tilt_deg = show.view.tilt_deg;
    fit_to_setup(show, *setup, options.stereo);
    if (show.view.tilt_deg != tilt_deg && !options.show.empty()) {
      print_note("using the setup's tilt of {:g} deg instead of the show's {:g}; override it with --tilt",
                 show.view.tilt_deg, tilt_deg);
    }
  }
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
  report_equal_eyes(show);
  require_file_layout(options, show);
  require_movie(options, show);
  report_movie_losses(options, show);
  report_language(options, show);
  // Files store the title in one language.
  show.title = {{"", text_in(show.title, options.language)}};
  const auto [first, last] = options.frames.empty() ? frames_between(options.from, options.to, show)
                                                    : frame_range(options.frames, frame_count(show));
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
  write_frames(options, writer, first, last);
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
  ignored.add("with --setup, which fixes the view", [options] { return !options->setup.empty(); }, {"--from-outside"});
  ignored.add("with --setup, which fixes the projection",
              [options] { return !options->setup.empty() && options->projection != "dome"; }, {"--projection"});
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
  ignored.add("without --format exr", [options] { return options->format != "exr"; }, {"--compression"});
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

void add_frame_choice(CLI::App& command, RenderOptions& options) {
  command.option_defaults()->group("Frames");
  CLI::Option* const frames =
      command.add_option("--frames", options.frames, std::string(frame_range_words) + " (default: all)")
          ->type_name("RANGE");
  command.add_option("--from", options.from, std::string("render from this time of the show on: ") + moment_words)
      ->type_name("TIME")
      ->excludes(frames);
  command.add_option("--to", options.to, "render frames before this time of the show, written like --from")
      ->type_name("TIME")
      ->excludes(frames);
  command.add_option("--fps", options.frame_rate_hz, "frames per second: 24, 29.97, 30000/1001 (default: the show's)")
      ->transform(frame_rate_between(0.1, 1000.0));
}

void add_picture_options(CLI::App& command, RenderOptions& options) {
  add_projection_options(command, options, "the setup's or the show's");
  command.add_flag("--from-outside", options.from_outside, "mirror the image, as a dome is seen from outside");
  add_objects_option(command, options);
  command.add_option("--language", options.language, "language of captions and narration, for instance en or de")
      ->type_name("TAG");
  add_stereo_options(command, options);
  command.add_flag("--tint-eyes", options.tint_eyes, "tint the left eye's image red and the right eye's cyan");
}

//! Adds the options of files and returns the option of their format.
CLI::Option* add_file_options(CLI::App& command, RenderOptions& options) {
  command.option_defaults()->group("Files");
  CLI::Option* const format = add_format_option(command, options);
  command
      .add_option("--compression", options.compression, "with EXR: zip, none, or dwaa, which is lossy (default: zip)")
      ->check(CLI::IsMember(exr_compression_names()));
  command.add_flag("--alpha", options.alpha, "add an alpha channel, opaque where the image is, as in a dome's circle");
  CLI::Option* const movie =
      command.add_option("--movie", options.movie, "also encode the frames with ffmpeg to FILE.mp4, .mov or .mkv")
          ->type_name("FILE")
          ->check([](const std::string& file) { return file.empty() ? "is empty; name a file" : ""; });
  command
      .add_flag("--delete-frames", options.delete_frames,
                "with --movie: delete this run's frames once the film is complete and checked")
      ->needs(movie);
  return format;
}

void add_measured_views(CLI::App& command, RenderOptions& options) {
  command.option_defaults()->group("Heat maps and pixel values");
  add_view_option(command, options.view);
  command
      .add_option("--view-range", options.view_range,
                  "MIN:MAX: values at the ends of a heat map's color scale, for instance 0.5:2")
      ->type_name("RANGE");
  add_method_option(command, options.method);
  add_channel_option(command, options);
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
  add_frame_choice(*command, *options);
  add_picture_options(*command, *options);
  CLI::Option* const format = add_file_options(*command, *options);
  add_measured_views(*command, *options);
  command->option_defaults()->group("Domes");
  command
      ->add_option("--setup", options->setup,
                   "dome setup (.toml): write each projector's frames as NAME_000001_PROJECTOR.png")
      ->type_name("FILE");
  command
      ->add_option("--pattern", options->pattern, "write a test pattern, or all of them, instead of the show's frames")
      ->check(CLI::IsMember(pattern_choices()));
  add_backend_option(*command, options->backend);
  IgnoredOptions ignored(*command);
  add_lens_options(*command, options->lens, ignored);
  add_budget_option(*command, options->budget);
  command
      ->add_option("--check", options->checked_moments,
                   "with --budget: measure the error at N random times of the show, and write no frames")
      ->check(CLI::Range(1, 1000));
  add_ignored_options(options, ignored);
  add_channel_rules(options, ignored);
  command->callback([options, ignored, format] {
    choose_number_format(*options, format->count() > 0);
    ignored.refuse();
    run(*options);
  });
}

}  // namespace ergodome
