#pragma once

#include <optional>
#include <vector>

#include "kernels/projection/projection.h"
#include "render/eyes/eye_disparity.h"
#include "render/eyes/stereo_eye.h"

namespace ergodome {

//! Gathers what both eyes see.
class DisparityMeter {
 public:
  DisparityMeter(const StereoEye& left, const StereoEye& right, const Projection& projection)
      : images_{left.image(projection), right.image(projection)}, screen_(projection) {}

  //! A thing, in the directions of both eyes' images; what neither shows does not count.
  void add(const Vector3<double>& left, const Vector3<double>& right);

  //! One of many directions of a sheet that is stretched without bound here and there, as the sky is beside its caustics: of all of these the outermost
  //! outlying_share to both sides does not count.
  void add_of_sheet(const Vector3<double>& left, const Vector3<double>& right);

  static constexpr double outlying_share = 0.05;

  //! Whether an image that does not converge shows a direction.
  [[nodiscard]] bool shows(const Vector3<double>& view) const;

  //! Nothing where no thing was seen.
  [[nodiscard]] std::optional<Disparity> result() const;

 private:
  //! Of one thing.
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
