#include "app/player/cluster_frames.h"

#include <cmath>

#include "app/playback/show_reload.h"
#include "app/player/content_push.h"
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
  sent.before = request.before;
  sent.motion = frame.observer.motion;
  sent.velocity = frame.observer.velocity;
  sent.mode = frame.mode;
  sent.field_of_view_deg = frame.field_of_view_deg;
  sent.stereo = frame.stereo;
  sent.exposure_stops = frame.exposure_stops;
  sent.language = frame.language;
  sent.captions = frame.captions;
  sent.size_px = request.size_px;
  sent.projectors_px = request.output.projectors_px;
  sent.texts_opacity = request.captions_opacity;
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
  request.before = frame.before;
  request.alike = true;
  request.adapts_at_once = !frame.followed_stops;
  request.quality.reset();
  if (frame.quality) {
    request.quality =
        FrameQuality{frame.quality->budget_px, static_cast<LensChoice>(frame.quality->lens), frame.quality->filter};
    request.whole_px = frame.quality->whole_px;
  }
}

void show_with_stops(double stops, PictureAnswer& answer) {
  if (!answer.followed_stops) {
    return;
  }
  const auto factor = static_cast<float>(std::exp2(stops - *answer.followed_stops));
  answer.picture.tone.gain *= factor;
  if (answer.right_eye) {
    answer.right_eye->tone.gain *= factor;
  }
  if (answer.on_device) {
    answer.on_device->tone.gain *= factor;
  }
  answer.followed_stops = stops;
}

std::vector<Caption> in_language(std::vector<Caption> captions, const std::string& language) {
  for (Caption& caption : captions) {
    caption.text = {{"", text_in(caption.text, language)}};
  }
  return captions;
}

std::string fingerprint_of_shows(const std::vector<Show>& shows) {
  std::string all;
  for (const Show& show : shows) {
    all += to_toml(show);
  }
  return fingerprint(all);
}

std::string fingerprint_of_contents(const std::vector<Show>& shows) {
  std::string all;
  for (const Show& show : shows) {
    const std::filesystem::path own = file_of(show);
    for (const std::filesystem::path& file : files_of(own, show)) {
      if (file != own) {
        all += content_key(file) + ";";
      }
    }
    // A baked trajectory beside the show changes pictures slightly.
    all += content_key(std::filesystem::path(show.folder) / (show.name + ".trajectory")) + ";";
  }
  return fingerprint(all);
}

}  // namespace ergodome
