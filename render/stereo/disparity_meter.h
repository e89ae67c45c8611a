#pragma once

#include <optional>
#include <vector>

#include "kernels/projection/projection.h"
#include "render/stereo/eye_disparity.h"
#include "render/stereo/stereo_eye.h"

namespace ergodome {

//! Collects the disparities of directions and things that both eyes see, and returns their range.
class DisparityMeter {
 public:
  DisparityMeter(const StereoEye& left, const StereoEye& right, const Projection& projection)
      : images_{left.image(projection), right.image(projection)}, screen_(projection) {}

  //! Adds a thing that the left eye sees in direction `left` and the right eye in direction
  //! `right`. Ignores it if neither eye's image shows it.
  void add(const Vector3<double>& left, const Vector3<double>& right);

  //! Adds one of many sampled directions on a surface, such as the sky, whose disparity is
  //! unbounded in places (beside caustics). A sample that neither eye's image shows is ignored. So
  //! are, of all samples, the fraction outlying_share with the smallest disparities and as many
  //! with the largest.
  void add_of_layer(const Vector3<double>& left, const Vector3<double>& right);

  static constexpr double outlying_share = 0.05;

  //! Returns whether an image without convergence shows a view direction.
  [[nodiscard]] bool shows(const Vector3<double>& view) const;

  //! Returns the disparity range; nothing if nothing was added.
  [[nodiscard]] std::optional<Disparity> result() const;

 private:
  //! Disparity of one thing.
  struct Shift {
    double pixels;
    double arcmin;
  };

  [[nodiscard]] std::optional<Shift> shift_of(const Vector3<double>& left, const Vector3<double>& right) const;

  Projection images_[2];
  Projection screen_;
  std::vector<Shift> things_;
  std::vector<Shift> layer_;
};

}  // namespace ergodome
