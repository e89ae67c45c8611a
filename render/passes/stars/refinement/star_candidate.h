#pragma once

#include <functional>

#include "kernels/core/vector3.h"
#include "kernels/stars/seen_image.h"
#include "kernels/stars/star_images.h"
#include "render/passes/stars/star_eye.h"

namespace ergodome {

//! An image candidate during refinement from its approximate to its exact position.
struct StarCandidate {
  int star = -1;
  Vector3<double> on_sky;     //!< direction to the star, for a camera at φ = 0
  Vector3<double> direction;  //!< of the image, in the frame of the eye's camera
  double radius = 0.0;
  double edge_distance = 1.0;  //!< this and the following as in StarImageBatch
  double solid_angle = 0.0;
  double stretch = 0.0;
  double frequency_ratio = 1.0;
  double miss = 0.0;
  double change = 0.0;
  bool faint = false;  //!< it was dropped as too faint
};

//! Squared singular values of the map from the camera's sky to that of the stars.
struct SingularValues {
  double larger_square;
  double smaller_square;
};

SingularValues singular_values(const StarCandidate& c);

//! Returns the ratio of the solid angles on the sky and on the camera, bounded below by the star's
//! disk: where the map is degenerate in one direction, the image is an arc whose length depends on
//! the disk.
double capped_solid_angle(const StarCandidate& c);

//! Combines an image with the properties of its candidate that are needed to identify duplicates.
SeenImage seen_image(const StarImage& image, const StarCandidate& c);

//! Maximum position error of images [px].
inline constexpr double image_tolerance_px = 0.005;

//! Parameters of a search for images. Its functions are called concurrently.
struct ImageSearch {
  const StarEye& eye;
  StarChartOf<double> chart;  //!< of the eye's position, if available
  double pixel;               //!< angle of a pixel [rad]
  //! Returns the luminance of a candidate at its last ray, divided by the required minimum. If not
  //! set, no candidate is dropped as too faint.
  std::function<double(const StarCandidate&)> brightness;
  //! Returns whether an image is refined in double if its magnification in single precision is
  //! accurate to a few percent only.
  std::function<bool(const StarCandidate&)> wanted;
};

}  // namespace ergodome
