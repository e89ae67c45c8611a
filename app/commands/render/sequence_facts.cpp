#include "app/commands/render/sequence_facts.h"

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

using Facts = nlohmann::ordered_json;

//! Returns a number of the show in these frames. For an animated number, returns its first, last,
//! least and greatest values.
Facts number_in(const Show& show, const char* path, double unchanging, FrameSpan frames) {
  const Animation* const animation = find_animation(show, path);
  if (animation == nullptr) {
    return unchanging;
  }
  const auto value_in = [&](int frame) { return value_at(*animation, frame_time_s(show, frame)); };
  double least = value_in(frames.first);
  double greatest = least;
  for (int frame = frames.first; frame <= frames.last; ++frame) {
    least = std::min(least, value_in(frame));
    greatest = std::max(greatest, value_in(frame));
  }
  return {{"first", value_in(frames.first)}, {"last", value_in(frames.last)}, {"least", least}, {"greatest", greatest}};
}

//! Returns the baseline in these frames [M], reduced where the show's does not fit. It is reduced
//! only in stereo models other than `physical`; these are evaluated in at most a few hundred
//! frames, because each evaluation may take as long as a lens.
Facts baselines_in(const Show& show, FrameSpan frames) {
  if (fits_everywhere(show.stereo.model)) {
    return number_in(show, "stereo.baseline", show.stereo.baseline, frames);
  }
  constexpr int most_asked = 256;
  const int stride = 1 + (frames.last - frames.first) / most_asked;
  const auto value_in = [&](int frame) {
    const double time_s = frame_time_s(show, frame);
    const Show now = show_at(show, time_s);
    return fitting_baseline(now, camera_pose(now, time_s));
  };
  const double first = value_in(frames.first);
  double last = first;
  double least = first;
  double greatest = first;
  for (int frame = frames.first; frame < frames.last;) {
    frame = std::min(frame + stride, frames.last);
    last = value_in(frame);
    least = std::min(least, last);
    greatest = std::max(greatest, last);
  }
  if (least == greatest) {
    return first;
  }
  return {{"first", first}, {"last", last}, {"least", least}, {"greatest", greatest}};
}

void add_view(const Show& show, FrameSpan frames, int size_px, Facts& facts) {
  constexpr const char* lenses[] = {"equidistant", "equisolid", "stereographic", "orthographic", "polynomial"};
  const Projection projection = make_projection(show.view, size_px, 0.0);
  facts["eye_width_px"] = projection.width_px;
  facts["eye_height_px"] = projection.height_px;
  facts["projection"] = view_projection_names[static_cast<std::size_t>(show.view.projection)];
  if (show.view.projection == ViewProjection::pinhole && show.view.frustum) {
    const FrustumAngles& frustum = *show.view.frustum;
    facts["frustum_deg"] = {
        {"left", frustum.left_deg}, {"right", frustum.right_deg}, {"up", frustum.up_deg}, {"down", frustum.down_deg}};
  } else if (show.view.projection != ViewProjection::equirect && show.view.projection != ViewProjection::cube) {
    facts["fov_deg"] = number_in(show, "view.fov_deg", show.view.field_of_view_deg, frames);
  }
  if (show.view.projection == ViewProjection::dome) {
    facts["lens"] = lenses[static_cast<int>(show.view.lens)];
    facts["tilt_deg"] = number_in(show, "view.tilt_deg", show.view.tilt_deg, frames);
    facts["front"] = "bottom of the picture";
  }
  facts["seen_from"] = show.view.from_outside ? "outside" : "inside";
}

void add_stereo(const Show& show, FrameSpan frames, Facts& facts) {
  facts["stereo"] = stereo_layout_names[static_cast<std::size_t>(show.stereo.layout)];
  if (show.stereo.layout != StereoLayout::mono) {
    facts["stereo_model"] = stereo_model_names[static_cast<std::size_t>(show.stereo.model)];
    facts["baseline_M"] = baselines_in(show, frames);
    facts["convergence_M"] = show.stereo.convergence > 0.0
                                 ? number_in(show, "stereo.convergence", show.stereo.convergence, frames)
                                 : Facts("infinity");
    facts["eyes_swapped"] = show.stereo.swap_eyes;
  }
}

void add_format(const FrameFormat& format, Facts& facts) {
  facts["format"] = image_format_names()[static_cast<std::size_t>(format.image)];
  facts["bits"] = format.image == ImageFormat::png ? 8 : 16;
  facts["alpha"] = format.alpha;
  if (format.image == ImageFormat::exr) {
    facts["compression"] = exr_compression_names()[static_cast<std::size_t>(format.compression)];
    facts["colour"] = "linear light, Rec. 709 primaries, half floats";
  } else {
    facts["colour"] = "sRGB";
  }
}

//! Returns the files of a frame: one, or one for each eye or each face of a cube.
Facts files_of(const Show& show, const FrameFormat& format, int frame) {
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
  return files.size() == 1 ? Facts(files.front()) : Facts(files);
}

Facts facts_of(const Show& show, const FrameFormat& format, FrameSpan frames, int size_px) {
  const int count = frames.last - frames.first + 1;
  const bool all = count == frame_count(show);
  Facts facts;
  facts["title"] = text_in(show.title, "");
  facts["made_by"] = "Ergodome " ERGODOME_VERSION;
  facts["files"] = files_of(show, format, frames.first);
  facts["frames"] = count;
  facts["first_frame"] = frames.first + 1;
  facts["last_frame"] = frames.last + 1;
  facts["frames_of_show"] = frame_count(show);
  facts["frame_rate_hz"] = show.frame_rate_hz;
  facts["begins_at_s"] = frame_time_s(show, frames.first);
  facts["duration_s"] = all ? show.duration_s : count / show.frame_rate_hz;
  add_view(show, frames, size_px, facts);
  add_stereo(show, frames, facts);
  add_format(format, facts);
  return facts;
}

}  // namespace

void write_sequence_facts(const std::filesystem::path& folder, const Show& show, const FrameFormat& format,
                          FrameSpan frames, int size_px) {
  const Facts facts = facts_of(show, format, frames, size_px);
  std::string text;
  for (const auto& [name, value] : facts.items()) {
    text += fmt::format("{}: {}\n", name, value.is_string() ? value.get<std::string>() : value.dump());
  }
  write_text_atomically(folder / (show.name + ".json"), json_text(facts) + "\n");
  write_text_atomically(folder / (show.name + ".txt"), text);
}

}  // namespace ergodome
