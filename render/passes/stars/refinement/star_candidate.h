#pragma once

#include <functional>

#include "kernels/core/vector3.h"
#include "kernels/stars/seen_image.h"
#include "kernels/stars/star_images.h"
#include "render/passes/stars/star_eye.h"

namespace ergodome {

//! An image candidate while it is refined from its approximate to its exact position.
struct StarCandidate {
  int star = -1;
  Vector3<double> on_sky;     //!< direction to the star, for a camera at φ = 0
  Vector3<double> direction;  //!< direction of the image in the frame of the eye's camera
  double radius = 0.0;
  //! This and the following members have the meaning of the arrays in StarImageBatch.
  double edge_distance = 1.0;
  double solid_angle = 0.0;
  double stretch = 0.0;
  double frequency_ratio = 1.0;
  double miss = 0.0;
  double change = 0.0;
  bool faint = false;  //!< true if it was dropped because it is too faint
};

//! Squared singular values of the lens map from the camera's sky to the stars' sky.
struct SingularValues {
  double larger_square;
  double smaller_square;
};

SingularValues singular_values(const StarCandidate& c);

//! Returns the ratio of an image's solid angle on the sky to that on the camera, which is bounded
//! below by the size of the star's disk: where the lens map is degenerate in one direction, the
//! image is an arc whose length depends on the disk.
double capped_solid_angle(const StarCandidate& c);

//! Combines an image with the properties of its candidate that are needed to identify duplicates.
SeenImage seen_image(const StarImage& image, const StarCandidate& c);

//! Maximum position error of refined images [px].
inline constexpr double image_tolerance_px = 0.005;

//! Parameters of a search for images. Its functions are called concurrently.
struct ImageSearch {
  const StarEye& eye;
  StarChartOf<double> chart;  //!< lens chart of the eye's position, if there is one
  double pixel;               //!< angle that a pixel of the picture subtends [rad]
  //! Returns the ratio between a candidate's luminance, according to its last ray, and the required
  //! minimum. If not set, no candidate is dropped as too faint.
  std::function<double(const StarCandidate&)> brightness;
  //! Returns whether to refine an image in double precision if single precision gives its
  //! magnification only to a few percent.
  std::function<bool(const StarCandidate&)> wanted;
};

}  // namespace ergodome
