#pragma once

#include <optional>
#include <string>

#include "app/navigation/observer_mode.h"
#include "content/camera/camera_path.h"
#include "content/show/show.h"
#include "kernels/image/shade_pixels.h"

namespace ergodome {

//! Contents of a player's screen at one instant.
struct PlayerFrame {
  double time_s = 0.0;  //!< show time, for animated numbers
  CameraPose pose{};
  ObserverView observer;
  ViewMode mode = ViewMode::sky;
  double field_of_view_deg = 0.0;
  //! Show time of the pose on the show's path; absent off the path.
  std::optional<double> path_time_s;
  StereoSettings stereo;
  double exposure_stops = 0.0;  //!< exposure stops in addition to the show's
  std::string language;
  bool captions = true;
  double light = 1.0;  //!< factor on the display's light
};

}  // namespace ergodome
