#include "content/show.h"

#include <algorithm>
#include <cmath>

namespace ergodome {

int frame_count(const Show& show) {
  const double frames = std::round(show.duration_s * show.frame_rate_hz);
  return static_cast<int>(std::clamp(frames, 1.0, 1e9));
}

double frame_time_s(const Show& show, int frame) { return frame / show.frame_rate_hz; }

std::vector<std::string> missing_features(const Show& show) {
  std::vector<std::string> missing;
  if (show.view.projection == ViewProjection::cube || show.view.projection == ViewProjection::cylinder) {
    missing.emplace_back("the projections cube and cylinder are not there yet (view.projection)");
  }
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
