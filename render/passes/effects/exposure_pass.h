#pragma once

#include "render/output/tone_map.h"
#include "render/passes/pass.h"
#include "render/plan/plan_writer.h"

namespace ergodome {

inline bool needs_auto_exposure(const Show& show, ViewMode mode) {
  return mode == ViewMode::sky && show.tone.automatic.has_value();
}

void plan_auto_exposure(PlanWriter& plan);
std::unique_ptr<Pass> make_exposure_pass(const PassInput& input);

//! Adapts the exposure to the light of finished pictures.
inline constexpr PassKind exposure_kind = {"exposure",
                                           PassStage::frame,
                                           needs_auto_exposure,
                                           plan_auto_exposure,
                                           make_exposure_pass,
                                           /*serves_one_picture=*/false,
                                           /*in_host_memory=*/true};

//! Automatic exposure: adapts the exposure of frames to the light in them, gradually over time.
class ExposurePass : public Pass {
 public:
  explicit ExposurePass(const AutoExposureSettings& settings) : exposure_(settings) {}

  [[nodiscard]] const PassKind& kind() const override { return exposure_kind; }
  void finish_frame(FinishedFrame& frame) override;
  void apply(const Show& show, const NumberChange& change) override;
  [[nodiscard]] bool serves(const Show& now, const Show& next) const override;

  //! Returns the automatic exposure of the last frame [stops], by which its gain was changed.
  [[nodiscard]] double stops() const { return exposure_.stops(); }
  //! Returns the mean light of the last frame.
  [[nodiscard]] double light() const { return light_; }
  //! Continues from the exposure `stops` that this or another pass chose for a frame at `clock_s`.
  void follow_from(double stops, double clock_s);

 private:
  AutoExposure exposure_;
  double last_clock_s_ = 0.0;
  double light_ = 0.0;
};

}  // namespace ergodome
