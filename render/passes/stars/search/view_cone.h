#pragma once

#include "kernels/projection/projection.h"
#include "render/eyes/eye_camera.h"

namespace ergodome {

//! What of a camera's sky is asked for: a cone in the observer's frame, with a unit vector for its axis.
struct ViewCone {
  Vector3<double> axis = {1.0, 0.0, 0.0};
  double half_angle = 3.14159265358979323846;  //!< [rad]
  double cosine = -1.0;                        //!< of that
};

//! The cone that holds a picture, and `margin` [rad] more.
ViewCone view_cone(const EyeCamera& eye, const Projection& projection, double margin);

//! The same about a wider angle, by `margin` [rad].
ViewCone widened(const ViewCone& view, double margin);

//! Whether all that is seen in one is seen in another, to a millionth of a radian.
bool holds(const ViewCone& outer, const ViewCone& inner);

//! Whether a cone about `axis` (unit vector) of half angle `radius` [rad] may share directions with the view.
bool may_touch(const ViewCone& view, const Vector3<double>& axis, double radius);

}  // namespace ergodome
