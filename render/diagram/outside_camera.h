#pragma once

#include <algorithm>
#include <optional>
#include <vector>

#include "kernels/core/vector3.h"

namespace ergodome {

//! From where a diagram is looked at, in flat space.
struct OutsideDirection {
  double azimuth = 0.0;    //!< of the camera, from +x towards +y [rad]
  double elevation = 0.0;  //!< above the plane z = 0 [rad]
  std::optional<double>
      distance;  //!< from the middle of what is to be seen [M]; absent: so far that all of it is in the picture
};

//! A camera with a flat screen in flat space.
struct OutsideCamera {
  Vector3<double> place;            //!< [M]
  Vector3<double> right, up, back;  //!< of unit length
  double half_width;                //!< of the screen at distance 1
  double half_height;
  double nearest, farthest;  //!< of what is to be seen, along its view [M]

  //! Parts of a place along right, up and back, from the camera [M].
  [[nodiscard]] Vector3<double> in_view(const Vector3<double>& p) const {
    return {dot(right, p - place), dot(up, p - place), dot(back, p - place)};
  }
};

//! The part of a picture that is kept for what is to be seen, from its lower to its upper edge; 0 is the bottom, 1 the top.
struct PictureBand {
  double low = 0.0;
  double high = 1.0;
};

//! A camera that has all places in a band of its picture, as large as may be, unless its distance is told. `aspect`: width over height.
OutsideCamera outside_camera(const OutsideDirection& direction, const std::vector<Vector3<double>>& places,
                             double aspect, const PictureBand& band);

//! Height that the sizes of letters and lines go by [px]: the picture's, or less where it is so narrow that words would not fit.
inline double unit_height_px(int width_px, int height_px) { return std::min<double>(height_px, 0.9 * width_px); }

//! Circle that a sphere about the origin seems to have for its outline; nothing from inside it.
std::vector<Vector3<double>> sphere_outline(double radius, const OutsideCamera& camera);

}  // namespace ergodome
