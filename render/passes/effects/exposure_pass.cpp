#include "render/passes/effects/exposure_pass.h"

#include <cmath>

namespace ergodome {

void plan_auto_exposure(PlanWriter& plan) {
  if (needs_auto_exposure(plan.maximum(), plan.request().mode)) {
    plan.picture_pass("meter_light", plan.why("tone.auto"));
  }
}

std::unique_ptr<Pass> make_exposure_pass(const PassInput& input) {
  const std::optional<AutoExposureSettings>& settings = input.show.tone.automatic;
  return settings ? std::make_unique<ExposurePass>(*settings) : nullptr;
}

void ExposurePass::finish_frame(FinishedFrame& frame) {
  if (!needs_auto_exposure(frame.show, frame.mode) || frame.eyes.front().picture == nullptr) {
    return;
  }
  LightMeter meter;
  for (const FinishedEye& eye : frame.eyes) {
    meter.add(*eye.picture);
  }
  light_ = meter.middle_light();
  frame.tone.gain *= static_cast<float>(std::exp2(exposure_.follow(light_, frame.clock_s - last_clock_s_)));
  last_clock_s_ = frame.clock_s;
}

void ExposurePass::apply(const Show& show, const NumberChange& change) {
  if (change.exposure) {
    exposure_.set(*show.tone.automatic);
  }
}

bool ExposurePass::serves(const Show& /*now*/, const Show& next) const { return next.tone.automatic.has_value(); }

void ExposurePass::follow_from(double stops, double clock_s) {
  exposure_.go_on_from(stops);
  last_clock_s_ = clock_s;
}

}  // namespace ergodome
