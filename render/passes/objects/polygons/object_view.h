#pragma once

#include "kernels/projection/projection.h"
#include "render/eyes/eye_camera.h"

namespace ergodome {

//! What shaders need of an eye: its rest frame (e_r, e_θ, e_φ), and what leads from there to its own view.
struct ObjectView {
  double r;                      //!< [M]
  Vector3<double> axes[3];       //!< e_r, e_θ, e_φ by their pseudo-Cartesian parts
  double view_from_frame[3][3];  //!< row by row
  double face_from_view[3][3];   //!< to the axes of a flat screen that is a face of a cube; else nothing is turned
  Vector3<double> boost_axis;    //!< of the observer's motion
  double boost_stretch;  //!< of the aberration from the rest frame to the observer's (kernels/metric/frame_boost.h)

  //! Parts of a pseudo-Cartesian vector along the axes.
  [[nodiscard]] Vector3<double> in_frame(const Vector3<double>& v) const {
    return {dot(axes[0], v), dot(axes[1], v), dot(axes[2], v)};
  }
};

//! The eye must be outside the photon sphere of a hole that does not spin. Throws Error where it is not.
ObjectView object_view(const EyeCamera& eye);

//! A face of a cube is a flat screen before a view that is turned to it; other projections, and their views, stay as they are.
void turn_to_face(Projection& projection, ObjectView& view);

//! Sets the projection's uniforms of the program in use (ObjectUniform); of any but a cube.
void set_projection(const Projection& projection);

//! The same of the eye's.
void set_view(const ObjectView& view);

}  // namespace ergodome
