#pragma once

#include <string>
#include <vector>

#include "kernels/core/vector3.h"
#include "render/output/text_image.h"

namespace ergodome {

//! A word on the dome. It reads upright for a viewer inside who faces it.
struct DomeLabel {
  std::string text;
  double azimuth_deg;    //!< to the right of the front
  double elevation_deg;  //!< upwards; at 90 and -90 its top points away from its azimuth, and towards it
  double height_deg;     //!< of the letters
  Vector3<float> colour;
};

//! A label as pixels look for it: a flat picture that touches the sphere in its middle.
class LabelStamp {
 public:
  explicit LabelStamp(const DomeLabel& label);

  //! How much of a pixel in direction n the letters cover, 0 to 1.
  [[nodiscard]] float coverage(const Vector3<double>& n) const;
  [[nodiscard]] const Vector3<float>& colour() const { return colour_; }

 private:
  Vector3<double> middle_;
  Vector3<double> right_;
  Vector3<double> up_;
  double scale_;          //!< pixels of the text per unit of length
  double cosine_beyond_;  //!< of the angle from its middle that it stays within
  TextImage text_;
  Vector3<float> colour_;
};

std::vector<LabelStamp> stamps_of(const std::vector<DomeLabel>& labels);

//! Light of a pixel in direction n with labels on top of it.
Vector3<float> labelled(Vector3<float> light, const std::vector<LabelStamp>& stamps, const Vector3<double>& n);

}  // namespace ergodome
