#include "app/commands/render/render_arguments.h"

#include <CLI/CLI.hpp>

#include "app/cli/backend_choice.h"
#include "app/commands/channels/channel_options.h"
#include "app/commands/channels/heat_map_options.h"
#include "app/commands/render/frame_range.h"
#include "render/output/image_writer.h"

namespace ergodome {

namespace {

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
  command.add_option("--movie", options.movie, "also encode the frames with ffmpeg to FILE.mp4, .mov or .mkv")
      ->type_name("FILE")
      ->check([](const std::string& file) { return file.empty() ? "is empty; name a file" : ""; });
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
}

void add_domes(CLI::App& command, RenderOptions& options) {
  command.option_defaults()->group("Domes");
  command
      .add_option("--setup", options.setup,
                  "dome setup (.toml): write each projector's frames as NAME_000001_PROJECTOR.png")
      ->type_name("FILE");
}

//! Registers the options that have no effect with others of add_film_options().
void add_ignored_film_options(const RenderOptions& options, IgnoredOptions& ignored) {
  ignored.add("with --setup, which fixes the view", [&options] { return !options.setup.empty(); }, {"--from-outside"});
  ignored.add("with --setup, which fixes the projection",
              [&options] { return !options.setup.empty() && options.projection != "dome"; }, {"--projection"});
  ignored.add("without --format exr", [&options] { return options.format != "exr"; }, {"--compression"});
}

}  // namespace

CLI::Option* add_film_options(CLI::App& command, RenderOptions& options, IgnoredOptions& ignored) {
  add_frame_choice(command, options);
  add_picture_options(command, options);
  CLI::Option* const format = add_file_options(command, options);
  add_measured_views(command, options);
  add_domes(command, options);
  add_backend_option(command, options.backend);
  add_lens_options(command, options.lens, ignored);
  add_budget_option(command, options.budget);
  add_ignored_film_options(options, ignored);
  return format;
}

}  // namespace ergodome
