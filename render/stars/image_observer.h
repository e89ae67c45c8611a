#pragma once

#include <memory>

#include "content/lens_station.h"
#include "kernels/metric/frame_boost.h"
#include "kernels/sky/blackbody.h"
#include "kernels/stars/star_images.h"
#include "render/stars/star_eye.h"
#include "render/stars/star_patches.h"

namespace ergodome {

//! From the frame of an eye's observer to that of its chart.
Aberration aberration_of(const StarEye& eye);

//! What the search for images needs of the observer.
class ImageObserver final : public ImageLight {
 public:
  //! `station`: of the eye's place.
  ImageObserver(const StarEye& eye, const LensStation& station, const BlackbodyTable& colours, bool redshift);

  //! The rain-frame direction of a place in the chart, and the solid angle there per area of the chart [sr/turn].
  [[nodiscard]] Vector3<double> rain_direction(double gamma_turns, double s, double& per_area) const;

  //! Angle between the shadow's edge and a place in the chart, about [rad].
  [[nodiscard]] double edge_distance(float s) const;

  //! The chart that the eye's images are sought in.
  [[nodiscard]] StarChartOf<double> chart() const { return {chart_, aberration_}; }

  //! Seen by the observer.
  [[nodiscard]] Vector3<double> observed(const Vector3<double>& rain) const;

  //! What a rain-frame direction becomes for the observer.
  struct Shift {
    double brightening;      //!< the observer's solid angles over the rain frame's
    double frequency_ratio;  //!< g
  };
  [[nodiscard]] Shift shift_towards(const Vector3<double>& rain) const;

  //! What an image of a star gains in brightness by that, but for its magnification in the rain frame.
  [[nodiscard]] float gain_of(const Shift& shift, const FieldStar& star) const;

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
