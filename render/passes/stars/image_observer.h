#pragma once

#include <memory>
#include <span>
#include <vector>

#include "content/trajectory/lens_station.h"
#include "kernels/sky/blackbody.h"
#include "kernels/spacetime/kerr/frame_boost.h"
#include "kernels/stars/star_images.h"
#include "render/passes/stars/search/rough_images.h"
#include "render/passes/stars/search/star_patches.h"
#include "render/passes/stars/star_eye.h"

namespace ergodome {

//! From the frame of an eye's observer to that of its chart.
Aberration aberration_of(const StarEye& eye);

//! What an observer sees at places of the chart, as ObservedPlaceBatch tells.
struct ObservedPlaces {
  std::vector<float> direction[3];
  std::vector<float> area;
  std::vector<float> frequency_ratio;
};

//! What the search for images needs of the observer.
class ImageObserver final : public ImageLight {
 public:
  //! `station`: of the eye's place.
  ImageObserver(const StarEye& eye, const LensStation& station, const BlackbodyTable& colours, bool redshift);

  //! Whether one camera sees all, whose energies are those of energy().
  [[nodiscard]] bool is_one_camera() const { return cameras_ == nullptr; }

  //! What the observer sees where images are.
  [[nodiscard]] ObservedPlaces observe(std::span<const RoughImage> images) const;

  //! Angle between the shadow's edge and a place in the chart, about [rad].
  [[nodiscard]] double edge_distance(float s) const;

  //! The chart that the eye's images are sought in.
  [[nodiscard]] StarChartOf<double> chart() const { return {chart_, aberration_}; }

  //! What a star gains in brightness by the shift of its light.
  [[nodiscard]] float shift_gain(const FieldStar& star, float frequency_ratio) const;

  [[nodiscard]] AberrationOf<float> observer() const override { return converted_aberration<float>(aberration_); }

  [[nodiscard]] DirectionForm<float> energy() const override { return detail::converted<float>(energy_); }

  [[nodiscard]] PatchLight light_in(float brightening, float frequency_ratio) const override;

 private:
  BlackbodyTable colours_;
  bool redshift_;
  LensChart chart_;
  //! Of an eye that turns; its chart is in its own frame, and no aberration leads there.
  std::shared_ptr<const OmniEye> cameras_;
  DirectionForm<double> energy_;  //!< at infinity, of directions of the chart
  float energy_spread_;           //!< what that may be off by for an eye's other cameras
  Aberration aberration_;
};

}  // namespace ergodome
