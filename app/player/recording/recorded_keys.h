#pragma once

#include <vector>

#include "content/camera/camera_path.h"
#include "content/show/show.h"

namespace ergodome {

//! Tolerance of a recorded path relative to the flight.
struct RecordTolerance {
  double turn_rad = 1e-3;  //!< of the view, and of the position as seen from the hole
  double radius = 1e-3;    //!< relative
  //! Tolerance of the observer's proper velocity: it shifts the view by less than twice that angle
  //! [rad].
  double velocity = 5e-4;
};

//! The pose that a path must have at a moment, and a key that would produce it.
struct PathMark {
  CameraKey key;
  CameraPose pose;
};

//! Returns the keys of few marks, chosen greedily, with which the path is within the tolerance of all
//! marks, sorted by time. The first, the last and the mark with index `always` are included. `path` has all other
//! settings of the camera.
std::vector<CameraKey> fewest_keys(const std::vector<PathMark>& marks, std::size_t always, Show path,
                                   const RecordTolerance& tolerance);

//! Returns a key with the orientation of a pose: yaw, pitch and roll relative to looking at the
//! hole.
CameraKey key_at(double time_s, const CameraPose& pose);

}  // namespace ergodome
