#pragma once

#include <optional>
#include <string>

#include "app/navigation/observer_mode.h"
#include "content/camera/camera_path.h"
#include "content/show/show.h"
#include "kernels/image/shade_pixels.h"

namespace ergodome {

//! What a player's screen is to show at one instant.
struct PlayerFrame {
  double time_s = 0.0;  //!< of the show, for numbers that change with it
  CameraPose pose{};
  ObserverView observer;
  ViewMode mode = ViewMode::sky;
  double field_of_view_deg = 0.0;
  std::optional<double> path_time_s;  //!< where the camera is on the show's path; none off it
  StereoSettings stereo;
  double exposure_stops = 0.0;  //!< on top of the show's
  std::string language;
  bool captions = true;
  double light = 1.0;  //!< factor on the display's light
};

}  // namespace ergodome
