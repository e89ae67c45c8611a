#pragma once

#include "kernels/projection/projection.h"
#include "render/eyes/eye_camera.h"

namespace ergodome {

//! A view as a cone in the observer's frame, with a unit vector as its axis.
struct ViewCone {
  Vector3<double> axis = {1.0, 0.0, 0.0};
  double half_angle = 3.14159265358979323846;  //!< [rad]
  double cosine = -1.0;                        //!< cosine of half_angle
};

//! Returns the cone that contains a picture, enlarged by `margin` [rad].
ViewCone view_cone(const EyeCamera& eye, const Projection& projection, double margin);

//! Returns the view enlarged by `margin` [rad].
ViewCone widened(const ViewCone& view, double margin);

//! Returns whether the outer view contains the inner one, within 1e-6 rad.
bool holds(const ViewCone& outer, const ViewCone& inner);

//! Returns whether the cone around `axis` (unit vector) with half angle `radius` [rad] may overlap
//! the view.
bool may_touch(const ViewCone& view, const Vector3<double>& axis, double radius);

}  // namespace ergodome
