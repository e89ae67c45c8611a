#include "app/commands/render/render_request.h"

#include <fmt/format.h>

#include <algorithm>

#include "app/cli/setup_show.h"
#include "app/cli/show_loading.h"
#include "app/cli/usage_error.h"
#include "app/commands/channels/heat_map_options.h"
#include "app/commands/render/frame_range.h"
#include "app/commands/render/movie_plan.h"
#include "app/playback/playback.h"
#include "content/files/console.h"
#include "render/output/image_writer.h"

namespace ergodome {

namespace {

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

}  // namespace

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

void fit_to_chosen_setup(const RenderOptions& options, const std::optional<DomeSetup>& setup, Show& show) {
  if (!setup) {
    return;
  }
  const double tilt_deg = show.view.tilt_deg;
  fit_to_setup(show, *setup, options.stereo);
  if (show.view.tilt_deg != tilt_deg && !options.show.empty()) {
    print_note("using the setup's tilt of {:g} deg instead of the show's {:g}; override it with --tilt",
               show.view.tilt_deg, tilt_deg);
  }
}

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

void require_used_options(const RenderOptions& options, const Show& show) {
  static_cast<void>(follow_method(options.method, options.view, show));
  static_cast<void>(view_range(options.view_range, view_mode(options.view), !options.method.empty()));
  require_two_eyes(show, "--baseline", options.baseline.has_value());
  require_two_eyes(show, "--tint-eyes", options.tint_eyes);
  require_used_memory(show, options.lens);
  const bool narrated =
      std::ranges::any_of(show.timeline.audio, [](const AudioTrack& track) { return !track.language.empty(); });
  if (!options.language.empty() && !frames_show_language(show) && (options.movie.empty() || !narrated)) {
    throw UsageError("--language " + options.language,
                     fmt::format("has no effect: {} has no captions{}, no readout and no title in several languages",
                                 show.name, options.movie.empty() ? "" : ", no narration"),
                     "leave it out");
  }
}

void prepare_frames(const RenderOptions& options, Show& show) {
  report_equal_eyes(show);
  require_file_layout(options, show);
  require_movie(options, show);
  report_movie_losses(options, show);
  report_language(options, show);
  // Files store the title in one language.
  show.title = {{"", text_in(show.title, options.language)}};
}

bool follows_exposure(const RenderOptions& options, const Show& show) {
  return show.tone.automatic && options.format != "exr" && view_mode(options.view) == ViewMode::sky;
}

bool frames_show_language(const Show& show) {
  const bool titled = std::ranges::any_of(show.title, [](const auto& each) { return !each.first.empty(); });
  return titled || show.readout || !show.timeline.captions.empty();
}

std::pair<int, int> chosen_frames(const RenderOptions& options, const Show& show) {
  return options.frames.empty() ? frames_between(options.from, options.to, show)
                                : frame_range(options.frames, frame_count(show));
}

}  // namespace ergodome
