#include "render/frame/omni_eyes.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <optional>

#include "kernels/core/error.h"
#include "kernels/projection/pixel_measure.h"
#include "render/passes/objects/object_kind.h"
#include "render/stereo/eye_distance.h"

namespace ergodome {

namespace {

//! ODS eyes and their distance [M].
struct FittingPair {
  OmniPair pair;
  double baseline;
};

EyeAtOffset eyes_at(const Show& show, const CameraPose& pose) {
  return [&show, &pose](const Vector3<double>& offset) { return eye_camera(show, pose, offset); };
}

//! Returns ODS eyes with the show's baseline or, if it does not fit, with the largest baseline that
//! does. `tolerance`: accepted error of the cameras [rad]. Throws Error if no baseline fits.
FittingPair fitting_omni_pair(const Show& show, Backend backend, const CameraPose& pose, double tolerance) {
  const auto pair_at = [&](double apart) {
    return make_omni_pair(backend, eyes_at(show, pose), omni_settings(show.stereo, apart, tolerance));
  };
  double baseline = std::min(show.stereo.baseline, omni_room(spacetime_of(show), pose));
  std::optional<OmniPair> pair = pair_at(baseline);
  if (!pair) {
    baseline = fitting_baseline(show, pose);
    pair = pair_at(baseline);
  }
  if (!pair) {
    throw Error("stereo.model", fmt::format("the model omni cannot be drawn at r = {:.6g} M", pose.r),
                "choose model = \"physical\"");
  }
  return {*pair, baseline};
}

//! Returns the ODS cameras for a pose of the head while the shutter is open, with the show's
//! baseline or, if it does not fit at that pose, with the largest that does.
std::shared_ptr<const OmniCamera> fitting_omni_cameras(const Show& show, Backend backend, const CameraPose& pose,
                                                       double tolerance) {
  const auto cameras = [&](double baseline) {
    return std::make_shared<const OmniCamera>(backend, eyes_at(show, pose),
                                              omni_settings(show.stereo, baseline, tolerance));
  };
  try {
    return cameras(std::min(show.stereo.baseline, omni_room(spacetime_of(show), pose)));
  } catch (const Error&) {
    return cameras(fitting_baseline(show, pose));
  }
}

}  // namespace

StereoPictures OmniEyes::render(EyeRenderer& renderer, const CameraPose& pose, const EyePicture& head,
                                const SkyCube& sky, const std::vector<CameraPose>& shutter) {
  PictureSettings settings = head.settings;
  const Show& show = *settings.show;
  const double tolerance = settings.accuracy.tolerance_px * pixel_angle(head.projection);
  const FittingPair fitting = fitting_omni_pair(show, backend_, pose, tolerance);
  StereoPictures made{{}, fitting.baseline};
  // If the baseline is 0, uses the head itself for stars and near field, so that the result is
  // bit-identical to the head's picture.
  const bool turns = made.baseline > 0.0;
  std::vector<std::shared_ptr<const OmniCamera>> shutter_cameras;
  for (std::size_t i = 0; turns && i < shutter.size(); ++i) {
    shutter_cameras.push_back(fitting_omni_cameras(show, backend_, shutter[i], tolerance));
  }
  for (const std::shared_ptr<const OmniEye>& eye : fitting.pair) {
    const auto lens = lenses_.choose(eye, head.projection, settings.mode, settings.lens, settings.accuracy);
    settings.given = lens.get();
    if (settings.stars_apart) {
      settings.stars_apart = std::make_shared<StarLights>(*head.settings.stars_apart);
    }
    if (turns) {
      settings.omni = eye;
      if (needs_polygons(show, settings.mode)) {
        settings.omni_view = std::make_shared<const OmniView>(omni_view(*eye, eyes_at(show, pose)));
      }
    }
    for (std::size_t i = 0; i < shutter_cameras.size(); ++i) {
      settings.shutter->eyes[i] =
          StarEye(make_omni_eye_for_trails(shutter_cameras[i], eye->side, eyes_at(show, shutter[i])));
    }
    made.eyes.push_back(renderer.render(head.eye, head.projection, sky, settings));
  }
  return made;
}

}  // namespace ergodome
