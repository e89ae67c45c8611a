#pragma once

#include <string>
#include <vector>

#include "kernels/core/vector3.h"
#include "render/output/text_image.h"

// Texts on the dome.

namespace ergodome {

//! A text on the dome, upright for a viewer inside who faces it.
struct DomeLabel {
  std::string text;
  double azimuth_deg;  //!< azimuth to the right of the front
  //! Elevation; at 90 the top of the text points away from its azimuth, at -90 towards it.
  double elevation_deg;
  double height_deg;  //!< height of the letters
  Vector3<float> colour;
};

//! A label in a form that can be sampled for each pixel: a flat image in the plane that touches the
//! sphere at the label's center.
class LabelStamp {
 public:
  explicit LabelStamp(const DomeLabel& label);

  //! Returns how much of a pixel in direction n the letters cover, 0 to 1.
  [[nodiscard]] float coverage(const Vector3<double>& n) const;
  [[nodiscard]] const Vector3<float>& colour() const { return colour_; }

 private:
  Vector3<double> middle_;
  Vector3<double> right_;
  Vector3<double> up_;
  double scale_;  //!< pixels of the text per unit of length
  //! Cosine of the half angle of the cone around the label's center that contains the label.
  double cosine_beyond_;
  TextImage text_;
  Vector3<float> colour_;
};

std::vector<LabelStamp> stamps_of(const std::vector<DomeLabel>& labels);

//! Returns the light of a pixel in direction n after the labels are drawn over `light`.
Vector3<float> labelled(Vector3<float> light, const std::vector<LabelStamp>& stamps, const Vector3<double>& n);

}  // namespace ergodome
