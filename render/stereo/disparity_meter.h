#pragma once

#include <optional>
#include <vector>

#include "kernels/projection/projection.h"
#include "render/stereo/eye_disparity.h"
#include "render/stereo/stereo_eye.h"

namespace ergodome {

//! Collects the disparities of what both eyes see.
class DisparityMeter {
 public:
  DisparityMeter(const StereoEye& left, const StereoEye& right, const Projection& projection)
      : images_{left.image(projection), right.image(projection)}, screen_(projection) {}

  //! Adds a thing by its directions in both eyes' images. Ignores it unless both images show it.
  void add(const Vector3<double>& left, const Vector3<double>& right);

  //! Adds one of many sample directions of a surface that is stretched without bound in some parts,
  //! as the sky is beside its caustics. The outermost outlying_share of all samples on either side
  //! is ignored.
  void add_of_sheet(const Vector3<double>& left, const Vector3<double>& right);

  static constexpr double outlying_share = 0.05;

  //! Returns whether an image without convergence shows a direction.
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
  std::vector<Shift> sheet_;
};

}  // namespace ergodome
