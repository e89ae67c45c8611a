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
  double azimuth_deg;    //!< to the right of the front
  double elevation_deg;  //!< upwards; at 90 its top points away from its azimuth, at -90 towards it
  double height_deg;     //!< of the letters
  Vector3<float> colour;
};

//! A label in a form that pixels can sample: a flat image that touches the sphere in its middle.
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
  double scale_;          //!< pixels of the text per unit of length
  double cosine_beyond_;  //!< cosine of the angle from its middle that contains it
  TextImage text_;
  Vector3<float> colour_;
};

std::vector<LabelStamp> stamps_of(const std::vector<DomeLabel>& labels);

//! Returns the light of a pixel in direction n, covered by labels.
Vector3<float> labelled(Vector3<float> light, const std::vector<LabelStamp>& stamps, const Vector3<double>& n);

}  // namespace ergodome
