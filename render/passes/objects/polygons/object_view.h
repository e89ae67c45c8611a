#pragma once

#include "kernels/projection/projection.h"
#include "render/eyes/eye_camera.h"

namespace ergodome {

//! Parameters of an eye for shaders: the rest frame (e_r, e_θ, e_φ) at its position, and the
//! transformations from that frame to its view.
struct ObjectView {
  double r;                      //!< the eye's radius coordinate [M]
  Vector3<double> axes[3];       //!< e_r, e_θ, e_φ in pseudo-Cartesian components
  double view_from_frame[3][3];  //!< rotation from `axes` to the view's axes, row by row
  //! Rotation to the axes of a cube face; identity for other projections.
  double face_from_view[3][3];
  Vector3<double> boost_axis;  //!< direction of the observer's motion
  //! Stretch of the aberration from the rest frame to the observer's frame
  //! (kernels/spacetime/kerr/frame_boost.h).
  double boost_stretch;

  //! Returns the components of a pseudo-Cartesian vector along `axes`.
  [[nodiscard]] Vector3<double> in_frame(const Vector3<double>& v) const {
    return {dot(axes[0], v), dot(axes[1], v), dot(axes[2], v)};
  }
};

//! Returns the parameters of an eye. Throws Error if it is not outside the photon sphere of a hole
//! without spin.
ObjectView object_view(const EyeCamera& eye);

//! Replaces the projection of a cube face by a flat screen, and rotates the view to that face. Does
//! not change other projections and their views.
void turn_to_face(Projection& projection, ObjectView& view);

//! Sets the projection's uniforms of the current program (ObjectUniform). The projection must not
//! be a cube.
void set_projection(const Projection& projection);

//! Sets the view's uniforms of the current program.
void set_view(const ObjectView& view);

}  // namespace ergodome
