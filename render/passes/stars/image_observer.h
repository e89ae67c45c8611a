#pragma once

#include <memory>
#include <span>
#include <vector>

#include "content/trajectory/lens_station.h"
#include "kernels/sky/blackbody.h"
#include "kernels/spacetime/kerr/frame_boost.h"
#include "kernels/stars/search/rough_image.h"
#include "kernels/stars/star_images.h"
#include "render/passes/stars/search/star_patches.h"
#include "render/passes/stars/star_eye.h"

namespace ergodome {

//! Returns the aberration from the frame of an eye's observer to the frame of its lens chart.
Aberration aberration_of(const StarEye& eye);

//! Directions, solid angles and frequency ratios that an observer sees at positions in the chart.
//! See ObservedPositionBatch.
struct ObservedPositions {
  std::vector<float> direction[3];
  std::vector<float> area;
  std::vector<float> frequency_ratio;
};

//! Computes what an observer sees of lensed star images; used by the search for images.
class ImageObserver final : public ImageLight {
 public:
  //! `station`: lens grid at the eye's position.
  ImageObserver(const StarEye& eye, const LensStation& station, const BlackbodyTable& colours, bool redshift);

  //! Returns whether all directions belong to a single camera; energy() is then exact for all of
  //! them.
  [[nodiscard]] bool is_one_camera() const { return cameras_ == nullptr; }

  //! Computes what the observer sees at the positions of the images.
  [[nodiscard]] ObservedPositions observe(std::span<const RoughImage> images) const;

  //! Returns the approximate angle between the shadow's edge and the chart coordinate `s` [rad].
  [[nodiscard]] double edge_distance(float s) const;

  //! Returns the lens chart in which the eye's star images are searched for.
  [[nodiscard]] StarChartOf<double> chart() const { return {chart_, aberration_}; }

  //! Returns the factor by which the frequency shift changes a star's brightness; 1 without
  //! redshift.
  [[nodiscard]] float shift_gain(const FieldStar& star, float frequency_ratio) const;

  [[nodiscard]] AberrationOf<float> observer() const override { return converted_aberration<float>(aberration_); }

  [[nodiscard]] DirectionForm<float> energy() const override { return detail::converted<float>(energy_); }

  [[nodiscard]] PatchLight light_in(float brightening, float frequency_ratio) const override;

 private:
  BlackbodyTable colours_;
  bool redshift_;
  LensChart chart_;
  //! The omnidirectional stereo eye, or null for a single camera. The chart of an ODS eye uses the
  //! eye's own frame, without aberration.
  std::shared_ptr<const OmniEye> cameras_;
  //! Energy at infinity over the energy in the chart's frame, as a function of the direction in
  //! that frame.
  DirectionForm<double> energy_;
  float energy_spread_;  //!< bound of the difference between `energy_` and the energies of an ODS eye's cameras
  Aberration aberration_;
};

}  // namespace ergodome
