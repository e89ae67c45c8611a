#pragma once

#include <optional>

#include "content/camera/camera_path.h"
#include "content/show/show.h"
#include "kernels/projection/projection.h"
#include "render/eyes/eye_camera.h"
#include "render/passes/objects/polygons/object_outline.h"

namespace ergodome {

//! One eye of a frame, which may have another camera for each direction of its view. Eyes of the
//! model `flat` use the head's camera. The show and the pose must outlive it.
class StereoEye {
 public:
  //! `side`: -1 for the left eye, 1 for the right one.
  StereoEye(const Show& show, const CameraPose& pose, double side)
      : show_(show), pose_(pose), offset_(0.5 * side * show.stereo.baseline) {}

  //! Returns the eye's position relative to the head when it looks in direction `view`, in the
  //! view's axes [M].
  [[nodiscard]] Vector3<double> position(const Vector3<double>& view) const;

  [[nodiscard]] EyeCamera camera(const Vector3<double>& view) const { return eye_camera(show_, pose_, position(view)); }

  //! Returns the shift t by convergence in the model `omni`, whose image shows at `view` the light
  //! from the direction of `view` - t; zero in other models.
  [[nodiscard]] Vector3<double> convergence_turn(const Vector3<double>& view) const;

  //! Returns the projection of the eye's image: shifted for convergence, except in the model
  //! `omni`.
  [[nodiscard]] Projection image(const Projection& projection) const;

  //! Returns the direction in which the eye's image shows a thing, by light on the short way round
  //! the hole. Returns nothing if no such light is found, or if the eye or the thing is within 2 M
  //! of the hole's center.
  [[nodiscard]] std::optional<Vector3<double>> sees(const SeenThing& thing) const;

 private:
  const Show& show_;
  const CameraPose& pose_;
  double offset_;
};

//! A thing as seen by light on the short way round the hole.
struct SeenPosition {
  //! Unit vector toward the apparent position of the thing, in the view's axes.
  Vector3<double> view;
  Vector3<double> position;  //!< point where the light left the thing, pseudo-Cartesian [M]
};

//! Returns the direction in which an eye sees a thing, and the point where the light left it.
//! Returns nothing if no light on the short way round the hole is found, or if the eye or the thing
//! is within 2 M of the hole's center.
std::optional<SeenPosition> seen_by_camera(const EyeCamera& eye, const SeenThing& thing);

//! Returns the approximate direction of a point, as if light traveled straight.
Vector3<double> straight_view(const EyeCamera& eye, const Vector3<double>& position);

}  // namespace ergodome
