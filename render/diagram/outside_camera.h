#pragma once

#include <algorithm>
#include <optional>
#include <vector>

#include "kernels/core/vector3.h"

// The camera that views a diagram.

namespace ergodome {

//! The direction from which a diagram is viewed, in flat space.
struct OutsideDirection {
  double azimuth = 0.0;    //!< azimuth of the camera, from +x towards +y [rad]
  double elevation = 0.0;  //!< elevation of the camera above the plane z = 0 [rad]
  //! Distance of the camera from the middle of the subject [M]; empty: chosen so that the whole
  //! subject is in the picture.
  std::optional<double> distance;
};

//! A camera with a flat screen in flat space.
struct OutsideCamera {
  Vector3<double> position;         //!< position of the camera relative to the hole [M]
  Vector3<double> right, up, back;  //!< unit vectors of the camera's axes
  double half_width;                //!< half width of the screen at distance 1
  double half_height;               //!< half height of that screen
  //! Clipping distances in front of the camera, with a margin [M].
  double nearest, farthest;

  //! Returns the position of `p` relative to the camera, in components along right, up and back
  //! [M].
  [[nodiscard]] Vector3<double> in_view(const Vector3<double>& p) const {
    return {dot(right, p - position), dot(up, p - position), dot(back, p - position)};
  }
};

//! The horizontal band of a picture that the subject may fill; 0 is the bottom of the picture, 1
//! the top.
struct PictureBand {
  double low = 0.0;
  double high = 1.0;
};

//! Returns a camera that shows all positions in a band of its picture, as large as possible unless
//! its distance is given. `aspect`: width over height.
OutsideCamera outside_camera(const OutsideDirection& direction, const std::vector<Vector3<double>>& positions,
                             double aspect, const PictureBand& band);

//! Returns the reference height that letter sizes and line widths are proportional to [px]: the
//! picture's height, or less if the picture is so narrow that texts would not fit.
inline double unit_height_px(int width_px, int height_px) { return std::min<double>(height_px, 0.9 * width_px); }

//! Returns the circle of the outline of a sphere around the origin as the camera sees it; nothing
//! if the camera is inside the sphere.
std::vector<Vector3<double>> sphere_outline(double radius, const OutsideCamera& camera);

}  // namespace ergodome
