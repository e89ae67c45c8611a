#include "render/frame/show_renderer.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "kernels/core/error.h"
#include "render/plan/frame_needs.h"

namespace ergodome {

namespace {

//! Of the camera's way past the hole, in which images of stars are followed [rad].
constexpr double longest_trail_step = 0.02;
constexpr int most_trail_steps = 32;

//! Both pictures in one: `columns` 2 side by side, 1 on top of each other.
Picture joined(const Picture& first, const Picture& second, int columns) {
  Picture whole;
  whole.width = first.width * columns;
  whole.height = first.height * (3 - columns);
  whole.unresolved_pixels = first.unresolved_pixels + second.unresolved_pixels;
  whole.heat_range = first.heat_range;
  whole.lens = first.lens;
  whole.rgba.resize(first.rgba.size() + second.rgba.size());
  const std::size_t row = 4 * static_cast<std::size_t>(first.width);
  for (std::size_t y = 0; y < static_cast<std::size_t>(first.height); ++y) {
    const std::size_t to = columns == 2 ? 2 * y * row : y * row;
    const std::size_t second_to = columns == 2 ? to + row : (y + static_cast<std::size_t>(first.height)) * row;
    std::copy_n(first.rgba.begin() + static_cast<long>(y * row), row, whole.rgba.begin() + static_cast<long>(to));
    std::copy_n(second.rgba.begin() + static_cast<long>(y * row), row,
                whole.rgba.begin() + static_cast<long>(second_to));
  }
  return whole;
}

std::vector<FrameImage> cut_into_faces(const std::vector<FrameImage>& strips, const Projection& projection) {
  std::vector<FrameImage> images;
  for (const FrameImage& strip : strips) {
    auto faces = cube_face_pictures(strip.picture, projection);
    for (std::size_t i = 0; i < faces.size(); ++i) {
      images.push_back({strip.part, std::move(faces[i]), static_cast<CubeFace>(i)});
    }
  }
  return images;
}

}  // namespace

void require_path_of(const Show& show, const TrajectoryReader& trajectory) {
  const auto other = [&](const char* what) {
    return Error(trajectory.path().string(), std::string("was baked for another ") + what, "bake the show again");
  };
  if (trajectory.provenance().spin != show.spin) {
    throw other("spin");
  }
  const auto same = [](double a, double b) { return std::abs(a - b) <= 1e-12 * std::abs(a); };
  for (const StationEntry& station : trajectory.stations()) {
    const CameraPose pose = camera_pose(show, station.time_s);
    if (!same(pose.r, station.r) || !same(pose.theta, station.theta)) {
      throw other("camera path");
    }
  }
  if (!same(trajectory.stations().back().time_s, show.duration_s)) {
    throw other("duration");
  }
}

ShowRenderer::ShowRenderer(const Show& show, Backend backend, LensChoice lens, std::shared_ptr<StationStream> stream)
    : show_(show),
      lens_(lens),
      stream_(std::move(stream)),
      sky_(show, backend),
      stars_(show.sky.stars.empty() ? nullptr : std::make_unique<StarPass>(show)),
      renderer_(backend, stream_) {
  if (show.tone.automatic) {
    exposure_.emplace(*show.tone.automatic);
  }
}

void ShowRenderer::expose(std::span<FrameImage> images, double clock_s) {
  Tone tone = tone_of(show_.tone);
  if (exposure_ && !images.front().picture.heat_range) {
    LightMeter meter;
    for (const FrameImage& image : images) {
      meter.add(image.picture);
    }
    tone.gain *= static_cast<float>(std::exp2(exposure_->follow(meter.middle_light(), clock_s - last_clock_s_)));
    last_clock_s_ = clock_s;
  }
  for (FrameImage& image : images) {
    image.picture.tone = tone;
  }
}

std::optional<StreamStatistics> ShowRenderer::stream_statistics() const {
  return stream_ ? std::optional(stream_->statistics()) : std::nullopt;
}

Shutter ShowRenderer::shutter_at(double time_s, double eye_offset) const {
  const double half = 0.5 * show_.effects.trails->shutter_s;
  const CameraPose open = camera_pose(show_, time_s - half);
  const CameraPose close = camera_pose(show_, time_s + half);
  // Images are followed in steps that are small beside the hole, and beside the view.
  const double turn = 2.0 * std::acos(std::min(std::abs(glm::dot(open.orientation, close.orientation)), 1.0));
  const double way = std::abs(close.phi - open.phi) + std::abs(close.theta - open.theta) +
                     std::abs(std::log(close.r / open.r)) + 0.1 * turn;
  const int steps = std::clamp(static_cast<int>(std::ceil(way / longest_trail_step)), 1, most_trail_steps);
  Shutter shutter;
  for (int i = -steps; i <= steps; ++i) {
    shutter.eyes.push_back(eye_camera(show_, camera_pose(show_, time_s + half * i / steps), eye_offset));
  }
  return shutter;
}

PictureSettings ShowRenderer::picture_settings(ViewMode mode, const ShowMoment& moment, double eye_offset) const {
  PictureSettings settings;
  settings.mode = mode;
  const FrameNeeds needs = frame_needs(show_, mode);
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
  settings.stars = needs.stars ? stars_.get() : nullptr;
  settings.clear_outside = needs.clear_outside;
  if (needs.bloom) {
    settings.bloom = show_.effects.bloom;
  }
  // In free flight nobody knows where the camera will be when the shutter closes.
  if (needs.trails && moment.time_s) {
    settings.shutter = shutter_at(*moment.time_s, eye_offset);
  }
  return settings;
}

Picture ShowRenderer::render_eye(const CameraPose& pose, double eye_offset, const Projection& projection, ViewMode mode,
                                 const ShowMoment& moment) {
  return renderer_.render(eye_camera(show_, pose, eye_offset), projection, sky_.cube(),
                          picture_settings(mode, moment, eye_offset));
}

const float* ShowRenderer::render_eye_in_place(const CameraPose& pose, double eye_offset, const Projection& projection,
                                               ViewMode mode, const ShowMoment& moment, const char** lens) {
  return renderer_.render_in_place(eye_camera(show_, pose, eye_offset), projection, sky_.cube(),
                                   picture_settings(mode, moment, eye_offset), lens);
}

Picture ShowRenderer::render_both_eyes(const CameraPose& pose, const Projection& projection, ViewMode mode,
                                       const ShowMoment& moment) {
  if (show_.stereo.layout == StereoLayout::mono) {
    return render_eye(pose, 0.0, projection, mode, moment);
  }
  const double half = (show_.stereo.swap_eyes ? -0.5 : 0.5) * show_.stereo.baseline;
  const Picture left = render_eye(pose, -half, projection, mode, moment);
  const Picture right = render_eye(pose, half, projection, mode, moment);
  return joined(left, right, show_.stereo.layout == StereoLayout::top_bottom ? 1 : 2);
}

Picture ShowRenderer::render_window(const CameraPose& pose, const Projection& projection, ViewMode mode,
                                    const ShowMoment& moment) {
  FrameImage image = {FramePart::whole, render_both_eyes(pose, projection, mode, moment)};
  // A visitor's eye follows by the clock on the wall, show or no show.
  const auto now = std::chrono::steady_clock::now().time_since_epoch();
  expose({&image, 1}, std::chrono::duration<double>(now).count());
  return std::move(image.picture);
}

std::vector<FrameImage> ShowRenderer::render(double time_s, const ViewChoice& choice) {
  const CameraPose pose = camera_pose(show_, time_s);
  const int size_px = choice.size_px > 0 ? choice.size_px : show_.view.size_px;
  const Projection projection = make_projection(show_.view, size_px, 0.0);
  const ShowMoment moment = {time_s};
  std::vector<FrameImage> images;
  if (show_.stereo.layout != StereoLayout::separate) {
    images.push_back({FramePart::whole, render_both_eyes(pose, projection, choice.mode, moment)});
  } else {
    const double half = (show_.stereo.swap_eyes ? -0.5 : 0.5) * show_.stereo.baseline;
    images.push_back({FramePart::left, render_eye(pose, -half, projection, choice.mode, moment)});
    images.push_back({FramePart::right, render_eye(pose, half, projection, choice.mode, moment)});
  }
  expose(images, time_s);
  return has_face_files(show_.view) ? cut_into_faces(images, projection) : std::move(images);
}

}  // namespace ergodome
