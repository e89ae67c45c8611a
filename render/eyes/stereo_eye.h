#pragma once

#include <optional>

#include "content/camera/camera_path.h"
#include "content/show/show.h"
#include "kernels/projection/projection.h"
#include "render/eyes/eye_camera.h"
#include "render/passes/objects/polygons/object_outline.h"

namespace ergodome {

//! One eye of a frame: for each direction of its view, a camera. Those of the model `flat` are the head's. The show and the pose are to stay.
class StereoEye {
 public:
  //! `side`: -1 for the left one, 1 for the right one.
  StereoEye(const Show& show, const CameraPose& pose, double side)
      : show_(show), pose_(pose), offset_(0.5 * side * show.stereo.baseline) {}

  //! Where it sits when it looks in a direction, in the view's axes [M].
  [[nodiscard]] Vector3<double> place(const Vector3<double>& view) const;

  [[nodiscard]] EyeCamera camera(const Vector3<double>& view) const { return eye_camera(show_, pose_, place(view)); }

  //! What a direction of an image that converges within itself is turned by: that of the model omni.
  [[nodiscard]] Vector3<double> convergence_turn(const Vector3<double>& view) const;

  //! The eye's image: where it has directions.
  [[nodiscard]] Projection image(const Projection& projection) const;

  //! Where in its image it sees a thing by light that comes the short way round; nothing where no such light is found, or where either end is within 2 M.
  [[nodiscard]] std::optional<Vector3<double>> sees(const SeenThing& thing) const;

 private:
  const Show& show_;
  const CameraPose& pose_;
  double offset_;
};

//! Where a thing is seen by light that comes the short way round the hole.
struct SeenPlace {
  Vector3<double> view;   //!< unit vector, in the view's axes
  Vector3<double> place;  //!< where the light left it, pseudo-Cartesian [M]
};

//! Nothing where no such light is found, or where either end is within 2 M.
std::optional<SeenPlace> seen_by_camera(const EyeCamera& eye, const SeenThing& thing);

//! About where a place is seen, as if light came straight.
Vector3<double> straight_view(const EyeCamera& eye, const Vector3<double>& place);

}  // namespace ergodome
