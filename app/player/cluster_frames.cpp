#include "app/player/cluster_frames.h"

#include <fmt/format.h>

#include <cmath>

#include "app/playback/show_reload.h"
#include "content/files/fingerprint.h"
#include "content/show/reading/show_reader.h"

namespace ergodome {

ClusterFrame cluster_frame(const PictureRequest& request, double rate) {
  const PlayerFrame& frame = request.frame;
  ClusterFrame sent;
  sent.time_ns = std::llround(1e9 * frame.time_s);
  sent.on_path = frame.path_time_s.has_value();
  sent.rate = rate;
  sent.pose = frame.pose;
  sent.motion = frame.observer.motion;
  sent.velocity = frame.observer.velocity;
  sent.mode = frame.mode;
  sent.field_of_view_deg = frame.field_of_view_deg;
  sent.stereo = frame.stereo;
  sent.exposure_stops = frame.exposure_stops;
  sent.followed_stops = request.renderer ? request.renderer->followed_stops() : std::nullopt;
  sent.language = frame.language;
  sent.captions = frame.captions;
  sent.size_px = request.size_px;
  sent.projectors_px = request.output.projectors_px;
  if (request.quality) {
    sent.quality = ClusterQuality{request.quality->budget_px, static_cast<std::int32_t>(request.quality->lens),
                                  request.quality->filter, request.whole_px};
  }
  return sent;
}

void apply(const ClusterFrame& frame, PictureRequest& request) {
  // Long, but not forever: without a limit, pictures are computed as for films.
  constexpr double patience_s = 1e5;
  PlayerFrame& shown = request.frame;
  shown.time_s = 1e-9 * static_cast<double>(frame.time_ns);
  shown.path_time_s = frame.on_path ? std::optional(shown.time_s) : std::nullopt;
  shown.pose = frame.pose;
  shown.observer.motion = frame.motion;
  shown.observer.velocity = frame.velocity;
  shown.mode = frame.mode;
  shown.field_of_view_deg = frame.field_of_view_deg;
  shown.stereo = frame.stereo;
  shown.exposure_stops = frame.exposure_stops;
  shown.language = frame.language;
  shown.captions = frame.captions;
  request.size_px = frame.size_px;
  request.output.projectors_px = frame.projectors_px;
  request.patience_s = patience_s;
  request.quality.reset();
  if (frame.quality) {
    request.quality =
        FrameQuality{frame.quality->budget_px, static_cast<LensChoice>(frame.quality->lens), frame.quality->filter};
    request.whole_px = frame.quality->whole_px;
  }
}

std::string show_fingerprint(const Show& show) { return fingerprint(to_toml(show)); }

std::string content_fingerprint(const Show& show) {
  std::string all;
  const std::filesystem::path own = file_of(show);
  for (const std::filesystem::path& file : files_of(own, show)) {
    if (file == own) {
      continue;
    }
    std::error_code problem;
    const std::uintmax_t bytes = std::filesystem::file_size(file, problem);
    const bool large = !problem && bytes > max_hashed_bytes;
    all += fmt::format("{}:{};", large ? bytes : 0,
                       large ? fingerprint_of_start(file, max_hashed_bytes) : fingerprint_of_file(file));
  }
  return fingerprint(all);
}

}  // namespace ergodome
