#pragma once

#include <functional>

#include "kernels/core/vector3.h"
#include "kernels/stars/star_images.h"
#include "render/passes/stars/star_eye.h"

namespace ergodome {

//! Images on their way from roughly to exactly.
struct StarCandidate {
  int star = -1;
  Vector3<double> on_sky;     //!< the star, for a camera at φ = 0
  Vector3<double> direction;  //!< of the image, in the frame of the eye's camera
  double radius = 0.0;
  double edge_distance = 1.0;  //!< and the rest as in StarImageBatch
  double solid_angle = 0.0;
  double stretch = 0.0;
  double frequency_ratio = 1.0;
  double miss = 0.0;
  double change = 0.0;
  bool faint = false;  //!< it was left on the way
};

//! Squares of the singular values of the map from the camera's sky to the stars'.
struct SingularValues {
  double larger_square;
  double smaller_square;
};

SingularValues singular_values(const StarCandidate& c);

//! How far images may be from where they should be [px].
inline constexpr double image_tolerance_px = 0.005;

//! What images are sought with. Its functions are called by many threads at once.
struct ImageSearch {
  const StarEye& eye;
  StarChartOf<double> chart;  //!< of the eye's place, if one is known
  double pixel;               //!< its angle [rad]
  //! Luminance of an image as its last ray has it, over the least that is asked for; without it none is left.
  std::function<double(const StarCandidate&)> brightness;
  //! Whether an image is made better where float is right to some per cent.
  std::function<bool(const StarCandidate&)> wanted;
};

}  // namespace ergodome
