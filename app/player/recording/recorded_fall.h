#pragma once

#include <optional>
#include <span>
#include <vector>

#include "content/camera/camera_path.h"

namespace ergodome {

//! A camera that falls through the horizon, at one moment.
struct FallMoment {
  double time_s = 0.0;
  CameraPose pose;        //!< with a velocity in the rain's frame
  double own_time = 0.0;  //!< of the camera, from any beginning [M]
};

//! A fall as [camera.fall] and its clock say it.
struct RecordedFall {
  CameraKey start;  //!< where the keys let go of the camera; its angles are yet to be chosen
  FallSettings settings;
  std::vector<NumberKey> clock;  //!< camera.fall.clock: has the own times at all moments, to 1e-8 M
};

//! Whether who falls at the first moment is at the second one by falling on: energy, angular momentum and Carter's constant are the same, and
//! time has not run back.
bool falls_on(double spin, const FallMoment& before, const FallMoment& after);

//! The fall that passes the given moments of one orbit. It begins at the first; where the camera is too near to the horizon or within it by then, at a
//! place of the orbit further out, between `before_s` and the first moment. Nothing where the orbit leads from no such place.
std::optional<RecordedFall> recorded_fall(double spin, std::span<const FallMoment> moments, double before_s);

//! The show's camera with keys up to the fall's start, let go there. The show is as long as it is to be.
void put_fall(const RecordedFall& fall, Show& show);

}  // namespace ergodome
