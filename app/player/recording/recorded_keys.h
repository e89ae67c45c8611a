#pragma once

#include <vector>

#include "content/camera/camera_path.h"
#include "content/show/show.h"

namespace ergodome {

//! Maximum deviation of a recorded path from the flight.
struct RecordTolerance {
  double turn_rad = 1e-3;  //!< maximum angle of the view, and of the position as seen from the hole
  double radius = 1e-3;    //!< maximum relative deviation of the radius
  //! Tolerance of the observer's proper velocity γv [c]: a change of this size shifts directions in
  //! the view by less than twice this number [rad].
  double velocity = 5e-4;
};

//! The pose that a path must have at a moment, and a key that would produce it.
struct PathMark {
  CameraKey key;
  CameraPose pose;
};

//! Returns the keys of few marks, chosen greedily, with which the path is within the tolerance of
//! all marks. `marks` are sorted by time. The first mark, the last one and that with index `always`
//! are included. `path` has all other settings of the camera.
std::vector<CameraKey> min_keys(const std::vector<PathMark>& marks, std::size_t always, Show path,
                                const RecordTolerance& tolerance);

//! Returns a key with the orientation of a pose: yaw, pitch and roll relative to looking at the
//! hole.
CameraKey key_at(double time_s, const CameraPose& pose);

}  // namespace ergodome
