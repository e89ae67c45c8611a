#pragma once

#include <vector>

#include "content/camera/camera_path.h"
#include "content/show/show.h"

namespace ergodome {

//! How far a recorded path may be from the flight.
struct RecordTolerance {
  double turn_rad = 1e-3;  //!< of the view, and of the place seen from the hole
  double radius = 1e-3;    //!< part of the radius
  //! Of who looks, as a proper velocity: what is seen is shifted by less than twice that angle [rad].
  double velocity = 5e-4;
};

//! What a path is to show at a moment, and the key that would have it do so.
struct PathMark {
  CameraKey key;
  CameraPose pose;
};

//! The keys of as few marks as have the path within the tolerance of all, in order of time; the first, the last and the `always`th are among them.
//! Everything else that leads the camera is in `path`.
std::vector<CameraKey> fewest_keys(const std::vector<PathMark>& marks, std::size_t always, Show path,
                                   const RecordTolerance& tolerance);

//! A key whose orientation is the given one: yaw, pitch and roll from looking at the hole.
CameraKey key_at(double time_s, const CameraPose& pose);

}  // namespace ergodome
