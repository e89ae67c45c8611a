#pragma once

#include <optional>

#include "kernels/projection/projection.h"
#include "render/frame/eye_disparity.h"
#include "render/frame/stereo_eye.h"

namespace ergodome {

//! Gathers what both eyes see.
class DisparityMeter {
 public:
  DisparityMeter(const StereoEye& left, const StereoEye& right, const Projection& projection)
      : images_{left.image(projection), right.image(projection)}, screen_(projection) {}

  //! A thing, in the directions of both eyes' images; what neither shows does not count.
  void add(const Vector3<double>& left, const Vector3<double>& right);

  //! Whether an image that does not converge shows a direction.
  [[nodiscard]] bool shows(const Vector3<double>& view) const;

  //! Nothing where no thing was seen.
  [[nodiscard]] std::optional<Disparity> result() const { return any_ ? std::optional(disparity_) : std::nullopt; }

 private:
  Projection images_[2];
  Projection screen_;
  Disparity disparity_{};
  bool any_ = false;
};

}  // namespace ergodome
