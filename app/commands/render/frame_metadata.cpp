#include "app/commands/render/frame_metadata.h"

#include <fmt/format.h>

#include <glm/common.hpp>

#include "app/cli/show_loading.h"
#include "content/camera/camera_path.h"
#include "content/show/reading/motion_reader.h"
#include "kernels/core/angles.h"
#include "render/output/stereo_layout.h"
#include "render/picture/cube_pictures.h"

namespace ergodome {

namespace {

std::string number_text(double number) { return fmt::format("{:.12g}", number); }

//! Returns an axis of the view in the camera's frame (e_r, e_θ, e_φ), without the rounding errors
//! of rotations.
std::string axis_of_view(const CameraPose& pose, const glm::dvec3& axis) {
  const glm::dvec3 own = glm::round(1e12 * (pose.orientation * axis)) / 1e12 + 0.0;
  return fmt::format("{:.12g} {:.12g} {:.12g}", own.x, own.y, own.z);
}

void add_camera(const Show& show, double time_s, FrameMetadata& metadata) {
  const CameraPose pose = camera_pose(show, time_s);
  const char* const observer = !pose.velocity      ? motion_name(show.camera.motion)
                               : show.camera.orbit ? "fall"
                                                   : "velocity";
  metadata.emplace_back("spin", number_text(show.spin));
  metadata.emplace_back("r", number_text(pose.r));
  metadata.emplace_back("theta_deg", number_text(pose.theta * radian_deg));
  metadata.emplace_back("phi_deg", number_text(pose.phi * radian_deg));
  metadata.emplace_back("observer", observer);
  metadata.emplace_back("forward", axis_of_view(pose, {0.0, 0.0, -1.0}));
  metadata.emplace_back("right", axis_of_view(pose, {1.0, 0.0, 0.0}));
  metadata.emplace_back("up", axis_of_view(pose, {0.0, 1.0, 0.0}));
}

void add_angles(const ViewSettings& view, FrameMetadata& metadata) {
  const bool off_axis = view.projection == ViewProjection::pinhole && view.frustum;
  if (!shows_whole_sky(view) && !off_axis) {
    metadata.emplace_back("fov_deg", number_text(view.field_of_view_deg));
  }
  if (view.projection == ViewProjection::dome) {
    metadata.emplace_back("tilt_deg", number_text(view.tilt_deg));
  }
}

void add_tone(const ToneSettings& tone, FrameMetadata& metadata) {
  metadata.emplace_back("exposure_stops", number_text(tone.exposure_stops));
  metadata.emplace_back("tone_curve", tone_curve_names[static_cast<std::size_t>(tone.curve)]);
  if (tone.curve == ToneCurve::reinhard) {
    metadata.emplace_back("tone_white", number_text(tone.white));
  } else if (tone.curve == ToneCurve::gamma) {
    metadata.emplace_back("tone_gamma", number_text(tone.gamma));
  }
}

}  // namespace

FrameMetadata frame_metadata(const Show& show, const FrameFile& file) {
  constexpr const char* parts[] = {"whole", "left", "right"};
  const double time_s = frame_time_s(show, file.frame);
  FrameMetadata metadata = {{"show", text_in(show.title, "")},
                            {"frame", std::to_string(file.frame + 1)},
                            {"time_s", fmt::format("{:.6f}", time_s)}};
  add_camera(show, time_s, metadata);
  metadata.emplace_back("projection", view_projection_names[static_cast<std::size_t>(show.view.projection)]);
  add_angles(show.view, metadata);
  metadata.emplace_back("from_outside", show.view.from_outside ? "true" : "false");
  metadata.emplace_back("part", parts[static_cast<int>(file.part)]);
  metadata.emplace_back("face", file.face ? cube_face_name(*file.face) : "none");
  metadata.emplace_back("stereo", stereo_layout_names[static_cast<std::size_t>(show.stereo.layout)]);
  metadata.emplace_back("version", ERGODOME_VERSION);
  // Heat maps have their own color scale, to which the show's tone does not apply.
  if (file.mode == ViewMode::sky) {
    add_tone(show.tone, metadata);
  }
  if (eye_count(show.stereo) > 1) {
    metadata.emplace_back("stereo_model", stereo_model_names[static_cast<std::size_t>(show.stereo.model)]);
    metadata.emplace_back("baseline_M", number_text(file.baseline));
    metadata.emplace_back("convergence_M",
                          show.stereo.convergence > 0.0 ? number_text(show.stereo.convergence) : "infinity");
  }
  return metadata;
}

}  // namespace ergodome
