#pragma once

#include <optional>
#include <span>
#include <vector>

#include "content/camera/camera_path.h"

namespace ergodome {

//! A sample of a camera that falls through the horizon.
struct FallMoment {
  double time_s = 0.0;
  CameraPose pose;           //!< with a velocity in the rain frame
  double proper_time = 0.0;  //!< proper time of the camera, from any origin [M]
};

//! A fall as the table [camera.fall] of a show stores it, with its clock.
struct RecordedFall {
  //! Where the keys release the camera; recorded_fall() does not set its yaw, pitch and roll.
  CameraKey start;
  FallSettings settings;
  //! Keys of camera.fall.clock: they match the proper times at all moments to 1e-8 M.
  std::vector<NumberKey> clock;
};

//! Returns whether free fall leads from the first moment to the second: energy, angular momentum
//! and Carter constant are equal within 1e-6, and proper time does not decrease.
bool falls_on(Spacetime spacetime, const FallMoment& before, const FallMoment& after);

//! Returns the fall through the given moments of one orbit. The fall begins at the first moment. If
//! the camera is then too close to the horizon or inside it, the fall begins earlier, farther out
//! on the orbit, at a time between `before_s` and the first moment. Returns nothing if there is no
//! such point.
std::optional<RecordedFall> recorded_fall(Spacetime spacetime, std::span<const FallMoment> moments, double before_s);

//! Puts the fall into the show's camera, whose keys lead up to its start. The show must already
//! have its final length.
void put_fall(const RecordedFall& fall, Show& show);

}  // namespace ergodome
