#include "content/show/show.h"

#include <algorithm>
#include <cmath>

namespace ergodome {

double usual_field_of_view_deg(ViewProjection projection) {
  switch (projection) {
    case ViewProjection::pinhole:
      return 60.0;
    case ViewProjection::dome:
      return 180.0;
    default:
      return 360.0;
  }
}

bool shows_whole_sky(const ViewSettings& view) {
  return view.projection == ViewProjection::cube ||
         (view.projection == ViewProjection::equirect &&
          view.field_of_view_deg >= usual_field_of_view_deg(ViewProjection::equirect));
}

std::vector<std::string> languages(const Show& show) {
  std::vector<std::string> tags = languages(show.timeline);
  if (tags.empty()) {
    Timeline of_title;
    of_title.chapters = {{0.0, show.title}};
    tags = languages(of_title);
  }
  return tags;
}

int frame_count(const Show& show) {
  const double frames = std::round(show.duration_s * show.frame_rate_hz);
  return static_cast<int>(std::clamp(frames, 1.0, 1e9));
}

double frame_time_s(const Show& show, int frame) { return frame / show.frame_rate_hz; }

std::vector<MissingFeature> missing_features(const Show& show) {
  std::vector<MissingFeature> missing;
  const StereoSettings& stereo = show.stereo;
  if (has_objects(show, ObjectMethod::polygon) && (show.disk || !show.shells.empty())) {
    missing.push_back({"objects with method = \"polygon\" cannot be combined with a disk or shells",
                       "write method = \"trace\" in [[objects]]"});
  }
  if (eye_count(stereo) < 2) {
    return missing;
  }
  const ViewProjection projection = show.view.projection;
  const bool converges = projection == ViewProjection::dome || projection == ViewProjection::pinhole;
  const auto& animations = show.timeline.animations;
  const bool follows = std::ranges::find(animations, "stereo.convergence", &Animation::path) != animations.end();
  if ((stereo.convergence > 0.0 || follows) && stereo.model != StereoModel::omni && !converges) {
    missing.push_back({"stereo.convergence cannot be used with this projection and stereo.model",
                       "choose the projection dome or pinhole, or stereo.model = \"omni\""});
  }
  return missing;
}

}  // namespace ergodome
