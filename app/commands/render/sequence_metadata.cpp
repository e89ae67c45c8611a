#include "app/commands/render/sequence_metadata.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "app/cli/show_loading.h"
#include "app/cli/summary_text.h"
#include "content/files/atomic_file.h"
#include "content/show/animated_show.h"
#include "content/show/stereo_eyes.h"
#include "render/eyes/view_projection.h"
#include "render/output/frame_files.h"
#include "render/stereo/eye_distance.h"

namespace ergodome {

namespace {

using Metadata = nlohmann::ordered_json;

//! Returns the number of the show with the key `path`: `unchanging` if it is not animated,
//! otherwise its first, last, minimum and maximum values in `frames`.
Metadata number_in(const Show& show, const char* path, double unchanging, FrameSpan frames) {
  const Animation* const animation = find_animation(show, path);
  if (animation == nullptr) {
    return unchanging;
  }
  const auto value_in = [&](int frame) { return value_at(*animation, frame_time_s(show, frame)); };
  double minimum = value_in(frames.first);
  double maximum = minimum;
  for (int frame = frames.first; frame <= frames.last; ++frame) {
    minimum = std::min(minimum, value_in(frame));
    maximum = std::max(maximum, value_in(frame));
  }
  return {
      {"first", value_in(frames.first)}, {"last", value_in(frames.last)}, {"least", minimum}, {"greatest", maximum}};
}

//! Returns the baseline in `frames` [M], reduced where the show's does not fit. The baseline is
//! reduced only in stereo models other than `physical`. In these models, it is evaluated in at most
//! a few hundred frames, because each evaluation may take as long as a lens.
Metadata baselines_in(const Show& show, FrameSpan frames) {
  if (fits_everywhere(show.stereo.model)) {
    return number_in(show, "stereo.baseline", show.stereo.baseline, frames);
  }
  constexpr int max_sampled = 256;
  const int stride = 1 + (frames.last - frames.first) / max_sampled;
  const auto value_in = [&](int frame) {
    const double time_s = frame_time_s(show, frame);
    const Show now = show_at(show, time_s);
    return fitting_baseline(now, camera_pose(now, time_s));
  };
  const double first = value_in(frames.first);
  double last = first;
  double minimum = first;
  double maximum = first;
  for (int frame = frames.first; frame < frames.last;) {
    frame = std::min(frame + stride, frames.last);
    last = value_in(frame);
    minimum = std::min(minimum, last);
    maximum = std::max(maximum, last);
  }
  if (minimum == maximum) {
    return first;
  }
  return {{"first", first}, {"last", last}, {"least", minimum}, {"greatest", maximum}};
}

void add_view(const Show& show, FrameSpan frames, int size_px, Metadata& metadata) {
  constexpr const char* lenses[] = {"equidistant", "equisolid", "stereographic", "orthographic", "polynomial"};
  const Projection projection = make_projection(show.view, size_px, 0.0);
  metadata["eye_width_px"] = projection.width_px;
  metadata["eye_height_px"] = projection.height_px;
  metadata["projection"] = view_projection_names[static_cast<std::size_t>(show.view.projection)];
  if (show.view.projection == ViewProjection::pinhole && show.view.frustum) {
    const FrustumAngles& frustum = *show.view.frustum;
    metadata["frustum_deg"] = {
        {"left", frustum.left_deg}, {"right", frustum.right_deg}, {"up", frustum.up_deg}, {"down", frustum.down_deg}};
  } else if (!shows_whole_sky(show.view)) {
    metadata["fov_deg"] = number_in(show, "view.fov_deg", show.view.field_of_view_deg, frames);
  }
  if (show.view.projection == ViewProjection::dome) {
    metadata["lens"] = lenses[static_cast<int>(show.view.lens)];
    metadata["tilt_deg"] = number_in(show, "view.tilt_deg", show.view.tilt_deg, frames);
    metadata["front"] = "bottom of the picture";
  }
  metadata["seen_from"] = show.view.from_outside ? "outside" : "inside";
}

void add_stereo(const Show& show, FrameSpan frames, Metadata& metadata) {
  metadata["stereo"] = stereo_layout_names[static_cast<std::size_t>(show.stereo.layout)];
  if (show.stereo.layout != StereoLayout::mono) {
    metadata["stereo_model"] = stereo_model_names[static_cast<std::size_t>(show.stereo.model)];
    metadata["baseline_M"] = baselines_in(show, frames);
    metadata["convergence_M"] = show.stereo.convergence > 0.0
                                    ? number_in(show, "stereo.convergence", show.stereo.convergence, frames)
                                    : Metadata("infinity");
    metadata["eyes_swapped"] = show.stereo.swap_eyes;
  }
}

void add_format(const FrameFormat& format, Metadata& metadata) {
  metadata["format"] = image_format_names()[static_cast<std::size_t>(format.image)];
  metadata["bits"] = format.image == ImageFormat::png ? 8 : 16;
  metadata["alpha"] = format.alpha;
  if (format.image == ImageFormat::exr) {
    metadata["compression"] = exr_compression_names()[static_cast<std::size_t>(format.compression)];
    metadata["colour"] = "linear light, Rec. 709 primaries, half floats";
  } else {
    metadata["colour"] = "sRGB";
  }
}

//! Returns the files of a frame: one, or a list with one for each eye or cube face that has files
//! of its own.
Metadata files_of(const Show& show, const FrameFormat& format, int frame) {
  const bool separate = show.stereo.layout == StereoLayout::separate;
  std::vector<std::string> files;
  for (const FramePart part : {FramePart::whole, FramePart::left, FramePart::right}) {
    if (separate == (part == FramePart::whole)) {
      continue;
    }
    for (int face = 0; face < (has_face_files(show.view) ? cube_faces : 1); ++face) {
      const auto of_face = has_face_files(show.view) ? std::optional(static_cast<CubeFace>(face)) : std::nullopt;
      files.push_back(
          frame_path(show.name, frame, frame_count(show), part, file_ending(format.image), of_face).generic_string());
    }
  }
  return files.size() == 1 ? Metadata(files.front()) : Metadata(files);
}

Metadata summary_of(const Show& show, const FrameFormat& format, FrameSpan frames, int size_px) {
  const int count = frames.last - frames.first + 1;
  const bool all = count == frame_count(show);
  Metadata metadata;
  metadata["title"] = text_in(show.title, "");
  metadata["made_by"] = "Ergodome " ERGODOME_VERSION;
  metadata["files"] = files_of(show, format, frames.first);
  metadata["frames"] = count;
  metadata["first_frame"] = frames.first + 1;
  metadata["last_frame"] = frames.last + 1;
  metadata["frames_of_show"] = frame_count(show);
  metadata["frame_rate_hz"] = show.frame_rate_hz;
  metadata["begins_at_s"] = frame_time_s(show, frames.first);
  metadata["duration_s"] = all ? show.duration_s : count / show.frame_rate_hz;
  add_view(show, frames, size_px, metadata);
  add_stereo(show, frames, metadata);
  add_format(format, metadata);
  return metadata;
}

}  // namespace

void write_sequence_metadata(const std::filesystem::path& folder, const Show& show, const FrameFormat& format,
                             FrameSpan frames, int size_px) {
  const Metadata metadata = summary_of(show, format, frames, size_px);
  std::string text;
  for (const auto& [name, value] : metadata.items()) {
    text += fmt::format("{}: {}\n", name, value.is_string() ? value.get<std::string>() : value.dump());
  }
  write_text_atomically(folder / (show.name + ".json"), json_text(metadata) + "\n");
  write_text_atomically(folder / (show.name + ".txt"), text);
}

}  // namespace ergodome
