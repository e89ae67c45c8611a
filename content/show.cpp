#include "content/show.h"

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

int frame_count(const Show& show) {
  const double frames = std::round(show.duration_s * show.frame_rate_hz);
  return static_cast<int>(std::clamp(frames, 1.0, 1e9));
}

double frame_time_s(const Show& show, int frame) { return frame / show.frame_rate_hz; }

std::vector<std::string> missing_features(const Show& show) {
  std::vector<std::string> missing;
  const StereoLayout layout = show.stereo.layout;
  if (layout != StereoLayout::mono && layout != StereoLayout::side_by_side && layout != StereoLayout::top_bottom &&
      layout != StereoLayout::separate) {
    missing.emplace_back("of the stereo layouts mono, side_by_side, top_bottom and separate are there (stereo.layout)");
  }
  if (layout != StereoLayout::mono && show.stereo.model != StereoModel::physical) {
    missing.emplace_back("of the stereo models physical is there (stereo.model)");
  }
  return missing;
}

}  // namespace ergodome
