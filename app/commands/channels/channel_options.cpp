#include "app/commands/channels/channel_options.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <vector>

#include "app/cli/usage_error.h"
#include "kernels/core/error.h"
#include "render/channels/channel_names.h"
#include "render/eyes/view_projection.h"
#include "render/output/frame_files.h"
#include "render/output/stereo_layout.h"

namespace ergodome {

namespace {

std::vector<std::string> format_choices() {
  std::vector<std::string> choices = image_format_names();
  choices.emplace_back("fits");
  return choices;
}

//! Returns whether a list of channels includes the light of the picture.
bool asks_for_light(const std::string& channels) {
  const std::vector<ChannelGroup> groups = channel_groups(channels);
  return std::ranges::find(groups, ChannelGroup::color) != groups.end();
}

//! Returns what is wrong with a list of channels; empty if it is valid.
std::string problem_of_channels(const std::string& list) {
  try {
    static_cast<void>(channel_groups(list));
  } catch (const Error& problem) {
    return fmt::format("{}; {}", problem.problem(), problem.remedy());
  }
  return "";
}

}  // namespace

CLI::Option* add_format_option(CLI::App& command, RenderOptions& options) {
  return command
      .add_option("--format", options.format,
                  "png (8 bits), png16, tiff (16 bits) or exr (linear light); with --channels: exr or fits")
      ->check(CLI::IsMember(format_choices()))
      ->capture_default_str();
}

void add_channel_option(CLI::App& command, RenderOptions& options) {
  command
      .add_option("--channels", options.channels,
                  fmt::format("write these values for each pixel instead of pictures, separated by commas: {}",
                              fmt::join(channel_group_names(), ", ")))
      ->type_name("LIST")
      ->check(problem_of_channels);
}

void add_channel_rules(const std::shared_ptr<RenderOptions>& options, IgnoredOptions& ignored) {
  ignored.add("with --channels, which writes values of one eye and no pictures",
              [options] { return !options->channels.empty(); },
              {"--view", "--view-range", "--method", "--alpha", "--movie", "--pattern", "--setup", "--budget",
               "--check", "--tint-eyes", "--baseline", "--verify", "--no-summary", "--meter", "--light"});
  ignored.add("with --channels without color",
              [options] { return !options->channels.empty() && !asks_for_light(options->channels); },
              {"--backend", "--lens", "--trajectory", "--stream-memory", "--objects", "--language"});
}

void choose_number_format(RenderOptions& options, bool format_is_given) {
  if (!options.channels.empty() && !format_is_given) {
    options.format = "exr";
  }
  if (options.channels.empty() && options.format == "fits") {
    throw UsageError("--format fits", "is only for pixel values", "add --channels, for instance --channels g,sky");
  }
}

void require_channels(const RenderOptions& options, const Show& show) {
  const std::string option = "--channels " + options.channels;
  if (options.format != "exr" && options.format != "fits") {
    throw UsageError("--format " + options.format, "cannot store floating-point values, which --channels writes",
                     "choose --format exr or fits");
  }
  if (options.compression == "dwaa") {
    throw UsageError("--compression dwaa", "is lossy and would change the values of --channels", "choose zip or none");
  }
  if (eye_count(show.stereo) > 1) {
    throw UsageError(option, "writes values of one eye, but the show has two", "add --stereo mono");
  }
  if (has_face_files(show.view)) {
    throw UsageError(option, "writes one file per frame, but cube_layout = \"faces\" needs six",
                     "choose another --projection, or cube_layout = \"cross\" in the show");
  }
  const std::vector<ChannelGroup> groups = channel_groups(options.channels);
  if (!show.disk && std::ranges::any_of(groups, is_of_disk)) {
    throw UsageError(option, show.name + " has no disk", "add a [disk] table to the show, or omit the disk channels");
  }
}

}  // namespace ergodome
