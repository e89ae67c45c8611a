#include "render/frame/show_renderer.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <iterator>

#include "content/camera/rain_pose.h"
#include "content/show/animated_show.h"
#include "content/show/stereo_eyes.h"
#include "content/sky/environment_image.h"
#include "kernels/core/error.h"
#include "kernels/spacetime/kerr/kerr.h"
#include "render/frame/flat_eyes.h"
#include "render/frame/frame_images.h"
#include "render/frame/frame_passes.h"
#include "render/lens/lens_source.h"
#include "render/output/stereo_layout.h"
#include "render/output/tone_map.h"
#include "render/passes/effects/exposure_pass.h"
#include "render/passes/near_field/near_field_pass.h"
#include "render/passes/objects/object_pass.h"
#include "render/passes/overlay/overlay_position.h"
#include "render/passes/stars/star_kind.h"
#include "render/picture/picture.h"

namespace ergodome {

namespace {

//! Star images are followed in steps. In each, the changes of the camera's φ, θ [rad] and ln r, and
//! a tenth of its rotation [rad], add up to at most this, if max_trail_steps suffice.
constexpr double longest_trail_step = 0.02;
constexpr int max_trail_steps = 32;

//! Returns whether two shows have the same map with the same settings, so that the map need not be
//! read again.
bool same_map(const Show& a, const Show& b) {
  return a.folder == b.folder && a.sky.map == b.sky.map && a.sky.map_layout == b.sky.map_layout &&
         a.sky.spin_axis_ra_deg == b.sky.spin_axis_ra_deg && a.sky.spin_axis_dec_deg == b.sky.spin_axis_dec_deg &&
         a.sky.filter == b.sky.filter && a.sky.shift == b.sky.shift && a.effects.redshift == b.effects.redshift;
}

//! Returns whether passes read whole pictures in host memory after everything is drawn: for bloom, a
//! vignette or automatic exposure.
bool reads_finished_pictures(const Show& show) {
  return std::ranges::any_of(frame_passes(), [&](const PassKind& kind) {
    return kind.stage >= PassStage::finished && kind.in_host_memory && kind.draws(show, ViewMode::sky);
  });
}

//! See ShowRenderer::set_stars_apart().
bool stars_may_be_apart(const Show& show, ViewMode mode) {
  const StarNeeds needs = star_needs(show, mode);
  return needs.stars && !needs.trails && !needs.spikes && show.timeline.overlays.empty() &&
         !reads_finished_pictures(show);
}

}  // namespace

ShowRenderer::ShowRenderer(const Show& show, Backend backend, LensChoice lens, std::shared_ptr<StationStream> stream)
    : show_(show_at(show, 0.0)),
      lens_(lens),
      stream_(std::move(stream)),
      sky_(show_, backend),
      passes_({show_, backend, stream_}),
      renderer_(backend, stream_),
      omni_eyes_(backend) {}

std::vector<std::string> ShowRenderer::notes() const {
  std::vector<std::string> notes;
  if (sky_.repaired().are_a_mistake()) {
    notes.push_back(note_of_repair(show_, "sky.map", show_.sky.map, sky_.repaired()));
  }
  std::ranges::move(passes_.notes(show_), std::back_inserter(notes));
  return notes;
}

void ShowRenderer::apply(double time_s) {
  time_s_ = time_s;
  const NumberChange change = animate(show_, time_s);
  if (change.sky) {
    sky_.turn(show_, backend());
  }
  passes_.apply(show_, change);
}

void ShowRenderer::set_quality(const FrameQuality& quality) {
  show_.quality.budget_px = quality.budget_px;
  lens_ = quality.lens;
  if (show_.sky.filter != SkyFilter::polygon && quality.filter != SkyFilter::polygon) {
    show_.sky.filter = quality.filter;
  }
}

FrameQuality ShowRenderer::quality() const { return {show_.quality.budget_px, lens_, show_.sky.filter}; }

void ShowRenderer::set_show(const Show& show, std::shared_ptr<StationStream> stream) {
  Show next = show_at(show, time_s_);
  const std::vector<MissingFeature> missing = missing_features(next);
  if (!missing.empty()) {
    throw Error(next.name, missing.front().problem, missing.front().remedy);
  }
  std::optional<ShowSky> sky;
  if (!same_map(show_, next)) {
    sky.emplace(next, backend());
  }
  ShowPasses::Change passes = passes_.changed_for(show_, {next, backend(), stream});
  // Nothing from here on throws an exception.
  if (sky) {
    sky_ = std::move(*sky);
  }
  passes_.replace(std::move(passes));
  show_ = std::move(next);
  passes_.apply(show_, {.stars = true, .exposure = true});
  stream_ = std::move(stream);
  renderer_.set_stream(stream_);
}

PlacedMeshes ShowRenderer::hiding_objects() const {
  const auto* const near_field = passes_.find<NearFieldPass>();
  return near_field != nullptr && near_field->objects() != nullptr ? near_field->objects()->hiding(time_s_)
                                                                   : PlacedMeshes{};
}

std::vector<PlacedOutline> ShowRenderer::object_outlines() const {
  if (const auto* const near_field = passes_.find<NearFieldPass>(); near_field != nullptr && near_field->objects()) {
    return near_field->objects()->outlines(time_s_);
  }
  const auto* const polygons = passes_.find<ObjectPass>();
  return polygons != nullptr ? polygons->outlines(time_s_) : std::vector<PlacedOutline>{};
}

Tone ShowRenderer::tone() const {
  Tone tone = tone_of(show_.tone);
  tone.gain *= static_cast<float>(std::exp2(exposure_stops_));
  return tone;
}

std::optional<double> ShowRenderer::followed_stops() const {
  const auto* const exposure = passes_.find<ExposurePass>();
  return exposure != nullptr ? std::optional(exposure->stops()) : std::nullopt;
}

std::optional<double> ShowRenderer::metered_light() const {
  const auto* const exposure = passes_.find<ExposurePass>();
  return exposure != nullptr ? std::optional(exposure->light()) : std::nullopt;
}

void ShowRenderer::follow_from(double stops, double clock_s) {
  if (auto* const exposure = passes_.find<ExposurePass>()) {
    exposure->follow_from(stops, clock_s);
  }
}

std::optional<StreamStatistics> ShowRenderer::stream_statistics() const {
  return stream_ ? std::optional(stream_->statistics()) : std::nullopt;
}

std::vector<CameraPose> ShowRenderer::shutter_poses(const CameraPose& middle, double time_s) const {
  const double half = 0.5 * show_.effects.trails->shutter_s;
  const CameraPose open = camera_pose(show_, time_s - half);
  const CameraPose close = camera_pose(show_, time_s + half);
  // Star images are followed in steps that are small relative to the distance from the hole and to
  // the view.
  const double turn = 2.0 * std::acos(std::min(std::abs(glm::dot(open.orientation, close.orientation)), 1.0));
  const double way = std::abs(close.phi - open.phi) + std::abs(close.theta - open.theta) +
                     std::abs(std::log(close.r / open.r)) + 0.1 * turn;
  const int steps = std::clamp(static_cast<int>(std::ceil(way / longest_trail_step)), 1, max_trail_steps);
  std::vector<CameraPose> poses;
  for (int i = -steps; i <= steps; ++i) {
    poses.push_back(camera_pose(show_, time_s + half * i / steps));
    if (!middle.velocity) {
      // `middle` has no velocity: its observer was set with set_observer() and is outside the
      // horizon. Poses inside the horizon are replaced by `middle`.
      const CameraPose outside = in_zamo_frame(poses.back(), spacetime_of(show_));
      poses.back() = outside.velocity_in_rain ? middle : outside;
      poses.back().velocity.reset();
    }
  }
  return poses;
}

void ShowRenderer::require_rays_from(const CameraPose& pose) const {
  if (method_ == TraceMethod::baseline_rk34 && pose.r <= horizon_radius(spacetime_of(show_))) {
    throw Error(
        show_.name,
        fmt::format("the method baseline_rk34 cannot trace rays from inside the horizon (camera at r = {:.6g} M)",
                    pose.r),
        "use taylor, rk34 or cash_karp, or choose an earlier time");
  }
}

PictureSettings ShowRenderer::picture_settings(const CameraPose& pose, ViewMode mode, const ShowMoment& moment,
                                               double eye_offset) const {
  PictureSettings settings;
  settings.mode = mode;
  settings.range = range_;
  settings.filter = show_.sky.filter;
  settings.shift = sky_.shift();
  settings.brightening = show_.sky.brightening;
  settings.polygons = sky_.polygons();
  settings.colours = sky_.colours();
  settings.exposure = static_cast<float>(show_.sky.exposure);
  settings.lens = lens_;
  settings.accuracy = {show_.quality.budget_px, 0.2 * show_.quality.budget_px};
  settings.moment = moment;
  settings.scheme = show_.grid_scheme;
  settings.show = &show_;
  settings.passes = passes_.of_pictures(show_, mode);
  if (star_pixel_ > 0.0 && stars_may_be_apart(show_, mode)) {
    settings.stars_apart = std::make_shared<StarLights>(StarLights{.pixel = star_pixel_});
  }
  const bool shells = near_field_needs(show_, mode).shells;
  if (follows_rays(mode) && (method_ || shells)) {
    require_rays_from(pose);
    settings.follow = {method_.value_or(TraceMethod::taylor), watched_shells(show_.shells), method_.has_value()};
  }
  settings.time_s = moment.time_s.value_or(time_s_);
  // Without a show time (in free flight) the camera's future path is unknown, so there are no
  // trails.
  if (star_needs(show_, mode).trails && moment.time_s) {
    settings.shutter.emplace();
    for (const CameraPose& each : shutter_poses(pose, *moment.time_s)) {
      settings.shutter->eyes.emplace_back(eye_camera(show_, each, eye_offset));
    }
  }
  return settings;
}

Picture ShowRenderer::render_eye(const CameraPose& pose, double eye_offset, const Projection& projection, ViewMode mode,
                                 const ShowMoment& moment) {
  return renderer_.render(eye_camera(show_, pose, eye_offset), projection, sky_.cube(),
                          picture_settings(pose, mode, moment, eye_offset));
}

std::unique_ptr<LensSource> ShowRenderer::lens_of(const CameraPose& pose, const Projection& projection,
                                                  const ShowMoment& moment) {
  return renderer_.lens_for(eye_camera(show_, pose, 0.0), projection,
                            picture_settings(pose, ViewMode::sky, moment, 0.0));
}

BackendPicture ShowRenderer::render_eye_in_place(const CameraPose& pose, double eye_offset,
                                                 const Projection& projection, ViewMode mode,
                                                 const ShowMoment& moment) {
  const BackendPicture made = renderer_.render_in_place(eye_camera(show_, pose, eye_offset), projection, sky_.cube(),
                                                        picture_settings(pose, mode, moment, eye_offset));
  FinishedFrame frame = {
      backend(), show_, mode, pose, projection, moment.time_s, 0.0, tone(), {{made.rgba, eye_offset, nullptr}}};
  passes_.finish(frame);
  return made;
}

std::vector<Picture> ShowRenderer::render_eyes(const CameraPose& pose, const Projection& projection, ViewMode mode,
                                               const ShowMoment& moment) {
  const StereoSettings& stereo = show_.stereo;
  note_baseline(pose, stereo.baseline);
  if (eye_count(stereo) < 2) {
    std::vector<Picture> eyes;
    eyes.push_back(render_eye(pose, 0.0, projection, mode, moment));
    return eyes;
  }
  const auto wanted = [&](double offset) {
    return EyePicture{eye_camera(show_, pose, offset), converged_projection(projection, offset, stereo.convergence),
                      picture_settings(pose, mode, moment, offset)};
  };
  const EyeCameras cameras = eye_cameras(stereo.model);
  if (cameras == EyeCameras::own) {
    return renderer_.render_pair({wanted(-0.5 * stereo.baseline), wanted(0.5 * stereo.baseline)}, sky_.cube());
  }
  const EyePicture head{eye_camera(show_, pose, 0.0), projection, picture_settings(pose, mode, moment, 0.0)};
  const std::vector<CameraPose> shutter =
      head.settings.shutter ? shutter_poses(pose, *moment.time_s) : std::vector<CameraPose>{};
  StereoPictures made = cameras == EyeCameras::shared ? render_flat_eyes(renderer_, head, sky_.cube())
                                                      : omni_eyes_.render(renderer_, pose, head, sky_.cube(), shutter);
  note_baseline(pose, made.baseline);
  return std::move(made.eyes);
}

void ShowRenderer::note_baseline(const CameraPose& pose, double baseline) {
  const StereoSettings& stereo = show_.stereo;
  baseline_ = baseline;
  reduced_baseline_.reset();
  if (baseline < stereo.baseline) {
    reduced_baseline_ = {stereo.model, pose.r, stereo.baseline, baseline};
  }
}

bool ShowRenderer::may_stay_in_place(ViewMode mode) const {
  if (backend() == Backend::cpu || reads_finished_pictures(show_)) {
    return false;
  }
  const StereoSettings& stereo = show_.stereo;
  // Heat maps of two eyes cannot stay, because one color bar is drawn over both pictures.
  return eye_count(stereo) < 2 || (eye_cameras(stereo.model) == EyeCameras::own && mode == ViewMode::sky &&
                                   shows_eyes_whole(stereo.layout) && !stereo.tint_eyes);
}

BackendEyes ShowRenderer::render_eyes_in_place(const CameraPose& pose, const Projection& projection, ViewMode mode,
                                               const ShowMoment& moment) {
  const StereoSettings& stereo = show_.stereo;
  note_baseline(pose, stereo.baseline);
  if (eye_count(stereo) < 2) {
    return {render_eye_in_place(pose, 0.0, projection, mode, moment), {}};
  }
  const auto render = [&](double side) {
    const double offset = side * stereo.baseline;
    return render_eye_in_place(pose, offset, converged_projection(projection, offset, stereo.convergence), mode,
                               moment);
  };
  const BackendPicture left = render(-0.5);
  renderer_.set_aside();
  const BackendPicture right = render(0.5);
  return stereo.swap_eyes ? BackendEyes{right, left} : BackendEyes{left, right};
}

LaidCaptions ShowRenderer::caption_layer(const Projection& projection, ViewMode mode, double time_s) {
  return overlays().caption_layer(overlay_projection(projection),
                                  mode == ViewMode::sky ? std::optional(time_s) : std::nullopt);
}

void ShowRenderer::finish_eyes(std::vector<Picture>& eyes, const CameraPose& pose, const Projection& projection,
                               ViewMode mode, const ShowMoment& moment, double clock_s) {
  FinishedFrame frame = {Backend::cpu, show_, mode, pose, projection, moment.time_s, clock_s, tone(), {}};
  for (std::size_t i = 0; i < eyes.size(); ++i) {
    const double side = eyes.size() < 2 ? 0.0 : i == 0 ? -0.5 : 0.5;
    frame.eyes.push_back({eyes[i].rgba.data(), side * baseline_, &eyes[i]});
  }
  passes_.finish(frame);
  for (Picture& eye : eyes) {
    eye.tone = frame.tone;
  }
  if (eyes.size() == 2) {
    if (show_.stereo.tint_eyes) {
      std::ranges::for_each(eyes, [&](Picture& eye) { set_image_alpha(projection, eye); });
      tint_left_eye(eyes[0]);
      tint_right_eye(eyes[1]);
    }
    if (show_.stereo.swap_eyes) {
      std::swap(eyes[0], eyes[1]);
    }
  }
}

void ShowRenderer::set_stereo(const StereoSettings& stereo) {
  if (stereo == show_.stereo) {
    return;
  }
  Show changed = show_;
  changed.stereo = stereo;
  const std::vector<MissingFeature> missing = missing_features(changed);
  if (!missing.empty()) {
    throw Error(show_.name, missing.front().problem, missing.front().remedy);
  }
  show_.stereo = stereo;
}

void ShowRenderer::set_observer(ObserverMotion motion, const Vector3<double>& velocity) {
  show_.camera.motion = motion;
  show_.camera.velocity = velocity;
}

std::vector<Picture> ShowRenderer::render_window_parts(const CameraPose& pose, const Projection& projection,
                                                       ViewMode mode, const ShowMoment& moment) {
  std::vector<Picture> eyes = render_eyes(pose, projection, mode, moment);
  // Automatic exposure adapts over wall-clock time, like a visitor's eye, even if the show is
  // paused.
  const auto now = std::chrono::steady_clock::now().time_since_epoch();
  finish_eyes(eyes, pose, projection, mode, moment, std::chrono::duration<double>(now).count());
  if (eyes.size() == 2 && !shows_eyes_whole(show_.stereo.layout)) {
    eyes.front() = joined_eyes(eyes[0], eyes[1], show_.stereo.layout);
    eyes.pop_back();
  }
  return eyes;
}

Picture ShowRenderer::render_window(const CameraPose& pose, const Projection& projection, ViewMode mode,
                                    const ShowMoment& moment) {
  std::vector<Picture> parts = render_window_parts(pose, projection, mode, moment);
  return parts.size() < 2 ? std::move(parts.front()) : joined_eyes(parts[0], parts[1], show_.stereo.layout);
}

std::vector<Picture> ShowRenderer::render_frame(double time_s, const ViewChoice& choice) {
  apply(time_s);
  const CameraPose pose = camera_pose(show_, time_s);
  const Projection projection = frame_projection(choice);
  method_ = choice.method;
  range_ = choice.range;
  std::vector<Picture> eyes = render_eyes(pose, projection, choice.mode, {time_s});
  finish_eyes(eyes, pose, projection, choice.mode, {time_s}, time_s);
  if (choice.alpha) {
    std::ranges::for_each(eyes, [&](Picture& eye) { set_image_alpha(projection, eye); });
  }
  return eyes;
}

Projection ShowRenderer::frame_projection(const ViewChoice& choice) const {
  return make_projection(show_.view, choice.size_px > 0 ? choice.size_px : show_.view.size_px, 0.0);
}

std::vector<FrameImage> ShowRenderer::render(double time_s, const ViewChoice& choice) {
  std::vector<Picture> eyes = render_frame(time_s, choice);
  return frame_images(std::move(eyes), frame_projection(choice), show_);
}

}  // namespace ergodome
