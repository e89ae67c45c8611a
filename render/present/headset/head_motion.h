#pragma once

#include "content/camera/camera_path.h"
#include "content/show/headset_settings.h"

// Motion of a viewer's head, from meters in the viewer's room to lengths in the show.

namespace ergodome {

//! Returns the length in the show that corresponds to one meter of the viewer's room [M per meter]:
//! HeadsetSettings::scale, or if that is 0, a tenth of the distance to the horizon, but at least a
//! hundredth of r, so that it does not vanish at the horizon. Returns 0 if r is not a finite
//! positive number and the scale is not set.
//!
//! With the default the horizon is at least 10 m away. For eyes 64 mm apart, the disparity between
//! the horizon and the sky is then at most 0.4°, of the 1° that viewers fuse without effort
//! (StereoSettings::comfort_deg). A disk in front of the hole may be 2.7 times nearer before it
//! exceeds that. The baseline is 0.64 % of the distance, much smaller than any limit in
//! render/stereo/eye_distance.h. Outside falls, viewers must walk at least 3.6 m before
//! max_head_offset() stops them, unless they are so close that the hundredth of r applies.
double scale_per_meter(const HeadsetSettings& settings, double r, double horizon_radius);

//! Returns the maximum distance of a head from the camera path [M]: that of one eye in a pair with
//! the baseline omni_room() (render/stereo/eye_distance.h). It keeps the head outside the horizon,
//! except in falls through it.
double max_head_offset(Spacetime spacetime, const CameraPose& pose);

//! Shortens an offset of the head to at most `maximum` [M]. Components that are NaN count as 0.
Vector3<double> limited_head_offset(const Vector3<double>& offset, double maximum);

//! Returns the pose of a head that has moved by `offset` [M] in the view's axes (x right, y up, z
//! back), shortened to max_head_offset(). Like an eye at that offset (eye_camera()), it keeps the
//! velocity of the camera, and its axes stay parallel. Throws Error if eye_camera() does.
CameraPose moved_head(const Show& show, const CameraPose& pose, const Vector3<double>& offset);

}  // namespace ergodome
